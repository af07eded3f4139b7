#include "core/clone/coarsest_grid.h"

#include "core/base/check.h"
#include "core/clone/grid_rows.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// The lower triangle, by slot.
Matrix matrix_of(const GridLevel& level) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> diagonal(static_cast<std::size_t>(level.count()), level.diagonal);
  for (const auto& list : level.irregular)
    for (const GridLevel::Irregular& node : list)
      diagonal[static_cast<std::size_t>(node.slot)] = level.diagonal / static_cast<double>(node.scale);
  for (int slot = 0; slot < level.count(); ++slot)
    entries.emplace_back(slot, slot, diagonal[static_cast<std::size_t>(slot)]);
  const auto connect = [&](int a, int b) { entries.emplace_back(std::max(a, b), std::min(a, b), -1.0); };
  std::vector<GridPiece> pieces;
  for (int row = 0; row < level.rows(); ++row) {
    expand_row(level, row, pieces);
    for (const GridPiece& piece : pieces)
      for (const GridPiece::Cells& cells : piece.cells)
        for (int i = 0; i < cells.count; ++i) {
          if (!(cells.opens && i == 0)) connect(cells.at + i, cells.west + i);
          if (cells.south >= 0) connect(cells.at + i, cells.south + i);
        }
  }
  Matrix a(level.count(), level.count());
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

} // namespace

struct CoarsestGrid::Data {
  Eigen::SimplicialLLT<Matrix> factor;
  int count = 0;
};

CoarsestGrid::CoarsestGrid(const GridLevel& level) {
  auto data = std::make_unique<Data>();
  data->count = level.count();
  data->factor.compute(matrix_of(level));
  CHECK(data->factor.info() == Eigen::Success, "the coarsest matrix is positive definite");
  data_ = std::move(data);
}

CoarsestGrid::~CoarsestGrid() = default;
CoarsestGrid::CoarsestGrid(CoarsestGrid&&) noexcept = default;
CoarsestGrid& CoarsestGrid::operator=(CoarsestGrid&&) noexcept = default;

void CoarsestGrid::solve(const float* b, float* u) const {
  using Values = Eigen::Matrix<float, Eigen::Dynamic, kGridChannels, Eigen::RowMajor>;
  const Eigen::Map<const Values> side(b, data_->count, kGridChannels);
  Eigen::Map<Values> solution(u, data_->count, kGridChannels);
  const Eigen::Matrix<double, Eigen::Dynamic, kGridChannels> exact = data_->factor.solve(side.cast<double>().eval());
  solution = exact.cast<float>();
}

std::int64_t CoarsestGrid::bytes() const {
  return data_->factor.matrixL().nestedExpression().nonZeros() * 12 + static_cast<std::int64_t>(data_->count) * 12;
}

} // namespace oversketch
