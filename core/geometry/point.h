#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace oversketch {

/// A point or vector in pixels: x right, y down, the first pixel's centre at (0.5, 0.5).
struct Point {
  double x = 0;
  double y = 0;

  using PackedForHash = void;
  bool operator==(const Point&) const = default;
  Point& operator+=(Point b) { return x += b.x, y += b.y, *this; }
  Point& operator-=(Point b) { return x -= b.x, y -= b.y, *this; }
  Point& operator*=(double k) { return x *= k, y *= k, *this; }
};

using Points = std::vector<Point>;

inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator-(Point a) {
  return {-a.x, -a.y};
}
inline Point operator*(double k, Point a) {
  return {k * a.x, k * a.y};
}
inline Point operator*(Point a, double k) {
  return {k * a.x, k * a.y};
}
inline Point operator/(Point a, double k) {
  return {a.x / k, a.y / k};
}

inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
/// z of the cross product: positive when b lies clockwise of a as seen on the screen (y down).
inline double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}
inline double length(Point a) {
  return std::hypot(a.x, a.y);
}
inline double distance(Point a, Point b) {
  return length(b - a);
}
inline Point lerp(Point a, Point b, double t) {
  return a + t * (b - a);
}
/// A quarter turn: (x, y) to (-y, x).
inline Point turned(Point a) {
  return {-a.y, a.x};
}
inline bool is_finite(Point a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}

inline std::complex<double> to_complex(Point a) {
  return {a.x, a.y};
}
inline Point to_point(std::complex<double> z) {
  return {z.real(), z.imag()};
}

/// z ↦ factor · z + offset in complex numbers: rotation, uniform scale and shift, never a mirror.
struct Similarity {
  std::complex<double> factor = 1.0;
  std::complex<double> offset = 0.0;

  bool operator==(const Similarity&) const = default;
  Point operator()(Point p) const { return to_point(factor * to_complex(p) + offset); }
  /// First `inner`, then this.
  Similarity after(const Similarity& inner) const { return {factor * inner.factor, factor * inner.offset + offset}; }
  /// factor must not be 0.
  Similarity inverse() const { return {1.0 / factor, -offset / factor}; }
};

inline Points transformed(const Points& points, const Similarity& by) {
  Points out;
  out.reserve(points.size());
  for (const Point p : points)
    out.push_back(by(p));
  return out;
}

/// The smallest box round some points; `empty()` when there were none.
struct Box {
  Point low{HUGE_VAL, HUGE_VAL};
  Point high{-HUGE_VAL, -HUGE_VAL};

  bool empty() const { return !(low.x <= high.x); }
  Point size() const { return high - low; }
  Point centre() const { return 0.5 * (low + high); }
  double diagonal() const { return length(size()); }
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

inline Box bounds(const Points& points) {
  Box box;
  for (const Point p : points)
    box.add(p);
  return box;
}

} // namespace oversketch
