#include "core/image/raster_memory.h"

#include <cstdint>
#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace oversketch {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
/// Below it half a huge page more would be felt.
constexpr std::size_t kLarge = 4 * kHugePage;

} // namespace

void* allocate_raster(std::size_t bytes) {
#if defined(__linux__)
  if (bytes >= kLarge && bytes <= SIZE_MAX - kHugePage) {
    const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    void* memory = std::aligned_alloc(kHugePage, whole);
    if (memory == nullptr) throw std::bad_alloc();
    // Without huge pages it is memory as good as any.
    (void)madvise(memory, whole, MADV_HUGEPAGE);
    return memory;
  }
#endif
  return ::operator new(bytes);
}

void free_raster(void* memory, std::size_t bytes) noexcept {
#if defined(__linux__)
  if (bytes >= kLarge && bytes <= SIZE_MAX - kHugePage) return std::free(memory);
#endif
  ::operator delete(memory);
}

} // namespace oversketch
