#include "core/io/jobs.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <optional>
#include <thread>

namespace oversketch {
namespace {

Result<void> run_guarded(const std::function<Result<void>()>& job) try { return job(); } catch (const std::bad_alloc&) {
  return Error{"memory", "there is not enough memory for this", ""};
} catch (const std::exception& problem) {
  return Error{"internal", problem.what(), ""};
}

} // namespace

int choose_threads(int wanted) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(wanted > 0 ? wanted : cores, 1, 4);
}

Result<void> run_jobs(const std::vector<std::function<Result<void>()>>& jobs, int threads, const Watch& watch,
                      std::string_view stage) {
  if (watch.stopped()) return cancelled();
  // Told before the first job: the others may take all of them before this thread comes to one.
  watch.report(0, stage);
  std::vector<std::optional<Error>> errors(jobs.size());
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> failed = false;
  const auto work = [&](bool tells) {
    for (std::size_t i = 0; !failed && !watch.stopped() && (i = next++) < jobs.size(); ++done) {
      if (tells) watch.report(static_cast<double>(done) / static_cast<double>(jobs.size()), stage);
      if (const auto result = run_guarded(jobs[i]); !result) errors[i] = result.error(), failed = true;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads, static_cast<int>(jobs.size())); ++i)
      helpers.emplace_back(work, false);
    work(true);
  }
  for (const auto& error : errors)
    if (error) return *error;
  if (done < jobs.size()) return cancelled();
  return {};
}

} // namespace oversketch
