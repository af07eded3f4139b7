#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/float4.h"
#include "core/clone/pixel_graph.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace oversketch {

/// A function on the pixels of a mask, bilinear on the leaves of a quadtree: what Membrane::solve gives.
struct MembraneValues {
  /// u = corner + i · right + j · (down + i · across) at column i, row j of a leaf.
  struct Patch {
    Float4 corner, right, down, across;
  };
  /// Of the leaves of one pixel, and of all others.
  std::vector<Float4> pixels;
  std::vector<Patch> patches;
};

/// Solves Δu = 0 inside a mask for given u on the ring of pixels round it, nearly: with the functions of a Quadtree in
/// place of all functions on the pixels, and the pixel graph's own energy (Galerkin).
///
/// Cost and memory follow the mask's perimeter, as long as most of the mask is far from its edge.  Where holes are
/// everywhere no leaf is large, and a factor would cost far more than solving on every pixel: there a membrane is
/// refused, by the mask alone.  The error is that of the space: it falls with k and grows with what the given values
/// jump along the ring, see error_share.  Constant and linear functions are exact to a float's rounding.
///
/// Copies share the factor.
/// @threads const after making; one object may be used by several threads.
class Membrane {
public:
  /// @param k  1, 2 or 4 (CHECK): leaves are at most as large as their distance from the edge, divided by k.
  /// @param graph  of the mask; needed here only.
  /// @errors clone.empty-mask; clone.no-membrane (it does not pay: see above; or by the length of the edge, before
  ///   anything is made, its memory is too much); cancelled.
  /// @cost for k = 1, 2, 4 on one core 10, 19, 39 ms and 1.4, 2.7, 6 MB for a smooth shape of 2¹⁸ pixels; twice
  ///   that for four times as many.
  static Result<Membrane> make(const PixelGraph& graph, int k, const Watch& watch = {});

  int k() const;
  int unknowns() const;
  /// Of all that is kept.
  std::int64_t bytes() const;

  /// @param ring  u at the outer pixel of each of the graph's ring edges; as many (CHECK).
  /// @cost two passes over the factor.
  MembraneValues solve(std::span<const Float4> ring) const;

  /// Walks along a run of the mask: calls `pixels(at, count)` with the values of single pixels one after the other and
  /// `ramp(value, step, count)` for value, value + step, value + 2 step…, from left to right.
  /// @param run  its number in the mask;  @param y  its row.
  template <class Pixels, class Ramp>
  void walk(const MembraneValues& values, std::size_t run, int y, Pixels pixels, Ramp ramp) const;

  /// The most that u is off in any pixel where the ring's values lie within a range of 1, the worst of all such values.
  /// Measured; see the .cpp.
  double error_share() const;

private:
  /// A row's pixels in one leaf, or single ones that follow one another.
  struct Segment {
    /// Of the patches; of the first of the pixels.
    int values = 0;
    int length = 0;
    /// The leaf's first row; its segment to the right in the upper and in the lower half; −1 at the end of a run.
    int y = 0;
    std::array<int, 2> next{};
    bool is_patch = false;
  };
  struct Data;
  class Maker;
  explicit Membrane(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;
  std::span<const Segment> segments_;
  std::span<const int> run_segment_;
};

template <class Pixels, class Ramp>
void Membrane::walk(const MembraneValues& values, std::size_t run, int y, Pixels pixels, Ramp ramp) const {
  for (int at = run_segment_[run]; at >= 0;) {
    const Segment& segment = segments_[static_cast<std::size_t>(at)];
    if (!segment.is_patch) {
      pixels(&values.pixels[static_cast<std::size_t>(segment.values)], segment.length);
      at = segment.next[0];
      continue;
    }
    const MembraneValues::Patch& patch = values.patches[static_cast<std::size_t>(segment.values)];
    const int row = y - segment.y;
    const auto j = static_cast<float>(row);
    ramp(patch.corner + j * patch.down, patch.right + j * patch.across, segment.length);
    at = segment.next[2 * row >= segment.length];
  }
}

} // namespace oversketch
