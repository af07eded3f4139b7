// The same script gives the same pictures and reports, bit for bit, in every run and on any number of threads.

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>

namespace oversketch {
namespace {

using testing::TempFolder;
namespace fs = std::filesystem;

void drop_times(nlohmann::json& value) {
  if (value.is_object())
    for (const char* name : {"wall_ms", "cpu_ms", "stages_ms"})
      value.erase(name);
  for (auto& inner : value)
    if (inner.is_structured()) drop_times(inner);
}

/// What the sample writes, by name: pictures and projects as they are, reports without their times.
std::map<std::string, std::string> run_sample(const std::string& name, const std::string& options) {
  const TempFolder out;
  const std::string line = "'" OVERSKETCH_BUILD_DIR "/bin/oversketch-cli' run '" OVERSKETCH_SOURCE_DIR
                           "/assets/samples/" +
                           name + ".jsonl' --out '" + out.path().string() + "' " + options;
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  std::map<std::string, std::string> written;
  for (const auto& entry : fs::directory_iterator(out.path())) {
    const std::string file = entry.path().filename().string();
    std::string bytes = out.read(file);
    if (entry.path().extension() == ".json") {
      auto report = nlohmann::json::parse(bytes);
      drop_times(report);
      bytes = report.dump(1);
    }
    written.emplace(file, std::move(bytes));
  }
  return written;
}

class Determinism : public ::testing::TestWithParam<const char*> {};

TEST_P(Determinism, of_runs_and_threads) {
  const auto first = run_sample(GetParam(), "--threads 1");
  EXPECT_GE(first.size(), 2u) << "a picture and a report";
  for (const char* options : {"--threads 1", "--threads 2", "--threads 5", ""}) {
    const auto again = run_sample(GetParam(), options);
    ASSERT_EQ(again.size(), first.size()) << options;
    for (const auto& [name, bytes] : first) {
      const auto found = again.find(name);
      ASSERT_NE(found, again.end()) << name << " " << options;
      EXPECT_TRUE(found->second == bytes) << name << " " << options;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, Determinism, ::testing::Values("kingfisher", "puffer"),
                         [](const auto& sample) { return std::string(sample.param); });

} // namespace
} // namespace oversketch
