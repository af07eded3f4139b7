#include "core/base/file.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// Each test has a folder of its own.
class FileTest : public ::testing::Test {
protected:
  FileTest() {
    std::string pattern = (fs::temp_directory_path() / "oversketch-file-test-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~FileTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_))
      all.insert(entry.path().filename().string());
    return all;
  }

  fs::path folder_;
};

TEST_F(FileTest, WhatCannotBeReadOrWrittenIsAnError) {
  const auto missing = read_text_file(folder_ / "none.txt");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, "file.missing");
  EXPECT_EQ(missing.error().where, (folder_ / "none.txt").string());
  EXPECT_EQ(read_file(folder_ / "none" / "deeper").error().code, "file.missing");
  EXPECT_EQ(read_file(folder_).error().code, "file.unreadable");
  EXPECT_EQ(read_file("").error().code, "file.missing");

  EXPECT_EQ(write_file(folder_ / "none" / "a.txt", "text").error().code, "file.write");
  EXPECT_EQ(write_file(folder_, "text").error().code, "file.write");
  EXPECT_EQ(write_file("", "text").error().code, "file.write");
  EXPECT_EQ(write_file(folder_ / std::string(300, 'a'), "text").error().code, "file.write");
  EXPECT_EQ(write_file("/dev/full", "text").error().code, "file.write");
  EXPECT_EQ(names(), std::set<std::string>{});

  ASSERT_TRUE(write_file(folder_ / "a.txt", "12345").ok());
  EXPECT_EQ(read_file(folder_ / "a.txt", 4).error().code, "file.too-large");
  EXPECT_TRUE(read_file(folder_ / "a.txt", 5).ok());
  EXPECT_EQ(read_file("/dev/zero", 100'000).error().code, "file.too-large");
  EXPECT_EQ(read_file(folder_ / "a.txt" / "b").error().code, "file.missing");
}

TEST_F(FileTest, ReadsWhatWasWritten) {
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 300'000u}) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
      text[i] = static_cast<char>(i * i % 251);
    ASSERT_TRUE(write_file(folder_ / "a.bin", text).ok());
    const auto read = read_text_file(folder_ / "a.bin");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, text);
    const auto bytes = read_file(folder_ / "a.bin", size);
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(bytes->size(), size);
    ASSERT_TRUE(write_file(folder_ / "b.bin", *bytes).ok());
    EXPECT_EQ(read_text_file(folder_ / "b.bin").value(), text);
  }
  EXPECT_EQ(names(), (std::set<std::string>{"a.bin", "b.bin"}));
}

TEST_F(FileTest, ReadsFilesWhoseSizeIsNotTold) {
  const auto status = read_text_file("/proc/self/status");
  ASSERT_TRUE(status.ok());
  EXPECT_NE(status->find("Pid:"), std::string::npos);
}

TEST_F(FileTest, AFailureInTheMiddleLeavesTheOldFileAndNothingElse) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file(path, "old").ok());
  // The limit on file sizes makes the write fail after its first part; the signal that goes with it is ignored.
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{1000, limit.rlim_max};
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto failed = write_file(path, std::string(5000, 'x'));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  ::signal(SIGXFSZ, before);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, "file.write");
  EXPECT_EQ(failed.error().where, path.string());
  EXPECT_EQ(read_text_file(path).value(), "old");
  EXPECT_EQ(names(), (std::set<std::string>{"a.txt"}));
}

TEST_F(FileTest, ReadersOfTheOldFileKeepIt) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file(path, "old text").ok());
  std::ifstream reader(path);
  ASSERT_TRUE(write_file(path, "new").ok());
  std::string word;
  reader >> word;
  EXPECT_EQ(word, "old");
  EXPECT_EQ(read_text_file(path).value(), "new");
}

TEST_F(FileTest, ALinkStaysALink) {
  fs::create_directory(folder_ / "elsewhere");
  ASSERT_TRUE(write_file(folder_ / "elsewhere" / "real.txt", "old").ok());
  fs::create_symlink(fs::path("elsewhere") / "real.txt", folder_ / "link.txt");
  ASSERT_TRUE(write_file(folder_ / "link.txt", "new").ok());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(read_text_file(folder_ / "elsewhere" / "real.txt").value(), "new");
}

TEST_F(FileTest, KeepsPermissionsAndUsesTheUsualOnesForNewFiles) {
  const fs::path path = folder_ / "a.txt";
  std::ofstream(folder_ / "usual.txt") << "x";
  ASSERT_TRUE(write_file(path, "x").ok());
  EXPECT_EQ(fs::status(path).permissions(), fs::status(folder_ / "usual.txt").permissions());
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_TRUE(write_file(path, "y").ok());
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(FileTest, WhatIsNoFileIsWrittenToAndStays) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = read_text_file(pipe).value(); });
  EXPECT_TRUE(write_file(pipe, "through the pipe").ok());
  reader.join();
  EXPECT_EQ(got, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(FileTest, APipeThatNobodyReadsIsAnError) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(write_file(pipe, "to nobody").error().code, "file.write");
}

TEST_F(FileTest, ManyWritersLeaveOneWholeFile) {
  const fs::path path = folder_ / "a.txt";
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'e'; ++letter)
    writers.emplace_back([&path, letter] {
      for (int i = 0; i < 20; ++i)
        EXPECT_TRUE(write_file(path, std::string(20'000, letter)).ok());
    });
  for (std::thread& writer : writers)
    writer.join();
  const std::string text = read_text_file(path).value();
  EXPECT_EQ(text, std::string(20'000, text.at(0)));
  EXPECT_EQ(names(), (std::set<std::string>{"a.txt"}));
}

TEST_F(FileTest, KeepsThePreviousFileWhereItIsAskedTo) {
  WriteOptions keep;
  keep.keep_previous = true;
  const auto write = [&](const fs::path& path, std::string_view text) {
    return write_file(path, std::as_bytes(std::span(text.data(), text.size())), keep);
  };
  ASSERT_TRUE(write(folder_ / "a", "first").ok());
  EXPECT_EQ(names(), (std::set<std::string>{"a"}));
  for (const char* text : {"second", "third"})
    ASSERT_TRUE(write(folder_ / "a", text).ok());
  EXPECT_EQ(*read_text_file(folder_ / "a"), "third");
  EXPECT_EQ(*read_text_file(folder_ / "a~"), "second");
  // A stop between the two renames of an earlier call leaves both names to one file.
  fs::remove(folder_ / "a~");
  fs::create_hard_link(folder_ / "a", folder_ / "a~");
  ASSERT_TRUE(write(folder_ / "a", "fourth").ok());
  EXPECT_EQ(*read_text_file(folder_ / "a~"), "third");
  // Through a link the backup lies beside the file itself.
  fs::create_directory(folder_ / "deep");
  fs::create_symlink(folder_ / "a", folder_ / "deep/link");
  ASSERT_TRUE(write(folder_ / "deep/link", "fifth").ok());
  EXPECT_EQ(*read_text_file(folder_ / "a~"), "fourth");
  EXPECT_TRUE(fs::is_symlink(folder_ / "deep/link"));
  // Where the backup cannot be, nothing is changed.
  fs::remove(folder_ / "a~");
  fs::create_directories(folder_ / "a~/full");
  EXPECT_EQ(write(folder_ / "a", "sixth").error().code, "file.write");
  EXPECT_EQ(*read_text_file(folder_ / "a"), "fifth");
  EXPECT_EQ(names(), (std::set<std::string>{"a", "a~", "deep"}));
}

TEST_F(FileTest, StopsWhenAskedToAndLeavesTheOldFile) {
  ASSERT_TRUE(write_file(folder_ / "a", "first").ok());
  std::stop_source source;
  WriteOptions options;
  options.watch.stop = source.get_token();
  double last = -1;
  options.watch.progress = [&](double done, std::string_view) {
    EXPECT_GT(done, last);
    last = done;
    if (done > 0.5) source.request_stop();
  };
  const std::vector<std::byte> bytes(20 << 20);
  EXPECT_EQ(write_file(folder_ / "a", bytes, options).error().code, "cancelled");
  EXPECT_GT(last, 0.5);
  EXPECT_EQ(*read_text_file(folder_ / "a"), "first");
  EXPECT_EQ(names(), (std::set<std::string>{"a"}));
}

} // namespace
} // namespace oversketch
