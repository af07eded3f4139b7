// What other programs show of a project file.

#include "core/base/file.h"
#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/ora_file.h"
#include "core/io/project.h"

#include "tests/unit/io/projects.h"

#include <cstdlib>

namespace oversketch {
namespace {

using namespace testing;

std::vector<std::uint8_t> levels_of(const Image& image) {
  std::vector<std::uint8_t> levels = to_rgba8(image);
  // The colour of what cannot be seen is nobody's.
  for (std::size_t i = 0; i < levels.size(); i += 4)
    if (levels[i + 3] == 0) levels[i] = levels[i + 1] = levels[i + 2] = 0;
  return levels;
}

/// A viewer that knows whole numbers alone: src-over of 8-bit levels, as many programs have it.
std::vector<std::uint8_t> lay_over_each_other(const OraFile& file) {
  const int width = file.width(), height = file.height();
  std::vector<std::uint8_t> canvas(static_cast<std::size_t>(width * height) * 4);
  for (std::size_t i = 0; i < file.layers().size(); ++i) {
    const Image picture = *file.load_layer(i);
    const Rect rect = file.layers()[i].rect;
    EXPECT_EQ(intersect(rect, {0, 0, width, height}), rect) << "cropped to the picture";
    const auto top = levels_of(picture);
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x) {
        const auto* s = &top[static_cast<std::size_t>(y * rect.width + x) * 4];
        auto* d = &canvas[static_cast<std::size_t>((rect.y + y) * width + rect.x + x) * 4];
        const int a = s[3], under = (d[3] * (255 - a) + 127) / 255, alpha = a + under;
        for (int k = 0; alpha > 0 && k < 3; ++k)
          d[k] = static_cast<std::uint8_t>((s[k] * a + d[k] * under + alpha / 2) / alpha);
        d[3] = static_cast<std::uint8_t>(alpha);
      }
  }
  return canvas;
}

/// Layers that overlap, half transparent, feathered, in several modes, one hanging out.
Session layered_session(const Image& target) {
  Session session = begun_with(target);
  const auto add = [&](CloneMode mode, double opacity, double strength, Point centre) {
    must_run(session, LayerAdd{loaded_ref("s.png", wavy_image(100, 90, centre.x)), {}});
    must_run(session, RegionSet{{}, blob({50, 45}, 30)});
    must_run(session, SketchSet{{}, blob(centre, 26, 0.3, 50, centre.y)});
    LayerSet set;
    set.mode = mode, set.opacity = opacity, set.strength = strength, set.feather_px = 6;
    must_run(session, set);
  };
  add(CloneMode::kImport, 0.6, 1, {50, 40});
  add(CloneMode::kNone, 0.9, 0.3, {75, 50});
  add(CloneMode::kMixed, 1, 0.5, {110, 85});
  add(CloneMode::kImport, 1, 1, {40, 60});
  LayerSet hide;
  hide.visible = false;
  must_run(session, hide);
  return session;
}

TEST(Viewer, sees_the_composite_to_the_bit_and_so_does_the_merged_picture) {
  const TempFolder folder;
  for (const Image& target :
       {rounded(wavy_image(120, 90, 0), 255), translucent_image(120, 90), wavy_image(120, 90, 2)}) {
    Session session = layered_session(target);
    save(session, folder / "a.ora");
    const auto file = OraFile::open(folder / "a.ora");
    ASSERT_TRUE(file.ok()) << to_string(file.error());
    const auto rendered = levels_of(picture_of(session));
    EXPECT_EQ(levels_of(*file->load_picture()), rendered);
    EXPECT_EQ(lay_over_each_other(*file), rendered);
    ASSERT_EQ(file->layers().size(), 4u) << "the target and three visible layers";
    EXPECT_EQ(file->layers()[0].name, "target");
  }
}

TEST(Viewer, finds_each_layer_opaque_where_it_paints) {
  const TempFolder folder;
  Session session = layered_session(rounded(wavy_image(120, 90, 0), 255));
  save(session, folder / "a.ora");
  const auto file = OraFile::open(folder / "a.ora");
  ASSERT_TRUE(file.ok());
  for (std::size_t i = 1; i < file->layers().size(); ++i) {
    int opaque = 0;
    const Image picture = *file->load_layer(i);
    for (const Rgba& pixel : picture.pixels().values()) {
      EXPECT_TRUE(pixel.a == 0 || pixel.a == 1);
      opaque += pixel.a == 1 ? 1 : 0;
    }
    EXPECT_GT(opaque, 300) << i;
  }
}

TEST(Viewer, has_a_thumbnail_of_256_pixels_at_most) {
  const TempFolder folder;
  for (const auto& [width, height, shown_width, shown_height] :
       {std::array{600, 300, 256, 128}, std::array{40, 30, 40, 30}, std::array{3, 2000, 1, 256}}) {
    Session session = begun_with(rounded(wavy_image(width, height, 1), 255));
    save(session, folder / "a.ora");
    const auto archive = Archive::open(folder / "a.ora", {});
    ASSERT_TRUE(archive.ok());
    const auto image = decode_image(*archive->read("Thumbnails/thumbnail.png", 1 << 20));
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(image->width(), shown_width);
    EXPECT_EQ(image->height(), shown_height);
  }
}

/// The command that starts ImageMagick, or nothing: other programs are called "convert", too.
std::string find_image_magick() {
  for (const char* name : {"convert-im6.q16", "magick", "convert"})
    if (std::system((std::string(name) + " -version 2> /dev/null | grep -q ImageMagick").c_str()) == 0) return name;
  return {};
}

/// ImageMagick, where it is installed: the layers unpacked and laid over each other.
TEST(Viewer, that_is_image_magick_sees_the_same) {
  const std::string magick = find_image_magick();
  if (magick.empty() || std::system("command -v unzip > /dev/null") != 0) GTEST_SKIP() << "needs ImageMagick and unzip";
  const TempFolder folder;
  for (const Image& target : {rounded(wavy_image(120, 90, 0), 255), translucent_image(120, 90)}) {
    Session session = layered_session(target);
    save(session, folder / "a.ora");
    const auto file = OraFile::open(folder / "a.ora");
    ASSERT_TRUE(file.ok());
    std::string line = "cd '" + folder.path().string() + "' && unzip -oq a.ora && " + magick + " data/background.png";
    for (std::size_t i = 1; i < file->layers().size(); ++i)
      line += " \\( data/layer" + std::to_string(i) + ".png -repage +" + std::to_string(file->layers()[i].rect.x) +
              "+" + std::to_string(file->layers()[i].rect.y) + " \\)";
    ASSERT_EQ(std::system((line + " -background none -layers flatten PNG32:shown.png").c_str()), 0);
    EXPECT_EQ(levels_of(*load_image(folder / "shown.png")), levels_of(picture_of(session)));
  }
}

} // namespace
} // namespace oversketch
