#include "core/io/file_claim.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using testing::TempFolder;
namespace fs = std::filesystem;

std::optional<FileClaim> taken(const fs::path& state, const fs::path& project) {
  auto claim = FileClaim::take(state, project);
  EXPECT_TRUE(claim.ok());
  return claim ? std::move(*claim) : std::nullopt;
}

TEST(FileClaim, cannot_be_taken_where_nothing_can_be_written) {
  const TempFolder folder;
  folder.write("plain", "a file, not a folder");
  const auto claim = FileClaim::take(folder / "plain", folder / "work.ora");
  ASSERT_FALSE(claim.ok());
  EXPECT_EQ(claim.error().code, "journal.write");
}

TEST(FileClaim, is_one_s_alone_until_it_goes) {
  const TempFolder folder;
  folder.write("work.ora", "");
  fs::create_symlink(folder / "work.ora", folder / "link.ora");
  {
    auto first = taken(folder / "state", folder / "work.ora");
    ASSERT_TRUE(first);
    EXPECT_FALSE(taken(folder / "state", folder / "work.ora"));
    EXPECT_FALSE(taken(folder / "state", folder / "link.ora")) << "the same file";
    EXPECT_TRUE(taken(folder / "state", folder / "other.ora"));
    // It moves with its object.
    std::optional<FileClaim> moved = std::move(first);
    first.reset();
    EXPECT_FALSE(taken(folder / "state", folder / "work.ora"));
  }
  EXPECT_TRUE(fs::is_empty(folder / "state/open"));
  EXPECT_TRUE(taken(folder / "state", folder / "work.ora"));
}

} // namespace
} // namespace oversketch
