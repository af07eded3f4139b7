#pragma once

#include "core/geometry/point.h"
#include "core/mesh/quad_mesh.h"

#include <array>
#include <vector>

namespace oversketch {

/// From points of one deformed cell back to the source.
///
/// Convex cells of either orientation: the inverse of x(u, v) = p0 + u a + v b + uv c with a = p1 − p0, b = p3 − p0,
/// c = p0 − p1 + p2 − p3.  Crossing x − p0 − v b with a + v c gives a quadratic whose root inside the cell is, with
/// q = x − p0, D = a × b, B = D + q × c and s = √(B² − 4 (c × b)(q × a)) (s is det J at the point),
///   v = 2 a × q / (B + s),   u = 2 q × b / (2D − B + s);
/// both denominators are twice a det J inside the cell, hence positive, and nothing cancels when c → 0.
/// Other cells: two triangles, the affine map of the one that holds the point best.
class CellInverse {
public:
  CellInverse(const QuadMesh& mesh, const Points& deformed, int cell);

  /// The source point of `p`; outside the cell the formula goes on, and may give anything, not-a-number included.
  Point operator()(Point p) const;
  /// Source points of `count` pixel centres (x + 0.5 + i, y + 0.5).
  void map_row(int x, int y, int count, double* source_x, double* source_y) const;
  /// The map at `p`, continued linearly to p + step.
  Point continued(Point p, Point step) const;

private:
  /// source = origin + (x − from) through the columns of a 2×2 matrix; `usable` unless the triangle has no area.
  struct Affine {
    bool usable = false;
    Point from, origin, column_x, column_y;
    /// Barycentric coordinates 1 and 2 are dot(weight, x − from).
    Point weight_1, weight_2;

    Point operator()(Point p) const { return origin + (p.x - from.x) * column_x + (p.y - from.y) * column_y; }
    double least_weight(Point p) const;
  };

  static Affine make_affine(const std::array<Point, 4>& x, const std::array<Point, 4>& s, int i, int j, int k);
  void make_triangles(const std::array<Point, 4>& x, const std::array<Point, 4>& s, int diagonal_from);
  const Affine& triangle_at(Point p) const;

  bool convex_ = false;
  Point p0_, a_, b_, c_;
  double area_ = 0;
  Point s0_, sa_, sb_, sc_;
  /// Two; none in a convex cell.
  std::vector<Affine> triangles_;
};

} // namespace oversketch
