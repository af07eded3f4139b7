#include "core/clone/pixel_solver.h"

#include "core/base/check.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// The lower triangle of A, column by column.
Matrix lower_laplacian(const PixelGraph& graph) {
  const auto n = static_cast<std::size_t>(graph.count);
  std::vector<int> below(n, -1);
  for (const PixelGraph::Stretch& s : graph.stretches)
    for (int i = 0; i < s.length; ++i)
      below[static_cast<std::size_t>(s.upper + i)] = s.lower + i;
  std::vector<char> last(n, 0);
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t run = 0; run < runs.size(); ++run)
    last[static_cast<std::size_t>(graph.first[run] + runs[run].x1 - runs[run].x0 - 1)] = 1;

  Matrix a(graph.count, graph.count);
  a.reserve(3 * static_cast<Eigen::Index>(n));
  for (int k = 0; k < graph.count; ++k) {
    a.startVec(k);
    a.insertBack(k, k) = 4;
    if (!last[static_cast<std::size_t>(k)]) a.insertBack(k + 1, k) = -1;
    if (below[static_cast<std::size_t>(k)] >= 0) a.insertBack(below[static_cast<std::size_t>(k)], k) = -1;
  }
  a.finalize();
  return a;
}

/// x = L⁻ᵀ L⁻¹ x.  Both ways by columns, all channels at once: the factor is read from memory twice, whatever the
/// number of channels.
void substitute(const Matrix& lower, Channels* x) {
  const int* const start = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  const double* const entry = lower.valuePtr();
  const auto n = static_cast<int>(lower.cols());
  for (int j = 0; j < n; ++j) {
    const Channels value = (1 / entry[start[j]]) * x[j];
    for (int at = start[j] + 1; at < start[j + 1]; ++at)
      x[row[at]] -= entry[at] * value;
    x[j] = value;
  }
  for (int j = n - 1; j >= 0; --j) {
    Channels sum = x[j];
    for (int at = start[j] + 1; at < start[j + 1]; ++at)
      sum -= entry[at] * x[row[at]];
    x[j] = (1 / entry[start[j]]) * sum;
  }
}

} // namespace

struct PixelSolver::Data {
  explicit Data(const Mask& mask) : graph(mask) {}

  PixelGraph graph;
  Factor factor;

  const Matrix& lower() const { return factor.matrixL().nestedExpression(); }
};

std::int64_t PixelSolver::estimate_bytes(std::int64_t pixels) {
  const auto n = static_cast<double>(pixels);
  // Squares of 2¹⁶, 2¹⁸ and 2²⁰ pixels take 30, 37 and 43 entries of the factor a pixel, 12 bytes each; their peaks
  // were 530, 573 and 631 bytes a pixel.
  return static_cast<std::int64_t>(n * (120 + 27 * std::log2(std::max(2.0, n))));
}

Result<PixelSolver> PixelSolver::make(const Mask& mask, const Watch& watch, std::int64_t most_bytes) {
  if (mask.empty()) return Error{"clone.empty-mask", "The region covers no pixel: make it larger.", ""};
  const std::int64_t needed = estimate_bytes(mask.count());
  // Entries of the factor are counted in int.
  if (needed > most_bytes || needed / 12 > std::numeric_limits<int>::max())
    return Error{"clone.too-large",
                 "The region has " + std::to_string(mask.count()) + " pixels, and blending it exactly would take " +
                     std::to_string(needed / 1'000'000) + " MB of memory: make it smaller.",
                 ""};
  if (watch.stopped()) return cancelled();
  const auto data = std::make_shared<Data>(mask);
  {
    const Matrix a = lower_laplacian(data->graph);
    if (watch.stopped()) return cancelled();
    watch.report(0.0, "ordering");
    {
      const StageTimer timer(watch.times, "clone.order");
      data->factor.analyzePattern(a);
    }
    if (watch.stopped()) return cancelled();
    watch.report(0.3, "factoring");
    const StageTimer timer(watch.times, "clone.factor");
    data->factor.factorize(a);
  }
  CHECK(data->factor.info() == Eigen::Success, "the Dirichlet Laplacian is positive definite");
  if (watch.stopped()) return cancelled();
  watch.report(1.0, "factoring");
  return PixelSolver(data);
}

const PixelGraph& PixelSolver::graph() const {
  return data_->graph;
}

std::int64_t PixelSolver::bytes() const {
  return data_->lower().nonZeros() * 12 + static_cast<std::int64_t>(data_->graph.count) * 12;
}

std::vector<Channels> PixelSolver::solve(std::span<const Channels> b) const {
  CHECK(b.size() == static_cast<std::size_t>(unknowns()), "one value for each pixel");
  const int* const slot = data_->factor.permutationP().indices().data();
  std::vector<Channels> permuted(b.size());
  for (std::size_t k = 0; k < b.size(); ++k)
    permuted[static_cast<std::size_t>(slot[k])] = b[k];
  substitute(data_->lower(), permuted.data());
  std::vector<Channels> u(b.size());
  for (std::size_t k = 0; k < b.size(); ++k)
    u[k] = permuted[static_cast<std::size_t>(slot[k])];
  return u;
}

double PixelSolver::error_bound(std::span<const Channels> u, std::span<const Channels> b) const {
  CHECK(u.size() == b.size() && b.size() == static_cast<std::size_t>(unknowns()), "one value for each pixel");
  std::vector<Channels> residual(b.begin(), b.end());
  const std::vector<Mask::Run>& runs = mask().runs();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const auto first = static_cast<std::size_t>(graph().first[run]);
    const std::size_t last = first + static_cast<std::size_t>(runs[run].x1 - runs[run].x0 - 1);
    for (std::size_t k = first; k <= last; ++k) {
      residual[k] -= 4.0 * u[k];
      if (k > first) residual[k] += u[k - 1];
      if (k < last) residual[k] += u[k + 1];
    }
  }
  for (const PixelGraph::Stretch& s : graph().stretches)
    for (int i = 0; i < s.length; ++i) {
      const auto upper = static_cast<std::size_t>(s.upper + i), lower = static_cast<std::size_t>(s.lower + i);
      residual[upper] += u[lower];
      residual[lower] += u[upper];
    }
  double worst = 0;
  for (const Channels& r : residual)
    for (const double value : r.v)
      worst = std::max(worst, std::abs(value));
  const double side = std::min(mask().bounds().width, mask().bounds().height) + 1;
  return worst * side * side / 8;
}

} // namespace oversketch
