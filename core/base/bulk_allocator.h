#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace oversketch {

/// Memory for much at once: where the system can, in pages so large that fetching and finding them costs little.
/// @throws std::bad_alloc.
void* allocate_bulk(std::size_t bytes);
void free_bulk(void* memory) noexcept;

/// For vectors of plain values: values made without arguments are left as the memory is, not set to anything.
template <class T>
struct BulkAllocator {
  using value_type = T;

  BulkAllocator() = default;
  template <class U>
  explicit BulkAllocator(const BulkAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_bulk(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t) noexcept { free_bulk(memory); }

  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    std::construct_at(at, std::forward<Args>(args)...);
  }

  bool operator==(const BulkAllocator&) const = default;
};

} // namespace oversketch
