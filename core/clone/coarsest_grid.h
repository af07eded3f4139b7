#pragma once

#include "core/clone/grid_level.h"

#include <cstdint>
#include <memory>

namespace oversketch {

/// The matrix of a small grid, factored (sparse Cholesky).
/// @threads const after making.
class CoarsestGrid {
public:
  explicit CoarsestGrid(const GridLevel& level);
  ~CoarsestGrid();
  CoarsestGrid(CoarsestGrid&&) noexcept;
  CoarsestGrid& operator=(CoarsestGrid&&) noexcept;

  /// kGridChannels floats a slot.
  void solve(const float* b, float* u) const;
  std::int64_t bytes() const;

private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

} // namespace oversketch
