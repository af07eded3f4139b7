// OpenRaster files of other programs.

#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/ora_file.h"

#include "tests/unit/io/projects.h"

namespace oversketch {
namespace {

using namespace testing;

class Foreign : public ::testing::Test {
protected:
  void add(const std::string& name, const std::string& text) { parts.push_back({name, bytes_of_text(text), true}); }
  void add(const std::string& name, const Image& image) { parts.push_back({name, *encode_png(image), true}); }
  /// A picture of 20 × 10 with these layers, written as other programs do.
  void begin(const std::string& layers) {
    parts.clear();
    add("mimetype", "image/openraster");
    add("stack.xml", "<?xml version='1.0' encoding='UTF-8'?>\n<image w='20' h='10' version=\"0.0.1\"><stack>" + layers +
                         "</stack></image>");
    add("data/red.png", red);
    add("data/half.png", half);
  }
  Result<OraFile> open() {
    write_parts(folder / "a.ora", parts);
    return OraFile::open(folder / "a.ora");
  }
  Image picture() {
    const auto file = open();
    EXPECT_TRUE(file.ok());
    const auto image = file->load_picture();
    EXPECT_TRUE(image.ok()) << (image.ok() ? "" : to_string(image.error()));
    return image.ok() ? *image : Image();
  }

  Image red = plain_image(20, 10, {1, 0, 0, 1});
  Image half = rounded(plain_image(8, 6, {0, 1, 0, 0.4f}), 255);
  TempFolder folder;
  std::vector<ArchivePart> parts;
};

TEST_F(Foreign, what_is_no_openraster_file_is_an_error) {
  EXPECT_EQ(OraFile::open(folder / "none.ora").error().code, "file.missing");
  begin("<layer src='data/red.png'/>");
  const auto whole = parts;
  parts.erase(parts.begin());
  EXPECT_EQ(open().error().code, "project.missing-part");
  parts = whole;
  parts[0].bytes = bytes_of_text("application/epub+zip");
  EXPECT_EQ(open().error().code, "project.not-an-archive");
  parts = whole;
  parts.erase(parts.begin() + 1);
  EXPECT_EQ(open().error().code, "project.missing-part");
}

TEST_F(Foreign, a_layer_that_cannot_be_read_is_left_out_where_the_whole_picture_is_there) {
  begin("<layer src='data/blue.png'/><layer src='data/red.png'/><layer src='stack.xml'/>");
  const auto alone = open()->load_picture();
  ASSERT_FALSE(alone.ok());
  EXPECT_EQ(alone.error().code, "image.unknown-format") << "the lowest is laid first";
  const Image merged = rounded(wavy_image(20, 10, 1), 255);
  add("mergedimage.png", merged);
  const auto file = open();
  ASSERT_EQ(file->layers().size(), 1U);
  ASSERT_EQ(file->left_out().size(), 2U);
  EXPECT_EQ(file->left_out()[0].code, "image.unknown-format");
  EXPECT_EQ(file->left_out()[1].code, "project.missing-part");
  EXPECT_EQ(file->left_out()[1].where, (folder / "a.ora").string() + ": data/blue.png");
  EXPECT_EQ(*file->load_layer(0), red);
  const auto loaded = load_project(folder / "a.ora");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->session.document().target.image, merged);
  EXPECT_TRUE(loaded->message.starts_with("2 layers")) << loaded->message;
}

TEST_F(Foreign, its_merged_picture_is_the_target) {
  begin("<layer src='data/red.png'/>");
  const Image merged = rounded(wavy_image(20, 10, 1), 255);
  add("mergedimage.png", merged);
  EXPECT_EQ(picture(), merged);
  auto loaded = load_project(folder / "a.ora");
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_TRUE(loaded->foreign);
  EXPECT_FALSE(loaded->read_only);
  EXPECT_EQ(loaded->session.document().target.image, merged);
  EXPECT_EQ(loaded->session.document().target.name, "a.ora");
  EXPECT_FALSE(loaded->session.history().modified());
  EXPECT_EQ(*read_project_version(folder / "a.ora"), 0);
  // It can be worked on, and saved as a project.
  must_run(loaded->session, LayerAdd{{std::string(kTargetName), {}}, {}});
  save(loaded->session, folder / "a.ora");
  EXPECT_EQ(*read_project_version(folder / "a.ora"), 1);
}

TEST_F(Foreign, its_layers_are_offered_with_their_places) {
  begin(
      "<stack x='3' y='2' visibility='hidden'><layer name='up' src='data/half.png' x='4' y='-1' opacity='0.5'/></stack>"
      "<layer name='down' src='data/red.png'/>");
  const auto file = open();
  ASSERT_TRUE(file.ok()) << to_string(file.error());
  EXPECT_EQ(file->width(), 20);
  EXPECT_EQ(file->height(), 10);
  ASSERT_EQ(file->layers().size(), 2u);
  EXPECT_EQ(file->layers()[0].name, "down");
  EXPECT_TRUE(file->layers()[0].visible);
  EXPECT_EQ(file->layers()[1].name, "up");
  EXPECT_EQ(file->layers()[1].rect, (Rect{7, 1, 8, 6}));
  EXPECT_EQ(file->layers()[1].opacity, 0.5);
  EXPECT_FALSE(file->layers()[1].visible) << "its group is hidden";
  EXPECT_EQ(*file->load_layer(1), half);
  EXPECT_EQ(*file->load_layer(0), red);
}

TEST_F(Foreign, without_a_merged_picture_its_layers_are_laid_over_each_other) {
  begin("<layer src='data/half.png' x='4' y='-1' opacity='0.5'/><layer src='data/red.png' x='2'/>");
  const Image shown = picture();
  EXPECT_EQ(shown.at(0, 5).a, 0) << "nothing lies there";
  EXPECT_EQ(shown.at(3, 5), red.at(0, 0));
  const float a = half.at(0, 0).a * 0.5f;
  EXPECT_NEAR(shown.at(4, 0).r, 1 - a, 1e-6);
  EXPECT_NEAR(shown.at(4, 0).g, a, 1e-6);
  EXPECT_EQ(shown.at(4, 5), red.at(0, 0)) << "below it";
  EXPECT_EQ(shown.at(12, 0), red.at(0, 0)) << "beside it";
  begin("<layer src='data/half.png' visibility='hidden'/><layer src='data/red.png'/>");
  EXPECT_EQ(picture(), red);
  // A group is one picture: its opacity weighs what it shows, not each layer in it.
  begin("<stack opacity='0.5'><layer src='data/red.png'/><layer src='data/red.png'/></stack>");
  EXPECT_NEAR(picture().at(5, 5).a, 0.5, 1e-6);
}

TEST_F(Foreign, what_cannot_be_laid_over_is_said) {
  begin("<layer name='shade' src='data/half.png' composite-op='svg:multiply'/><layer src='data/red.png'/>");
  const auto file = open();
  ASSERT_TRUE(file.ok());
  const auto image = file->load_picture();
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.error().code, "project.unsupported");
  EXPECT_NE(image.error().sentence.find("shade"), std::string::npos);
  EXPECT_TRUE(file->load_layer(1).ok()) << "its layers are offered all the same";
}

} // namespace
} // namespace oversketch
