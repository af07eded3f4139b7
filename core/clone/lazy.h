#pragma once

#include "core/base/result.h"

#include <memory>
#include <mutex>
#include <utility>

namespace oversketch {

/// A part that is made when it is first wanted, once; one that could not be made is tried again at the next call.
/// @threads any; who asks for a part that is being made waits for it.
template <class T>
class Lazy {
public:
  /// @param make  returns Result<T>.
  template <class Make>
  Result<std::shared_ptr<const T>> get(Make make) {
    const std::scoped_lock lock(making_);
    if (!part_) {
      Result<T> made = make();
      if (!made) return made.error();
      part_ = std::make_shared<const T>(std::move(*made));
    }
    return part_;
  }

  /// What get() would find; null while it is not there.  Waits for nobody: while it is being made it is not there.
  std::shared_ptr<const T> if_made() const {
    const std::unique_lock lock(making_, std::try_to_lock);
    return lock.owns_lock() ? part_ : nullptr;
  }

private:
  mutable std::mutex making_;
  std::shared_ptr<const T> part_;
};

} // namespace oversketch
