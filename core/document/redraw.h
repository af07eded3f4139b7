#pragma once

#include "core/base/result.h"
#include "core/document/document.h"
#include "core/geometry/oversketch.h"

namespace oversketch {

/// Draws a part of one of the layer's curves over again (oversketch()) and takes the pins on that curve along: an end
/// on the kept part stays, to the bit; one on the replaced part goes to the nearest place of the new part, and the pin
/// is dropped when that is further than kPinReach of the new length away, or when it would stand where another pin does
/// or out of order.
///
/// @param curve  &Layer::outline or &Layer::sketch, and `end` the pins' end on it.
/// @param stroke, options  in the curve's own space; options.pin_s is filled in here.
/// @errors those of oversketch(); the layer is unchanged then.
Result<void> redraw(Layer& layer, Points Layer::*curve, Point Pin::*end, const Points& stroke,
                    OversketchOptions options);

} // namespace oversketch
