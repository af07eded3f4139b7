#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace oversketch {

/// Rows in up to `parts` parts one after the other, with about as many pixels each; none is empty.
/// @param size_of  the pixels of a row.
template <class Row, class SizeOf>
std::vector<std::span<const Row>> cut_rows(std::span<const Row> rows, int parts, SizeOf size_of) {
  std::size_t left = 0;
  for (const Row& row : rows)
    left += static_cast<std::size_t>(size_of(row));
  std::vector<std::span<const Row>> out;
  for (int part = std::max(1, parts); part >= 1 && !rows.empty(); --part) {
    const std::size_t share = left / static_cast<std::size_t>(part);
    std::size_t taken = 0, end = 0;
    while (end < rows.size() && (taken < share || end == 0 || part == 1))
      taken += static_cast<std::size_t>(size_of(rows[end++]));
    out.push_back(rows.first(end));
    rows = rows.subspan(end);
    left -= taken;
  }
  return out;
}

} // namespace oversketch
