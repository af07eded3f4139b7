#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/session/session.h"

#include <nlohmann/json_fwd.hpp>

namespace oversketch {

/// The contract's `metrics` object.
nlohmann::ordered_json metrics_json(const Metrics& metrics);

/// The contract's `report`: layers, history, cursor, counters.  Every region's deformation is solved if it is not yet.
///
/// Besides, for each layer `pixels`: how many of the target's it paints; 0 where it is not drawn, lies outside, or is
/// so small or thin that it covers no pixel's centre.  And `bleed`, null where it is not drawn, where no part of its
/// edge lies in the target, and in mode none, which matches nothing: how well its edge matches what is below it, before
/// anything is blended (core/clone/bleed.h), in 8-bit levels and target pixels: `mean` and `worst` length of the
/// difference along the edge, `worst_at`; `shift`, the mean difference in red, green, blue, which shifts the whole
/// part; `jump` and `jump_at`, where the difference changes most, so that colours bleed inwards.
/// @errors those of Session::metrics, Session::painted_pixels and Session::bleed.
Result<nlohmann::ordered_json> make_report(Session& session, const Watch& watch);

} // namespace oversketch
