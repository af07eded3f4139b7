#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace oversketch {

/// A 128-bit content hash (XXH3): equal content, equal hash; not meant to withstand an adversary.
struct Hash {
  std::uint64_t low = 0;
  std::uint64_t high = 0;

  auto operator<=>(const Hash&) const = default;
};

/// 32 hexadecimal digits.
std::string to_string(const Hash& hash);

/// Collects values into one Hash; the order of the calls matters.  Lengths are hashed too, so that ("ab", "c") and
/// ("a", "bc") differ.
class Hasher {
public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  Hasher& add_bytes(const void* data, std::size_t size);
  Hasher& add(std::string_view text);
  Hasher& add(const Hash& hash);

  /// A number or enum, by its bytes.  -0.0 and 0.0 differ: a hash names bits, not values.
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Hasher& add(T value) {
    return add_bytes(&value, sizeof value);
  }

  /// An array of values without padding.
  template <class T>
  requires(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
           requires { typename T::PackedForHash; }) Hasher& add(std::span<const T> values) {
    add(values.size());
    return add_bytes(values.data(), values.size_bytes());
  }

  Hash finish() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace oversketch

/// Lets Hash be the key of an unordered container.
template <>
struct std::hash<oversketch::Hash> {
  std::size_t operator()(const oversketch::Hash& value) const noexcept { return value.low; }
};
