#include "core/clone/membrane.h"

#include "core/base/check.h"
#include "core/base/index.h"
#include "core/clone/float_factor.h"
#include "core/clone/membrane_matrix.h"
#include "core/clone/pixel_solver.h"
#include "core/clone/quadtree.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace oversketch {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

class Factor : public Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
public:
  /// Multiplications that factorize() takes, once the pattern is analyzed.
  double operations() const {
    return m_nonZerosPerCol.unaryExpr([](int below) { return (below + 1.0) * (below + 1.0); }).sum();
  }
};

template <class T>
std::int64_t size_of(const std::vector<T>& values) {
  return static_cast<std::int64_t>(values.capacity() * sizeof(T));
}

/// The leaf at the inner end of each of the ring's edges.
std::vector<int> find_ring_leaves(const PixelGraph& graph, const Quadtree& tree) {
  std::vector<int> leaves;
  leaves.reserve(graph.ring.size());
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  std::size_t run = 0;
  for (const PixelGraph::RingEdge& edge : graph.ring) {
    while (run + 1 < runs.size() && graph.first[run + 1] <= edge.pixel)
      ++run;
    leaves.push_back(tree.find(runs[run].x0 + edge.pixel - graph.first[run], runs[run].y));
  }
  return leaves;
}

/// What making takes at its peak, at most.  Smooth shapes have 4.5, 7.5 and 13 unknowns for each edge of the ring.
std::int64_t estimate_bytes(const PixelGraph& graph, int k) {
  const auto unknowns = (2 + 3 * k) * static_cast<std::int64_t>(graph.ring.size());
  return PixelSolver::estimate_bytes(std::min<std::int64_t>(unknowns, graph.count));
}

/// Whether it is clear before the matrix is made that its factor would cost too much: few leaves are larger than a
/// pixel, and there are holes all over, so that the matrix does not fall apart into narrow parts either.
bool is_crowded(const PixelGraph& graph, const Quadtree& tree) {
  constexpr int kMany = 50'000, kUnknownsPerHole = 1000;
  // By Euler's formula for runs and where they touch; less by one for each part of the mask but the first.
  const std::int64_t holes =
      static_cast<std::int64_t>(graph.stretches.size()) - static_cast<std::int64_t>(graph.mask.runs().size()) + 1;
  return tree.unknowns > kMany && tree.unknowns > 0.45 * graph.count && holes > tree.unknowns / kUnknownsPerHole;
}

/// Whether the factor is worth some ten solves on the pixels, or is cheap.  Measured: to 1400 operations a pixel for
/// smooth shapes, snakes, and such with some large holes; from 2500 up where small holes are everywhere, and the more
/// the larger the mask.
bool pays(double operations, int pixels) {
  constexpr double kCheap = 3e7, kPerPixel = 2000;
  return operations < std::max(kCheap, kPerPixel * pixels);
}

Error no_membrane() {
  return {"clone.no-membrane", "The region has so long an edge that only a solve on its pixels pays.", ""};
}

} // namespace

struct Membrane::Data {
  /// The mean of the solution at two places.
  using Mean = std::array<int, 2>;

  int k = 0;
  FloatFactor factor;
  /// Where the solution stands in the factor's order: of each ring edge; of each single pixel; of the corners of each
  /// patch.  −1 − m stands for the m-th mean.
  std::vector<int> ring;
  std::vector<int> pixels;
  std::vector<std::array<int, 4>> patches;
  std::vector<Mean> means;
  std::vector<int> sizes;
  std::vector<Segment> segments;
  std::vector<int> run_segment;
};

class Membrane::Maker {
public:
  explicit Maker(const Quadtree& tree) : tree_(tree) {}

  /// @param slot  of each unknown, in the factor's order.
  Data make(int k, const Matrix& lower, const int* slot, const std::vector<int>& ring_leaves) {
    Data data{k, FloatFactor(lower), {}, {}, {}, {}, {}, {}, {}};
    place_points(data, slot);
    data.ring.reserve(ring_leaves.size());
    for (const int leaf : ring_leaves)
      data.ring.push_back(place_[index(leaf)]);
    add_leaves(data);
    link_segments(data);
    for (std::size_t run = 0; run < tree_.first_leaf.size(); ++run)
      data.run_segment.push_back(segment_[index(tree_.first_leaf[run])]);
    return data;
  }

private:
  void place_points(Data& data, const int* slot) {
    place_.resize(index(tree_.points));
    for (std::size_t point = 0; point < place_.size(); ++point)
      if (tree_.unknown[point] >= 0) place_[point] = slot[tree_.unknown[point]];
    for (const Quadtree::Hanging& h : tree_.hanging) {
      data.means.push_back({place_[index(h.ends[0])], place_[index(h.ends[1])]});
      place_[index(h.point)] = -static_cast<int>(data.means.size());
    }
  }

  bool goes_on(std::size_t leaf) const {
    if (leaf == 0) return false;
    const Quadtree::Leaf &a = tree_.leaves[leaf - 1], &b = tree_.leaves[leaf];
    return a.size == 1 && b.size == 1 && a.y == b.y && a.x + 1 == b.x;
  }

  void add_leaves(Data& data) {
    segment_.resize(tree_.leaves.size());
    for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
      const Quadtree::Leaf& leaf = tree_.leaves[i];
      if (leaf.size > 1) {
        data.segments.push_back({static_cast<int>(data.patches.size()), leaf.size, leaf.y, {-1, -1}, true});
        const auto& [right, below, across] = tree_.corners[i];
        data.patches.push_back({place_[i], place_[index(right)], place_[index(below)], place_[index(across)]});
        data.sizes.push_back(leaf.size);
      } else {
        // Leaves of one row are numbered from left to right: a segment's pixels are one after the other.
        if (goes_on(i))
          ++data.segments.back().length;
        else
          data.segments.push_back({static_cast<int>(data.pixels.size()), 1, leaf.y, {-1, -1}, false});
        data.pixels.push_back(place_[i]);
      }
      segment_[i] = static_cast<int>(data.segments.size()) - 1;
    }
  }

  void link_segments(Data& data) {
    for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
      const auto [x, y, size] = tree_.leaves[i];
      Segment& segment = data.segments[index(segment_[i])];
      if (size == 1) {
        if (i + 1 < tree_.leaves.size() && goes_on(i + 1)) continue;
        segment.next = {right_of(x + 1, y, 1), -1};
        continue;
      }
      segment.next = {right_of(x + size, y, size), right_of(x + size, y + size / 2, size)};
    }
  }

  /// The segment of the leaf that holds a pixel next to the right edge of a leaf of that size.
  int right_of(int x, int y, int size) const {
    if (const int leaf = tree_.find(x, y); leaf >= 0) return segment_[index(leaf)];
    // It begins higher up: half a leaf, a leaf, or both.
    for (const int up : {size / 2, size, size + size / 2})
      if (const int leaf = tree_.find(x, y - up); leaf >= 0 && tree_.leaf(leaf).size > up) return segment_[index(leaf)];
    return -1;
  }

  const Quadtree& tree_;
  /// Of each point, of each leaf.
  std::vector<int> place_;
  std::vector<int> segment_;
};

Membrane::Membrane(std::shared_ptr<const Data> data)
    : data_(std::move(data)), segments_(data_->segments), run_segment_(data_->run_segment) {}

Result<Membrane> Membrane::make(const PixelGraph& graph, int k, const Watch& watch) {
  if (graph.count == 0) return Error{"clone.empty-mask", "The region covers no pixel: make it larger.", ""};
  CHECK(k == 1 || k == 2 || k == 4, "a membrane of known accuracy");
  if (estimate_bytes(graph, k) > PixelSolver::kMostBytes) return no_membrane();
  const Quadtree tree(graph.mask, k);
  if (watch.stopped()) return cancelled();
  if (is_crowded(graph, tree)) return no_membrane();
  const std::vector<int> ring_leaves = find_ring_leaves(graph, tree);
  const Matrix a = membrane_matrix(tree, ring_leaves);
  if (watch.stopped()) return cancelled();
  Factor factor;
  factor.analyzePattern(a);
  if (watch.stopped()) return cancelled();
  if (!pays(factor.operations(), graph.count)) return no_membrane();
  factor.factorize(a);
  CHECK(factor.info() == Eigen::Success, "the energy is positive definite");
  if (watch.stopped()) return cancelled();
  return Membrane(std::make_shared<const Data>(
      Maker(tree).make(k, factor.matrixL().nestedExpression(), factor.permutationP().indices().data(), ring_leaves)));
}

int Membrane::k() const {
  return data_->k;
}

int Membrane::unknowns() const {
  return data_->factor.size();
}

std::int64_t Membrane::bytes() const {
  const Data& d = *data_;
  return d.factor.bytes() + size_of(d.ring) + size_of(d.pixels) + size_of(d.patches) + size_of(d.means) +
         size_of(d.sizes) + size_of(d.segments) + size_of(d.run_segment);
}

MembraneValues Membrane::solve(std::span<const Float4> ring) const {
  const Data& d = *data_;
  CHECK(ring.size() == d.ring.size(), "one value for each edge of the ring");
  const std::size_t n = index(d.factor.size());
  // The means stand before the solution: place p is x[p] for negative p too.
  std::vector<Float4> values(d.means.size() + n);
  Float4* const x = values.data() + d.means.size();
  for (std::size_t i = 0; i < ring.size(); ++i)
    x[d.ring[i]] += ring[i];
  d.factor.substitute(x);
  for (std::size_t m = 0; m < d.means.size(); ++m)
    x[-1 - static_cast<std::ptrdiff_t>(m)] = 0.5F * (x[d.means[m][0]] + x[d.means[m][1]]);

  MembraneValues out;
  out.pixels.resize(d.pixels.size());
  for (std::size_t i = 0; i < d.pixels.size(); ++i)
    out.pixels[i] = x[d.pixels[i]];
  out.patches.resize(d.patches.size());
  for (std::size_t i = 0; i < d.patches.size(); ++i) {
    const auto& [first, right, below, across] = d.patches[i];
    const float step = 1.0F / static_cast<float>(d.sizes[i]);
    const Float4 along = x[right] - x[first];
    out.patches[i] = {x[first], step * along, step * (x[below] - x[first]),
                      step * step * (x[across] - x[below] - along)};
  }
  return out;
}

double Membrane::error_share() const {
  // Half the largest row sum of |error| over one unit on the ring after the other, against the exact solution: 0.033,
  // 0.0099, 0.0034 at most for blobs, squares, snakes and masks with holes of 2¹⁴ and 2¹⁶ pixels; rounded up.
  switch (k()) {
  case 1:
    return 0.04;
  case 2:
    return 0.012;
  default:
    return 0.004;
  }
}

} // namespace oversketch
