// What the built programs are linked with.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace oversketch::frame {
namespace {

/// Everything the command prints on stdout; "" where it fails.
std::string read_command(const std::string& command) {
  std::string printed;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::array<char, 4096> block{};
  for (std::size_t n = 0; (n = fread(block.data(), 1, block.size(), pipe)) > 0;)
    printed.append(block.data(), n);
  return pclose(pipe) == 0 ? printed : "";
}

TEST(Programs, CommandLineNeedsNoWindowSystem) {
  const std::string program = std::string(OVERSKETCH_BUILD_DIR) + "/bin/oversketch-cli";
  ASSERT_TRUE(std::filesystem::exists(program)) << program;
  const std::string libraries = read_command("ldd '" + program + "'");
  ASSERT_NE(libraries.find("libc.so"), std::string::npos) << "ldd says nothing of " << program;
  for (const char* unwanted : {"libX", "libxcb", "libGL", "libEGL", "libOpenGL", "libglfw", "libwayland"})
    EXPECT_EQ(libraries.find(unwanted), std::string::npos) << unwanted << " in\n" << libraries;
}

} // namespace
} // namespace oversketch::frame
