#include "core/geometry/point_text.h"

#include <cstdio>

namespace oversketch {
namespace {

/// Beyond it tenths of a pixel would only be digits.
constexpr double kPlain_px = 1e7;

/// To a tenth, and never "-0.0".
double rounded(double v) {
  return std::round(v * 10) / 10 + 0.0;
}

} // namespace

std::string point_text(Point p) {
  char text[64];
  if (std::abs(p.x) < kPlain_px && std::abs(p.y) < kPlain_px)
    std::snprintf(text, sizeof text, "(%.1f, %.1f)", rounded(p.x), rounded(p.y));
  else
    std::snprintf(text, sizeof text, "(%.4g, %.4g)", p.x, p.y);
  return text;
}

} // namespace oversketch
