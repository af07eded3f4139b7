#include "core/warp/cell_inverse.h"

#include <cmath>
#include <utility>

namespace oversketch {

CellInverse::CellInverse(const QuadMesh& mesh, const Points& deformed, int cell) {
  std::array<Point, 4> x, s;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto vertex = static_cast<std::size_t>(mesh.cells[static_cast<std::size_t>(cell)][k]);
    x[k] = deformed[vertex];
    s[k] = mesh.vertices[vertex];
  }
  std::array<double, 4> turn;
  int positive = 0, negative = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    turn[k] = cross(x[k] - x[(k + 3) % 4], x[(k + 1) % 4] - x[k]);
    positive += turn[k] > 0;
    negative += turn[k] < 0;
  }
  convex_ = positive == 4 || negative == 4;
  if (!convex_) {
    // The diagonal through the one corner that turns the other way keeps both triangles inside the cell.
    int from = 0;
    for (int k = 0; k < 4; ++k)
      if ((positive == 3 && !(turn[static_cast<std::size_t>(k)] > 0)) ||
          (negative == 3 && !(turn[static_cast<std::size_t>(k)] < 0)))
        from = k;
    make_triangles(x, s, from);
    return;
  }
  if (negative == 4) {
    std::swap(x[1], x[3]);
    std::swap(s[1], s[3]);
  }
  p0_ = x[0], a_ = x[1] - x[0], b_ = x[3] - x[0], c_ = x[0] - x[1] + x[2] - x[3];
  s0_ = s[0], sa_ = s[1] - s[0], sb_ = s[3] - s[0], sc_ = s[0] - s[1] + s[2] - s[3];
  area_ = cross(a_, b_);
}

CellInverse::Affine CellInverse::make_affine(const std::array<Point, 4>& x, const std::array<Point, 4>& s, int i, int j,
                                             int k) {
  const auto at = [](const std::array<Point, 4>& points, int n) { return points[static_cast<std::size_t>(n & 3)]; };
  const Point e1 = at(x, j) - at(x, i), e2 = at(x, k) - at(x, i);
  Affine out;
  out.from = at(x, i);
  out.origin = at(s, i);
  const double area = cross(e1, e2);
  out.weight_1 = Point{e2.y, -e2.x} / area;
  out.weight_2 = Point{-e1.y, e1.x} / area;
  out.usable = area != 0 && is_finite(out.weight_1) && is_finite(out.weight_2);
  const Point d1 = at(s, j) - at(s, i), d2 = at(s, k) - at(s, i);
  out.column_x = out.weight_1.x * d1 + out.weight_2.x * d2;
  out.column_y = out.weight_1.y * d1 + out.weight_2.y * d2;
  return out;
}

void CellInverse::make_triangles(const std::array<Point, 4>& x, const std::array<Point, 4>& s, int diagonal_from) {
  const int d = diagonal_from;
  triangles_ = {make_affine(x, s, d, d + 1, d + 2), make_affine(x, s, d, d + 2, d + 3)};
  s0_ = 0.25 * (s[0] + s[1] + s[2] + s[3]);
}

double CellInverse::Affine::least_weight(Point p) const {
  if (!usable) return -HUGE_VAL;
  const double w1 = dot(weight_1, p - from), w2 = dot(weight_2, p - from);
  return std::min(1 - w1 - w2, std::min(w1, w2));
}

const CellInverse::Affine& CellInverse::triangle_at(Point p) const {
  return triangles_[1].least_weight(p) > triangles_[0].least_weight(p) ? triangles_[1] : triangles_[0];
}

Point CellInverse::operator()(Point p) const {
  if (!convex_) {
    const Affine& triangle = triangle_at(p);
    return triangle.usable ? triangle(p) : s0_;
  }
  const Point q = p - p0_;
  const double b = area_ + cross(q, c_);
  const double s = std::sqrt(std::max(0.0, b * b - 4 * cross(c_, b_) * cross(q, a_)));
  const double v = 2 * cross(a_, q) / (b + s), u = 2 * cross(q, b_) / (2 * area_ - b + s);
  return s0_ + u * sa_ + v * sb_ + (u * v) * sc_;
}

void CellInverse::map_row(int x, int y, int count, double* source_x, double* source_y) const {
  const Point first{x + 0.5, y + 0.5};
  if (!convex_) {
    for (int i = 0; i < count; ++i) {
      const Point s = (*this)({first.x + i, first.y});
      source_x[i] = s.x, source_y[i] = s.y;
    }
    return;
  }
  // The three crossings are affine along the row, which leaves one root and one division a pixel.
  const Point q = first - p0_;
  const double b0 = area_ + cross(q, c_), v0 = cross(a_, q), u0 = cross(q, b_);
  const double db = c_.y, dv = -a_.y, du = b_.y, area2 = 2 * area_, k = 4 * cross(c_, b_);
  for (int i = 0; i < count; ++i) {
    const double b = b0 + i * db, vn = v0 + i * dv, un = u0 + i * du;
    const double s = std::sqrt(std::max(0.0, b * b + k * vn));
    const double dv_part = b + s, du_part = area2 - b + s;
    const double both = 2 / (dv_part * du_part);
    const double v = vn * du_part * both, u = un * dv_part * both;
    source_x[i] = s0_.x + u * sa_.x + v * sb_.x + (u * v) * sc_.x;
    source_y[i] = s0_.y + u * sa_.y + v * sb_.y + (u * v) * sc_.y;
  }
}

Point CellInverse::continued(Point p, Point step) const {
  if (!convex_) {
    const Affine& triangle = triangle_at(p);
    return triangle.usable ? triangle(p + step) : s0_;
  }
  const Point q = p - p0_;
  const double b = area_ + cross(q, c_);
  const double s = std::sqrt(std::max(0.0, b * b - 4 * cross(c_, b_) * cross(q, a_)));
  const double v = 2 * cross(a_, q) / (b + s), u = 2 * cross(q, b_) / (2 * area_ - b + s);
  const Point along_u = a_ + v * c_, along_v = b_ + u * c_;
  const double det = cross(along_u, along_v);
  const double du = cross(step, along_v) / det, dv = cross(along_u, step) / det;
  return s0_ + u * sa_ + v * sb_ + (u * v) * sc_ + du * (sa_ + v * sc_) + dv * (sb_ + u * sc_);
}

} // namespace oversketch
