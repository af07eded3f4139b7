#include "ui/theme/fonts.h"

#include "ui/theme/icons.h"

#include <imgui.h>

#include <array>
#include <cmath>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// Latin with its extensions, Greek, Cyrillic, punctuation, arrows, and the signs of a ruler and a formula.
constexpr std::array<ImWchar, 15> kTextRanges = {0x20,   0x17f,  0x370,  0x3ff,  0x400,  0x45f,  0x2010, 0x2044,
                                                 0x2190, 0x2199, 0x2212, 0x221e, 0x2248, 0x2265, 0};

constexpr ImWchar code_point(const char* utf8) {
  const auto byte = [&](int i) { return static_cast<unsigned>(static_cast<unsigned char>(utf8[i])); };
  return static_cast<ImWchar>((byte(0) & 15) << 12 | (byte(1) & 63) << 6 | (byte(2) & 63));
}

constexpr auto list_icon_ranges() {
  std::array<ImWchar, 2 * icon::kAll.size() + 1> ranges{};
  for (std::size_t i = 0; i < icon::kAll.size(); ++i)
    ranges[2 * i] = ranges[2 * i + 1] = code_point(icon::kAll[i]);
  return ranges;
}

constexpr auto kIconRanges = list_icon_ranges();

ImFont* add_font(const fs::path& file, float size_px, const ImWchar* ranges, ImFontConfig config = {}) {
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size_px, &config, ranges);
}

} // namespace

Result<void> load_fonts(ThemeLook& look, const fs::path& assets) {
  const fs::path regular = assets / "fonts/Inter-Regular.otf", bold = assets / "fonts/Inter-SemiBold.otf",
                 icons = assets / "fonts/ForkAwesome.ttf";
  for (const fs::path& file : {regular, bold, icons}) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure))
      return Error{"fonts.missing", "a font of the window is not there", file.string()};
  }
  const float text_px = std::round(look.px(kTextSize)), icon_px = std::round(look.px(kIconSize));
  ImFontConfig merged;
  merged.MergeMode = true;
  merged.GlyphMinAdvanceX = text_px;
  // The icons stand on the line's foot otherwise.
  merged.GlyphOffset.y = std::round(look.px(1));

  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  look.text = add_font(regular, text_px, kTextRanges.data());
  add_font(icons, text_px, kIconRanges.data(), merged);
  look.bold = add_font(bold, text_px, kTextRanges.data());
  look.icons_large = add_font(icons, icon_px, kIconRanges.data());
  fonts.Build();
  return {};
}

} // namespace oversketch
