#pragma once

#include "core/geometry/mask.h"

#include <array>
#include <cstdint>
#include <vector>

namespace oversketch {

/// A mask cut into square leaves that grow with the distance from its edge, and the bilinear functions on them
/// (Agarwala 2007).
///
/// A leaf of `size` s = 2ⁱ at (x, y) holds the pixels x ≤ X < x + s, y ≤ Y < y + s; s > 1 only where all pixels up to
/// k·s + 1 rows and columns away are in the mask too.  For k ≥ 1 neighbours then differ by a factor of 2 at most, and
/// every pixel that touches the outside is a leaf of its own.  (The 1 more costs an unknown for each pixel of the edge
/// and halves the error of what is rough along it.)
///
/// A function is given by its values at points, which are pixels: each leaf's first pixel, and the other three corners
/// (x + s, y), (x, y + s), (x + s, y + s) of the leaves with s > 1.  It is bilinear between a leaf's corners.  A point
/// halfway along the edge of a larger leaf hangs: its value is the mean of the edge's ends (which never hang
/// themselves), so that the function is continuous.  The points that do not hang are the unknowns; all of them are
/// first pixels.
struct Quadtree {
  struct Leaf {
    int x = 0;
    int y = 0;
    int size = 1;
  };
  /// The mean of two other points.
  struct Hanging {
    int point = 0;
    std::array<int, 2> ends{};
  };

  /// @param k  1…16 (CHECK).
  /// @cost O(perimeter · k · log(width)), memory too; nothing the size of the box is made.
  Quadtree(const Mask& mask, int k);

  /// Row by row of their first pixels, from left to right: leaf i's first pixel is point i.
  std::vector<Leaf> leaves;
  /// Of each leaf: the points at its right, lower and diagonally opposite corner.  For a single pixel these are its
  /// neighbours to the right and below, −1 where they are outside the mask; the third is −1.
  std::vector<std::array<int, 3>> corners;
  /// All points: leaves, then hanging points that are no leaf's first pixel.
  int points = 0;
  std::vector<Hanging> hanging;
  /// Of each point: the number of its unknown, −1 where it hangs.
  std::vector<int> unknown;
  int unknowns = 0;
  /// Of each run of the mask: the leaf of its first pixel, a single one.
  std::vector<int> first_leaf;

  const Leaf& leaf(int i) const { return leaves[static_cast<std::size_t>(i)]; }
  /// The leaf whose first pixel that is, −1 if there is none.
  int find(int x, int y) const;

private:
  std::vector<int> row_start_;
  int top_ = 0;
};

} // namespace oversketch
