#include "app/gui/frame_times.h"

#include "core/base/check.h"
#include "core/base/file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <utility>

namespace oversketch::gui {
namespace {

using Json = nlohmann::ordered_json;

double thread_time_ms() {
  timespec now{};
  CHECK(clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0, "the clocks of POSIX are there");
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Nearest rank.
Json summary(std::vector<double> times) {
  if (times.empty()) return nullptr;
  const auto worst = std::max_element(times.begin(), times.end()) - times.begin();
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(std::ceil(share * static_cast<double>(times.size()))) - 1];
  };
  return {{"median_ms", at(0.5)}, {"p95_ms", at(0.95)}, {"worst_ms", times.back()}, {"worst_frame", worst}};
}

} // namespace

void FrameTimes::spent_on(FramePart part) {
  const double now = thread_time_ms();
  now_[static_cast<std::size_t>(part)] += now - last_ms_;
  last_ms_ = now;
}

void FrameTimes::skip() {
  last_ms_ = thread_time_ms();
}

void FrameTimes::end_frame() {
  frames_.push_back(std::exchange(now_, {}));
}

Result<void> FrameTimes::write(const std::filesystem::path& path) const {
  const auto collect = [&](const auto& of) {
    std::vector<double> times(frames_.size());
    std::transform(frames_.begin(), frames_.end(), times.begin(), of);
    return summary(std::move(times));
  };
  Json json;
  json["frames"] = frames_.size();
  json["own"] = collect([](const Frame& frame) {
    return std::accumulate(frame.begin(), frame.end(), 0.0) - frame[static_cast<std::size_t>(FramePart::kDraw)];
  });
  for (std::size_t part = 0; part < kFrameParts.size(); ++part)
    json[kFrameParts[part]] = collect([&](const Frame& frame) { return frame[part]; });
  return write_file(path, json.dump(1) + "\n");
}

} // namespace oversketch::gui
