#include "core/base/temporary_name.h"

#include "core/base/file.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace oversketch {
namespace {

using testing::TempFolder;
namespace fs = std::filesystem;

/// A process that is no more.
pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

std::string name_of(pid_t maker, const char* rest = "-1f-0") {
  char name[80];
  std::snprintf(name, sizeof name, ".oversketch-%lx%s.tmp", static_cast<unsigned long>(maker), rest);
  return name;
}

TEST(StaleTemporaries, stay_where_they_are_somebodys_or_something_else) {
  const TempFolder folder;
  const pid_t dead = dead_process();
  // Names that are nearly ours.
  for (const std::string& name :
       {name_of(dead, ""), name_of(dead, "-1f"), name_of(dead, "-1f-0-2"), name_of(dead, "-1F-0"),
        name_of(dead, "-01f-0"), name_of(dead, "--0"), name_of(0), name_of(dead) + "~", std::string(".oversketch-.tmp"),
        std::string(".oversketch-notes.tmp"), "x" + name_of(dead)})
    folder.write(name, "mine");
  // A living process's, and no files.
  folder.write(name_of(::getpid()), "living");
  folder.write("target", "precious");
  fs::create_symlink("target", folder / name_of(dead, "-2-0"));
  fs::create_directory(folder / name_of(dead, "-3-0"));
  ASSERT_EQ(::mkfifo((folder / name_of(dead, "-4-0")).c_str(), 0600), 0);
  // Still held, by somebody whose process cannot be seen from here.
  folder.write(name_of(dead, "-5-0"), "held");
  const int held = ::open((folder / name_of(dead, "-5-0")).c_str(), O_WRONLY);
  ASSERT_TRUE(lock_temporary(held));
  EXPECT_EQ(remove_stale_temporaries(folder.path()), 0);
  ::close(held);
  EXPECT_EQ(remove_stale_temporaries(folder.path()), 1) << "let go now";
  EXPECT_EQ(folder.read("target"), "precious");
  EXPECT_EQ(remove_stale_temporaries(folder / "none"), 0);
}

TEST(StaleTemporaries, go_when_their_process_is_gone_and_the_folder_is_cleaned) {
  const TempFolder folder;
  folder.write(name_of(dead_process()), "half a project");
  ASSERT_TRUE(write_file(folder / "a", std::string_view("first")).ok());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "only who asks for it cleans";
  WriteOptions options;
  options.clean_folder = true;
  const std::string_view text = "second";
  ASSERT_TRUE(write_file(folder / "a", std::as_bytes(std::span(text.data(), text.size())), options).ok());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  EXPECT_EQ(folder.read("a"), "second");
}

TEST(StaleTemporaries, that_are_being_written_are_left_alone_by_others_who_write) {
  const TempFolder folder;
  std::vector<std::jthread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&folder, i] {
      WriteOptions options;
      options.clean_folder = options.keep_previous = true;
      const std::string text(100'000, static_cast<char>('a' + i));
      for (int k = 0; k < 20; ++k)
        EXPECT_TRUE(
            write_file(folder / ("file" + std::to_string(i % 2)), std::as_bytes(std::span(text)), options).ok());
    });
  writers.clear();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 4) << "two files and what they were before";
}

} // namespace
} // namespace oversketch
