#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace oversketch {

void run_parallel(int count, int threads, const std::function<void(int)>& work) {
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto take_turns = [&] {
    try {
      for (int i = next++; i < count; i = next++)
        work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  try {
    for (int i = 1; i < std::min(threads, count); ++i)
      others.emplace_back(take_turns);
  } catch (const std::system_error&) {
    // Those that were started are enough.
  }
  take_turns();
  others.clear();
  if (thrown) std::rethrow_exception(thrown);
}

} // namespace oversketch
