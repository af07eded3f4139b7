#pragma once

#include "core/geometry/point.h"

#include <string>

namespace oversketch {

/// A place for an error's sentence: "(12.5, -3.0)", to a tenth of a pixel; far beyond any picture "(1e+30, 0)", to four
/// digits.
std::string point_text(Point p);

} // namespace oversketch
