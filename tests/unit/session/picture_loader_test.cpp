#include "core/session/picture_loader.h"

#include "core/image/image_io.h"

#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using namespace testing;

TEST(PictureLoader, counts_pixels_and_files_each_once) {
  const TempFolder folder;
  ASSERT_TRUE(save_image(wavy_image(60, 40, 1), folder / "a.png").ok());
  const auto known = load_image(folder / "a.png");
  ASSERT_TRUE(known.ok());
  EXPECT_EQ(known->file().size(), folder.read("a.png").size());
  EXPECT_EQ(known->bytes(), 60 * 40 * sizeof(Rgba) + known->file().size());

  Command set = TargetSet{ImageRef{"a.png", {}}}, again = LayerAdd{ImageRef{"a.png", {}}, {}};
  PictureLoader enough(folder.path(), known->bytes());
  EXPECT_TRUE(enough.load_into(set).ok());
  EXPECT_TRUE(enough.load_into(again).ok()) << "the same file";
  EXPECT_EQ(*std::get<TargetSet>(set).target.image, *known);

  Command other = TargetSet{ImageRef{"a.png", {}}};
  const auto refused = PictureLoader(folder.path(), known->bytes() - 1).load_into(other);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, "image.too-large");
  EXPECT_EQ(refused.error().where, (folder / "a.png").string());
  EXPECT_FALSE(std::get<TargetSet>(other).target.image);
}

} // namespace
} // namespace oversketch
