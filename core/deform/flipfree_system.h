#pragma once

#include "core/deform/flipfree.h"
#include "core/deform/flipfree_energy.h"
#include "core/deform/flipfree_handles.h"

namespace oversketch {

struct FlipfreeSystem::Data {
  RegionMesh region;
  ClosedCurve outline;
  /// region.outline() runs against `outline`.
  bool reversed = false;
  MatchSource source;
  DistortionEnergy distortion;
  std::vector<Handle> handles;
  LinearStart start;
  /// Of each point of the caller's outline.
  std::vector<MeshTie> outline_ties;
  /// Arc length of each on region.outline().
  std::vector<double> outline_s;
};

MeshTie make_tie(const CellPoint& at);

} // namespace oversketch
