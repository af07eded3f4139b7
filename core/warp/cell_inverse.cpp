#include "core/warp/cell_inverse.h"

#include <algorithm>
#include <cmath>

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
  if (positive == 4 || negative == 4) {
    mirrored_ = negative == 4;
    const BilinearForm map = form(0, x);
    p0_ = map.o, a_ = map.a, b_ = map.b, c_ = map.c;
    area_ = cross(a_, b_);
    source_[0] = form(0, s);
    set_gentle();
    return;
  }
  // The diagonal through the one corner that turns the other way keeps both triangles inside the cell.
  for (int k = 0; k < 4; ++k)
    if ((positive == 3 && !(turn[static_cast<std::size_t>(k)] > 0)) ||
        (negative == 3 && !(turn[static_cast<std::size_t>(k)] < 0)))
      diagonal_from_ = k;
  const auto corner = [&](int k) { return x[static_cast<std::size_t>((diagonal_from_ + k) % 4)]; };
  triangles_ = {make_triangle(corner(0), corner(1), corner(2)), make_triangle(corner(0), corner(2), corner(3))};
  source_ = {form(0, s), form(1, s)};
}

void CellInverse::set_gentle() {
  // det J is linear in u and v: a × b, a × (b + c), (a + c) × b and their sum less the first at the corners.
  const double at_u = cross(a_ + c_, b_), at_v = cross(a_, b_ + c_), opposite = at_u + at_v - area_;
  const double least = std::min({at_u, at_v, opposite}), most = std::max({at_u, at_v, opposite});
  const BilinearForm& s = source_[0];
  constexpr double kParallelogram = 0x1p-30;
  gentle_ = 4 * least >= area_ && most <= 4 * area_ && std::abs(s.c.x) + std::abs(s.c.y) <= kParallelogram;
  if (!gentle_) return;
  step_e_ = Point{c_.y, -c_.x} / area_;
  step_u_ = Point{b_.y, -b_.x} / area_;
  step_v_ = Point{-a_.y, a_.x} / area_;
  step_x_ = step_u_.x * s.a + step_v_.x * s.b;
  step_y_ = step_u_.y * s.a + step_v_.y * s.b;
  kappa_ = 4 * cross(c_, b_) / area_;
}

CellInverse::Triangle CellInverse::make_triangle(Point a, Point b, Point c) {
  const Point e1 = b - a, e2 = c - a;
  const double area = cross(e1, e2);
  Triangle out{false, a, Point{e2.y, -e2.x} / area, Point{-e1.y, e1.x} / area};
  out.usable = area != 0 && is_finite(out.weight_1) && is_finite(out.weight_2);
  return out;
}

double CellInverse::Triangle::least_weight(Point p) const {
  if (!usable) return -HUGE_VAL;
  const double w1 = dot(weight_1, p - from), w2 = dot(weight_2, p - from);
  return std::min(1 - w1 - w2, std::min(w1, w2));
}

BilinearForm CellInverse::form(int part, const std::array<Point, 4>& at) const {
  if (is_convex()) {
    const Point &second = at[mirrored_ ? 3 : 1], &fourth = at[mirrored_ ? 1 : 3];
    return {at[0], second - at[0], fourth - at[0], at[0] - second + at[2] - fourth};
  }
  const auto corner = [&](int k) { return at[static_cast<std::size_t>((diagonal_from_ + k) % 4)]; };
  return {corner(0), corner(1 + part) - corner(0), corner(2 + part) - corner(0), {}};
}

RowInverse CellInverse::row(int x, int y) const {
  const Point q = Point{x + 0.5, y + 0.5} - p0_;
  return {area_ + cross(q, c_), c_.y, cross(a_, q), -a_.y, cross(q, b_), b_.y, 2 * area_, 4 * cross(c_, b_)};
}

GentleRow CellInverse::gentle_row(int x, int y) const {
  const Point q = Point{x + 0.5, y + 0.5} - p0_;
  const BilinearForm& s = source_[0];
  const auto single = [](double value) { return static_cast<float>(value); };
  return {s.o + q.x * step_x_ + q.y * step_y_,
          step_x_,
          single(dot(q, step_e_)),
          single(step_e_.x),
          single(dot(q, step_u_)),
          single(step_u_.x),
          single(dot(q, step_v_)),
          single(step_v_.x),
          single(kappa_),
          single(s.a.x),
          single(s.a.y),
          single(s.b.x),
          single(s.b.y)};
}

CellInverse::Place CellInverse::locate(Point p) const {
  if (!is_convex()) {
    const int part = triangles_[1].least_weight(p) > triangles_[0].least_weight(p) ? 1 : 0;
    const Triangle& triangle = triangles_[static_cast<std::size_t>(part)];
    if (!triangle.usable) return {part, 1.0 / 3, 1.0 / 3};
    return {part, dot(triangle.weight_1, p - triangle.from), dot(triangle.weight_2, p - triangle.from)};
  }
  const Point q = p - p0_;
  const double b = area_ + cross(q, c_);
  const double s = std::sqrt(std::max(0.0, b * b - 4 * cross(c_, b_) * cross(q, a_)));
  return {0, 2 * cross(q, b_) / (2 * area_ - b + s), 2 * cross(a_, q) / (b + s)};
}

Point CellInverse::growth(const Place& place, Point step) const {
  if (!is_convex()) {
    const Triangle& triangle = triangles_[static_cast<std::size_t>(place.part)];
    return triangle.usable ? Point{dot(triangle.weight_1, step), dot(triangle.weight_2, step)} : Point{};
  }
  const Point along_u = a_ + place.v * c_, along_v = b_ + place.u * c_;
  return Point{cross(step, along_v), cross(along_u, step)} / cross(along_u, along_v);
}

Point CellInverse::operator()(Point p) const {
  const Place place = locate(p);
  return source(place.part)(place.u, place.v);
}

} // namespace oversketch
