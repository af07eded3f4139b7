#pragma once

#include "core/clone/bleed.h"
#include "core/deform/deformation.h"
#include "core/document/document.h"
#include "core/session/drawn_layer.h"

#include <memory>

namespace oversketch::live {

/// Where colours will bleed into a layer, against the target alone; its samples in target pixels.  Null where nothing
/// of the layer is drawn, and in mode none, which matches nothing.
/// @cost that of forecast_bleed().
std::shared_ptr<const BleedForecast> forecast_layer(const Image& target, const Layer& layer,
                                                    const Deformation& deformation, const DrawnLayer& drawn);

} // namespace oversketch::live
