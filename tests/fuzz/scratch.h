#pragma once

// A folder in memory for what a fuzzer has to hand over as files.

#include "tests/fuzz/fuzz.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <unistd.h>

namespace oversketch::fuzz {

/// Gone with the object; one that was left by a fuzzer that was stopped lies in memory alone.
class Scratch {
public:
  Scratch() {
    std::error_code ignored;
    const auto memory = std::filesystem::is_directory("/dev/shm", ignored) ? std::filesystem::path("/dev/shm")
                                                                           : std::filesystem::temp_directory_path();
    folder_ = memory / ("oversketch-fuzz-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }
  void write(std::string_view name, std::string_view bytes) const {
    std::ofstream file(folder_ / name, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

private:
  std::filesystem::path folder_;
};

} // namespace oversketch::fuzz
