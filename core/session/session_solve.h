#pragma once

#include "core/base/hash.h"
#include "core/session/session.h"

namespace oversketch {

/// How one layer's region is deformed: its inputs, and the solve it starts from.
struct Session::Solve {
  Layer layer;
  std::shared_ptr<const Solve> warm;
  /// Names the solution, and the deformation with the drawn mesh.
  Hash solution;
  Hash deformation;
};

} // namespace oversketch
