#include "core/geometry/predicates.h"

#include <array>
#include <cstddef>
#include <limits>

namespace oversketch {

namespace {

int sign(double value) {
  return (value > 0) - (value < 0);
}

/// A sum of doubles kept without rounding: parts do not overlap, smallest first.
class ExactSum {
public:
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  /// The largest part outweighs all others together.
  int sign_of_sum() const { return size_ == 0 ? 0 : sign(parts_[size_ - 1]); }

private:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = value + parts_[i];
      const double other = sum - value;
      const double error = (value - (sum - other)) + (parts_[i] - other);
      if (error != 0) parts_[kept++] = error;
      value = sum;
    }
    if (value != 0) parts_[kept++] = value;
    size_ = kept;
  }

  std::array<double, 12> parts_{};
  std::size_t size_ = 0;
};

int exact_orientation(Point a, Point b, Point c) {
  ExactSum sum;
  sum.add_product(b.x, c.y);
  sum.add_product(-b.x, a.y);
  sum.add_product(-a.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(b.y, a.x);
  sum.add_product(a.y, c.x);
  return sum.sign_of_sum();
}

bool between(double low, double high, double value) {
  return low <= high ? low <= value && value <= high : high <= value && value <= low;
}

bool in_box(Point a, Point b, Point p) {
  return between(a.x, b.x, p.x) && between(a.y, b.y, p.y);
}

} // namespace

int orientation(Point a, Point b, Point c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  const double value = left - right;
  constexpr double half_ulp = std::numeric_limits<double>::epsilon() / 2;
  const double bound = (3 + 16 * half_ulp) * half_ulp * (std::abs(left) + std::abs(right));
  if (value > bound || -value > bound) return sign(value);
  return exact_orientation(a, b, c);
}

bool segments_touch(Point a, Point b, Point c, Point d) {
  const int abc = orientation(a, b, c), abd = orientation(a, b, d);
  if (abc * abd > 0) return false;
  const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (cda * cdb > 0) return false;
  if (abc != 0 || abd != 0) return true;
  return in_box(a, b, c) || in_box(a, b, d) || in_box(c, d, a);
}

bool folds_back(Point a, Point b, Point c) {
  if (orientation(a, b, c) != 0) return false;
  // On one line, so comparing one coordinate tells the direction without rounding.
  return a.x != b.x ? (c.x != b.x && (a.x < b.x) == (c.x < b.x)) : (c.y != b.y && (a.y < b.y) == (c.y < b.y));
}

} // namespace oversketch
