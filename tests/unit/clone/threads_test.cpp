// How many threads a watch allows is how many are used, and none of them changes a bit.  Threads are counted by
// standing before the C library: this program's own symbols are found first.

#include "tests/unit/clone/clone_calls.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>

namespace oversketch {
namespace {

std::atomic<int> threads_started = 0;

constexpr int kSize = 400;

/// How many threads a call started besides its own.
int count_threads(int allowed, BlendMode mode, Raster<Rgba>& out) {
  const Mask mask = rect_mask({20, 20, kSize, kSize});
  const WarpedRegion source = region_for(mask, 1);
  const auto system = CloneSystem::make(mask);
  EXPECT_TRUE(system.ok());
  Watch watch;
  watch.threads = allowed;
  const int before = threads_started;
  const auto done = clone_into(out, source, 3, 5, *system, with_mode(mode), CloneQuality::kExport, watch);
  EXPECT_TRUE(done.ok());
  return threads_started - before;
}

TEST(Threads, are_as_many_as_the_watch_allows_with_the_same_bits) {
  for (const BlendMode mode : {BlendMode::kImport, BlendMode::kMixed}) {
    const Raster<Rgba> target(500, 500, {0.25F, 0.5F, 0.75F, 1});
    Raster<Rgba> alone = target;
    EXPECT_EQ(count_threads(1, mode, alone), 0);
    EXPECT_NE(alone, target);
    for (const int allowed : {2, 5}) {
      Raster<Rgba> shared = target;
      EXPECT_GT(count_threads(allowed, mode, shared), 0) << allowed;
      EXPECT_EQ(shared, alone) << allowed;
    }
  }
}

} // namespace
} // namespace oversketch

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*work)(void*), void* with) {
  using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  ++oversketch::threads_started;
  return reinterpret_cast<Create*>(dlsym(RTLD_NEXT, "pthread_create"))(thread, how, work, with);
}
