#include "ui/panels/file_listing.h"

#include "tests/support/temp_folder.h"
#include "ui/panels/latest_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

FileRow file(std::string name, std::uintmax_t bytes = 0, int seconds = 0) {
  return {fs::path("/x") / name, name, false, bytes, fs::file_time_type(std::chrono::seconds(seconds))};
}
FileRow folder(std::string name) {
  return {fs::path("/x") / name, name, true, 0, {}};
}
std::string names(const std::vector<FileRow>& rows) {
  std::string all;
  for (const FileRow& row : rows)
    all += row.name + " ";
  return all;
}

TEST(Arrange, FoldersComeFirstAndNumbersCountAsNumbers) {
  const auto rows =
      arrange({file("fish 10.png"), folder("zoo"), file("Fish 9.png"), file("fish 010b.png"), folder("Ape")},
              FileFilter::kAll, FileSort::kName, false, false);
  EXPECT_EQ(names(rows), "Ape zoo Fish 9.png fish 10.png fish 010b.png ");
}

TEST(Arrange, SortsByColumnEitherWay) {
  const std::vector<FileRow> rows = {file("a", 30, 2), file("b", 10, 3), file("c", 20, 1), folder("d")};
  EXPECT_EQ(names(arrange(rows, FileFilter::kAll, FileSort::kSize, false, false)), "d b c a ");
  EXPECT_EQ(names(arrange(rows, FileFilter::kAll, FileSort::kSize, true, false)), "d a c b ");
  EXPECT_EQ(names(arrange(rows, FileFilter::kAll, FileSort::kDate, false, false)), "d c a b ");
  EXPECT_EQ(names(arrange(rows, FileFilter::kAll, FileSort::kName, true, false)), "d c b a ");
}

TEST(Arrange, FiltersFilesAndHidesPoints) {
  const std::vector<FileRow> rows = {file("a.PNG"),  file("b.ora"), file("c.jsonl"), file("d.txt"),
                                     file(".e.png"), folder(".f"),  folder("g")};
  EXPECT_EQ(names(arrange(rows, FileFilter::kPictures, FileSort::kName, false, false)), "g a.PNG ");
  EXPECT_EQ(names(arrange(rows, FileFilter::kProjects, FileSort::kName, false, false)), "g b.ora c.jsonl ");
  EXPECT_EQ(names(arrange(rows, FileFilter::kPictures, FileSort::kName, false, true)), ".f g .e.png a.PNG ");
}

TEST(FindByPrefix, GoesRoundFromWhereItStands) {
  const std::vector<FileRow> rows = {file("Alpha"), file("beta"), file("alps"), file("gamma")};
  EXPECT_EQ(find_by_prefix(rows, "al", 0), 0);
  EXPECT_EQ(find_by_prefix(rows, "al", 1), 2);
  EXPECT_EQ(find_by_prefix(rows, "AL", 3), 0);
  EXPECT_EQ(find_by_prefix(rows, "x", 0), -1);
  EXPECT_EQ(find_by_prefix({}, "a", 0), -1);
}

class Folders : public ::testing::Test {
protected:
  Folders() {
    fs::create_directories(root() / "pictures");
    fs::create_directories(root() / "pinboard");
    std::ofstream(root() / "pictures" / "fish one.png") << "x";
    std::ofstream(root() / "pictures" / "fish two.png") << "xyz";
    std::ofstream(root() / "note.txt") << "12345";
  }
  fs::path root() const { return folder_.path(); }
  testing::TempFolder folder_;
};

TEST_F(Folders, AreRead) {
  const FolderListing listing = read_folder(root());
  EXPECT_TRUE(listing.problem.empty());
  EXPECT_EQ(names(arrange(listing.rows, FileFilter::kAll, FileSort::kName, false, false)),
            "pictures pinboard note.txt ");
  for (const FileRow& row : listing.rows)
    if (row.name == "note.txt") {
      EXPECT_EQ(row.bytes, 5U);
    }
}

TEST_F(Folders, ThatCannotBeReadAreAMessage) {
  EXPECT_FALSE(read_folder(root() / "nowhere").problem.empty());
  EXPECT_FALSE(read_folder(root() / "note.txt").problem.empty());
  EXPECT_TRUE(read_folder(root() / "nowhere").rows.empty());
}

TEST_F(Folders, LinksThatLeadNowhereAreListed) {
  fs::create_symlink(root() / "gone", root() / "link");
  const FolderListing listing = read_folder(root());
  EXPECT_TRUE(listing.problem.empty());
  EXPECT_EQ(listing.rows.size(), 4U);
}

TEST_F(Folders, RecentFilesThatAreGoneAreLeftOut) {
  const FolderListing listing = read_files({root() / "note.txt", root() / "gone.png"});
  EXPECT_EQ(names(listing.rows), "note.txt ");
}

TEST_F(Folders, TypedPathsAreCompletedAsFarAsTheyAgree) {
  const std::string base = root().string() + "/";
  EXPECT_EQ(complete_path(base + "p", root()), base + "pi");
  EXPECT_EQ(complete_path(base + "pic", root()), base + "pictures/") << "a single folder gets its slash";
  EXPECT_EQ(complete_path("pictures/f", root()), "pictures/fish ");
  EXPECT_EQ(complete_path("pictures/fish o", root()), "pictures/fish one.png");
  EXPECT_EQ(complete_path("nothing", root()), "nothing");
  EXPECT_EQ(complete_path("nowhere/x", root()), "nowhere/x");
}

TEST_F(Folders, PathsAreRelativeToTheFolder) {
  EXPECT_EQ(path_of("a/../b.png", root()), root() / "b.png");
  EXPECT_EQ(path_of("/etc", root()), fs::path("/etc"));
}

TEST(Format, BytesAndTimes) {
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(999), "999 B");
  EXPECT_EQ(format_bytes(1200), "1.2 kB");
  EXPECT_EQ(format_bytes(123'456'789), "123 MB");
  EXPECT_EQ(format_time(fs::file_time_type::clock::now()).size(), std::string("2026-11-27 14:03").size());
}

TEST(LatestWorker, AnswersTheNewestQuestionAndDropsTheRest) {
  std::mutex gate;
  std::atomic<int> woken = 0;
  gate.lock();
  LatestWorker<int, int> worker(
      [&](const int& n) {
        const std::lock_guard wait(gate);
        return n * n;
      },
      [&] { ++woken; });
  for (int n = 1; n <= 20; ++n)
    worker.ask(n);
  EXPECT_FALSE(worker.take().has_value());
  gate.unlock();
  std::optional<int> answer;
  for (int i = 0; i < 5000 && !(answer = worker.take()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(*answer, 400);
  EXPECT_FALSE(worker.take().has_value());
  EXPECT_EQ(woken, 1);
}

TEST(LatestWorker, EndsWhileItIsAsked) {
  for (int i = 0; i < 50; ++i) {
    LatestWorker<int, int> worker([](const int& n) { return n; }, {});
    worker.ask(i);
  }
}

} // namespace
} // namespace oversketch
