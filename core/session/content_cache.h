#pragma once

#include "core/base/hash.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace oversketch {

/// The last few results of one kind, found by the hash of what they were made from.  The least recently used one goes
/// first.
/// @threads one at a time.
template <class T>
class ContentCache {
public:
  explicit ContentCache(std::size_t capacity) : capacity_(capacity) {}

  /// Holds at least so many from now on.
  void grow(std::size_t capacity) { capacity_ = std::max(capacity_, capacity); }

  std::shared_ptr<const T> find(const Hash& key) {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.first == key; });
    if (found == entries_.end()) return nullptr;
    std::rotate(entries_.begin(), found, found + 1);
    return entries_.front().second;
  }

  std::shared_ptr<const T> put(const Hash& key, std::shared_ptr<const T> value) {
    if (entries_.size() >= capacity_) entries_.pop_back();
    entries_.insert(entries_.begin(), {key, std::move(value)});
    return entries_.front().second;
  }

  /// Drops now what the next put() would drop, for what it is made of; null where that would drop nothing, or something
  /// that is in use.
  std::shared_ptr<const T> drop_last() {
    if (entries_.size() < capacity_ || entries_.empty() || entries_.back().second.use_count() > 1) return nullptr;
    std::shared_ptr<const T> last = std::move(entries_.back().second);
    entries_.pop_back();
    return last;
  }

private:
  std::size_t capacity_;
  std::vector<std::pair<Hash, std::shared_ptr<const T>>> entries_;
};

} // namespace oversketch
