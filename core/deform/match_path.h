#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace oversketch {

/// Local costs of rows 0…rows against columns 0…columns, row by row.
struct CostTable {
  int rows = 0;
  int columns = 0;
  std::vector<float> values;

  CostTable(int row_count, int column_count)
      : rows(row_count),
        columns(column_count),
        values(static_cast<std::size_t>(row_count) * static_cast<std::size_t>(column_count)) {}
  float* row(int i) { return values.data() + static_cast<std::ptrdiff_t>(i) * columns; }
  const float* row(int i) const { return values.data() + static_cast<std::ptrdiff_t>(i) * columns; }
};

/// Columns that a path may use in each row.
struct PathBand {
  std::vector<int> low;
  std::vector<int> high;
};

/// Cheapest monotone path from (0, first) to (rows − 1, last) by the steps (1,1) (1,2) (2,1) (2,3) (3,2) (1,3) (3,1)
/// (1,4) (4,1) (1,6) (6,1), (rows, columns); a step of length l = (a + b)/2 costs l times the mean of the costs at its
/// ends plus 0.1 l log²(b/a).  Keeps its memory between calls.
/// @threads one at a time.
class PathFinder {
public:
  /// @returns the whole cost; infinite where no path leads through the band.
  float find(const CostTable& costs, const PathBand& band, int first, int last);
  /// Nodes of the path that find() measured last, (row, column), from first to last.  The table and band must be the
  /// same.
  std::vector<std::pair<int, int>> trace(const CostTable& costs, const PathBand& band, int first, int last) const;

private:
  std::vector<float> reached_;
  int stride_ = 0;
};

} // namespace oversketch
