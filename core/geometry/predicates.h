#pragma once

#include "core/geometry/point.h"

namespace oversketch {

/// Sign of the turn from a→b to a→c, that is of cross(b − a, c − a): +1 clockwise on the screen, −1 counter-clockwise,
/// 0 exactly when the three points lie on one line.
///
/// Exact: computed in double, and where its error bound does not settle the sign, again without rounding, as a sum of
/// products split into value and error (J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
/// Geometric Predicates, 1997).  Holds where no product over- or underflows: coordinates 0 or 10⁻¹⁴⁰…10¹⁴⁰.
/// @cost about 2 ns; about 200 ns where the points are within rounding of one line.
int orientation(Point a, Point b, Point c);

/// Whether the closed segments a…b and c…d have a point in common, ends included.  Exact; none may have length 0.
bool segments_touch(Point a, Point b, Point c, Point d);

/// Whether the line a→b→c turns straight back at b: the only way in which two segments that share an end have more than
/// that end in common.  Exact.
bool folds_back(Point a, Point b, Point c);

} // namespace oversketch
