#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"

#include <functional>
#include <string_view>
#include <vector>

namespace oversketch {

/// Runs independent jobs on the caller's thread and up to `threads` − 1 more, begun in their order.
///
/// Progress is told from the caller's thread.  What a job throws (no memory) becomes an error.
/// @returns the error of the first job, in their order, that failed; after one failed or the watch stopped no other is
///   begun.
/// @errors those of the jobs; cancelled; memory.
Result<void> run_jobs(const std::vector<std::function<Result<void>()>>& jobs, int threads, const Watch& watch,
                      std::string_view stage);

/// Threads that work here is worth: `wanted`, or as many as there are cores where it is 0, between 1 and 4.
int choose_threads(int wanted);

} // namespace oversketch
