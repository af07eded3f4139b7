#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace oversketch {

/// Memory for a raster's values, aligned for them; large pieces in huge pages where the system has them, since a fresh
/// page costs more than the work on its pixels.  Throws std::bad_alloc.
void* allocate_raster(std::size_t bytes);
void free_raster(void* memory, std::size_t bytes) noexcept;

/// Lets a vector grow without setting its values: those that nobody named one for are left as they are.
template <class T>
struct RasterAllocator {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));
  using value_type = T;

  RasterAllocator() = default;
  template <class U>
  RasterAllocator(const RasterAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_raster(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { free_raster(memory, count * sizeof(T)); }
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  bool operator==(const RasterAllocator&) const = default;
};

} // namespace oversketch
