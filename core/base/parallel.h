#pragma once

#include <functional>

namespace oversketch {

/// Calls work(0) … work(count − 1), each once, on up to `threads` threads of which the calling one is the first;
/// returns when all are done.  Which thread takes which index is left to chance, so results must not depend on it.
///
/// Fewer threads are used where the system gives no more.  What `work` throws is thrown here, the first of it, after
/// the calls that had begun are done; indices not begun by then are left out.
/// @param threads  1 or less: all on the calling thread, in order.
/// @cost about 50 µs a thread that is started.
void run_parallel(int count, int threads, const std::function<void(int)>& work);

} // namespace oversketch
