#include "core/base/watch.h"

#include <algorithm>
#include <thread>

namespace oversketch {

void StageTimes::add(std::string_view stage, double ms) {
  const auto found =
      std::find_if(stages_ms.begin(), stages_ms.end(), [&](const auto& entry) { return entry.first == stage; });
  if (found != stages_ms.end())
    found->second += ms;
  else
    stages_ms.emplace_back(stage, ms);
}

double StageTimes::total_ms() const {
  double sum = 0;
  for (const auto& [stage, ms] : stages_ms)
    sum += ms;
  return sum;
}

int Watch::threads_up_to(int most) const {
  return std::clamp(threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()), 1,
                    std::max(1, most));
}

Error cancelled() {
  return {"cancelled", "stopped before it was done", ""};
}

void StageTimer::stop() {
  if (times_ == nullptr) return;
  times_->add(stage_, std::chrono::duration<double, std::milli>(Clock::now() - start_).count());
  times_ = nullptr;
}

} // namespace oversketch
