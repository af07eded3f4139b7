// third_party/packages.sh, with dpkg-query, apt-get, sudo and id in the hands of the test.
#include "tests/unit/frame/source_rules.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sys/wait.h>

namespace oversketch::frame {
namespace {

namespace fs = std::filesystem;

const std::string kScript = OVERSKETCH_SOURCE_DIR "/third_party/packages.sh";

struct Outcome {
  int status = 0;
  std::string printed;
  /// What the false programs were called with, one call a line.
  std::string calls;
};

class FreshMachine : public testing::Test {
protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "oversketch-set-up-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directory(folder_ / "bin");
    for (const char* tool : {"c++", "cmake", "ninja", "pkg-config"})
      add_program(tool, "");
    for (const char* tool : {"cat", "env"})
      fs::create_symlink(fs::exists(fs::path("/usr/bin") / tool) ? fs::path("/usr/bin") / tool
                                                                 : fs::path("/bin") / tool,
                         folder_ / "bin" / tool);
    add_program("id", "echo 0");
    add_program("dpkg-query", "cat '" + (folder_ / "installed").string() + "'");
    add_program("apt-get", "echo \"apt-get $* ($DEBIAN_FRONTEND)\" >> '" + (folder_ / "calls").string() + "'");
    ASSERT_EQ(std::system(("/bin/bash -c 'source \"" + kScript +
                           "\"; printf \"installed %s\\n\" ${build_packages[@]}; "
                           "echo config-files libgtest-dev' > '" +
                           (folder_ / "installed").string() + "'")
                              .c_str()),
              0);
  }

  void TearDown() override { fs::remove_all(folder_); }

  void add_program(const std::string& name, const std::string& body) {
    const fs::path path = folder_ / "bin" / name;
    std::ofstream(path) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(path, fs::perms::owner_all);
  }

  void remove_program(const std::string& name) { fs::remove(folder_ / "bin" / name); }

  Outcome install(const std::string& further = "") {
    const std::string printed = (folder_ / "printed").string();
    const std::string command = "PATH='" + (folder_ / "bin").string() + "' /bin/bash -c 'set -euo pipefail; source \"" +
                                kScript + "\"; install_missing_packages " + further + "' > '" + printed +
                                "' 2>&1 < /dev/null";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_text(printed), read_text(folder_ / "calls")};
  }

  fs::path folder_;
};

TEST_F(FreshMachine, NoAptSaysWhatIsMissing) {
  remove_program("apt-get");
  remove_program("dpkg-query");
  remove_program("ninja");
  remove_program("c++");
  const Outcome outcome = install();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.printed.find("--no-install-recommends g++ ninja-build\n"), std::string::npos) << outcome.printed;
}

TEST_F(FreshMachine, NeitherRootNorSudoSaysWhatIsMissing) {
  add_program("id", "echo 1000");
  const Outcome outcome = install("libgtest-dev");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.printed.find("neither root nor sudo"), std::string::npos) << outcome.printed;
  EXPECT_NE(outcome.printed.find("--no-install-recommends libgtest-dev\n"), std::string::npos) << outcome.printed;
  EXPECT_EQ(outcome.calls, "");
}

TEST_F(FreshMachine, FailingAptSaysWhatIsMissing) {
  add_program("apt-get", "echo E: no network; exit 100");
  const Outcome outcome = install("libgtest-dev");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.printed.find("apt-get failed"), std::string::npos) << outcome.printed;
  EXPECT_NE(outcome.printed.find("--no-install-recommends libgtest-dev\n"), std::string::npos) << outcome.printed;
}

TEST_F(FreshMachine, NothingMissingAsksNobody) {
  add_program("sudo", "echo sudo >> '" + (folder_ / "calls").string() + "'");
  add_program("id", "echo 1000");
  const Outcome outcome = install();
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.printed, "");
  EXPECT_EQ(outcome.calls, "");
}

TEST_F(FreshMachine, InstallsWhatIsMissingAlone) {
  remove_program("cmake");
  const Outcome outcome = install("libgtest-dev"); // removed, its settings kept: not installed
  EXPECT_EQ(outcome.status, 0) << outcome.printed;
  EXPECT_EQ(outcome.calls,
            "apt-get update -q (noninteractive)\n"
            "apt-get install -q -y --no-install-recommends -o DPkg::Lock::Timeout=300 cmake libgtest-dev "
            "(noninteractive)\n");
}

TEST_F(FreshMachine, WithoutTerminalSudoMayNotAsk) {
  add_program("id", "echo 1000");
  add_program("sudo", "echo \"sudo $*\" >> '" + (folder_ / "calls").string() + "'\nshift\n\"$@\"");
  const Outcome outcome = install("libgtest-dev");
  EXPECT_EQ(outcome.status, 0) << outcome.printed;
  EXPECT_NE(outcome.calls.find("sudo -n env DEBIAN_FRONTEND=noninteractive apt-get install"), std::string::npos)
      << outcome.calls;
}

/// The -dev packages a text names.
std::set<std::string> find_packages(const std::string& text) {
  const std::regex package(R"(\b[a-z0-9]+(-?[a-z0-9.]+)*-dev\b)");
  std::set<std::string> packages;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), package); match != std::sregex_iterator(); ++match)
    packages.insert(match->str());
  return packages;
}

TEST(Packages, ScriptCMakeAndReadmeNameTheSame) {
  const fs::path folder = fs::path(OVERSKETCH_SOURCE_DIR) / "third_party";
  auto packages = find_packages(read_text(folder / "packages.sh"));
  EXPECT_GE(packages.size(), 8U);
  EXPECT_EQ(packages, find_packages(read_text(folder / "README.md")));
  // Clang's own library is found by Clang.
  packages.erase("libclang-rt-dev");
  EXPECT_EQ(packages, find_packages(read_text(folder / "CMakeLists.txt")));
}

} // namespace
} // namespace oversketch::frame
