#include "ui/theme/fonts.h"

#include "ui/theme/icons.h"
#include "ui/widgets/imgui_compat.h"

#include <gtest/gtest.h>

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

class FontsTest : public ::testing::Test {
protected:
  FontsTest() { ImGui::CreateContext(); }
  ~FontsTest() override { ImGui::DestroyContext(); }
};

TEST_F(FontsTest, missing_files_are_named) {
  ThemeLook look = make_look(Theme::kDark, 1);
  const auto loaded = load_fonts(look, "/nowhere");
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().code, "fonts.missing");
  EXPECT_EQ(loaded.error().where, "/nowhere/fonts/Inter-Regular.otf");
}

TEST_F(FontsTest, text_has_the_signs_of_the_window_at_every_scale) {
  for (const float scale : {0.75f, 1.0f, 2.0f}) {
    ThemeLook look = make_look(Theme::kLight, scale);
    const auto loaded = load_fonts(look, OVERSKETCH_SOURCE_DIR "/assets");
    ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
    EXPECT_NEAR(compat::font_size(look.text), kTextSize * scale, 0.5);
    for (const int sign : {0x41, 0xe4, 0x3c3, 0xd7, 0x2026, 0x2013, 0x00b7, 0x2212, 0x221e, 0x2264, 0x434})
      EXPECT_NE(look.text->FindGlyphNoFallback(static_cast<ImWchar>(sign)), nullptr) << std::hex << sign;
    for (const char* name : icon::kAll) {
      // Three bytes of UTF-8 each.
      const auto byte = [&](int i) { return static_cast<unsigned>(static_cast<unsigned char>(name[i])); };
      const auto code = static_cast<ImWchar>((byte(0) & 15) << 12 | (byte(1) & 63) << 6 | (byte(2) & 63));
      EXPECT_NE(look.text->FindGlyphNoFallback(code), nullptr) << std::hex << code;
      EXPECT_NE(look.icons_large->FindGlyphNoFallback(code), nullptr) << std::hex << code;
    }
  }
}

/// Contrast after WCAG 2.1, from 1 to 21.
double contrast(PackedColor a, PackedColor b) {
  const auto luminance = [](PackedColor color) {
    const auto linear = [&](int shift) {
      const double level = (color >> shift & 255) / 255.0;
      return level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(0) + 0.7152 * linear(8) + 0.0722 * linear(16);
  };
  const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

TEST(Theme, text_can_be_read_on_everything_it_stands_on) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    const ThemeLook look = make_look(theme, 1);
    for (const PackedColor ground :
         {look.window, look.panel, look.raised, look.sunken, look.hovered, look.selected, look.filled})
      EXPECT_GE(contrast(look.ink, ground), 4.5);
    for (const PackedColor ground : {look.window, look.panel, look.sunken})
      EXPECT_GE(contrast(look.ink_quiet, ground), 4.5);
    EXPECT_GE(contrast(look.accent_ink, look.accent), 4.5);
  }
}

} // namespace
} // namespace oversketch
