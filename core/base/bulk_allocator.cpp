#include "core/base/bulk_allocator.h"

#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace oversketch {
namespace {

/// Of a large page; from a few of them on they pay.
constexpr std::size_t kLargePage = std::size_t{1} << 21, kLeastBulk = 2 * kLargePage;
constexpr std::size_t kAlignment = 64;

} // namespace

void* allocate_bulk(std::size_t bytes) {
  const std::size_t alignment = bytes >= kLeastBulk ? kLargePage : kAlignment;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // A wish: where it is not granted the pages are small.
  if (bytes >= kLeastBulk) (void)madvise(memory, whole, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_bulk(void* memory) noexcept {
  std::free(memory);
}

} // namespace oversketch
