#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/session/session.h"

#include <nlohmann/json_fwd.hpp>

namespace oversketch {

/// The contract's `metrics` object.
nlohmann::ordered_json metrics_json(const Metrics& metrics);

/// The contract's `report`: layers, history, cursor, counters.  Every region's deformation is solved if it is not yet.
/// @errors those of Session::metrics.
Result<nlohmann::ordered_json> make_report(Session& session, const Watch& watch);

} // namespace oversketch
