#pragma once

#include "core/geometry/point.h"
#include "core/mesh/quad_mesh.h"
#include "core/warp/row_kernels.h"

#include <array>
#include <vector>

namespace oversketch {

/// From points of one deformed cell back to the source, or to anything else that is given at its corners.
///
/// Convex cells of either orientation: the inverse of x(u, v) = p0 + u a + v b + uv c with a = p1 − p0, b = p3 − p0,
/// c = p0 − p1 + p2 − p3.  Crossing x − p0 − v b with a + v c gives a quadratic whose root inside the cell is, with
/// q = x − p0, D = a × b, B = D + q × c and s = √(B² − 4 (c × b)(q × a)) (s is det J at the point),
///   v = 2 a × q / (B + s),   u = 2 q × b / (2D − B + s);
/// both denominators are twice a det J inside the cell, hence positive, and nothing cancels when c → 0.
/// Other cells: two triangles, the barycentric coordinates in the one that holds the point best.
class CellInverse {
public:
  /// A place in the cell: in its only part where it is convex, else in one of two triangles.
  struct Place {
    int part = 0;
    double u = 0;
    double v = 0;
  };

  CellInverse(const QuadMesh& mesh, const Points& deformed, int cell);

  bool is_convex() const { return triangles_.empty(); }
  /// Whether it is convex, a parallelogram in the source, and no corner's det J is farther than 4 times from D.
  bool is_gentle() const { return gentle_; }
  /// Of a convex cell, for the pixel centres (x + 0.5 + i, y + 0.5).
  RowInverse row(int x, int y) const;
  /// The same of a gentle cell.
  GentleRow gentle_row(int x, int y) const;
  /// About how far apart the source points of a pixel and the one below lie in a gentle cell; elsewhere 0.
  Point step_down() const { return step_y_; }
  /// Outside the cell the formula goes on, and may give anything, not-a-number included.
  Place locate(Point p) const;
  /// What `place` grows by for a step in the plane, linearly.
  Point growth(const Place& place, Point step) const;

  /// The function on a part of the cell that has these values at the cell's corners.
  BilinearForm form(int part, const std::array<Point, 4>& at_corners) const;
  /// The one that gives the source point.
  const BilinearForm& source(int part) const { return source_[static_cast<std::size_t>(part)]; }
  /// The source point of `p`.
  Point operator()(Point p) const;

private:
  /// Barycentric coordinates 1 and 2 are dot(weight, x − from); `usable` unless the triangle has no area.
  struct Triangle {
    bool usable = false;
    Point from, weight_1, weight_2;

    double least_weight(Point p) const;
  };

  void set_gentle();
  static Triangle make_triangle(Point a, Point b, Point c);

  bool mirrored_ = false;
  bool gentle_ = false;
  /// The corner at which both triangles begin.
  int diagonal_from_ = 0;
  Point p0_, a_, b_, c_;
  double area_ = 0;
  /// Of a gentle cell: what the source's affine part and the three crossings, divided by D, grow by from pixel to
  /// pixel.
  Point step_x_, step_y_, step_e_, step_u_, step_v_;
  double kappa_ = 0;
  std::array<BilinearForm, 2> source_;
  /// Two; none in a convex cell.
  std::vector<Triangle> triangles_;
};

} // namespace oversketch
