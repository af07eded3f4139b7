#pragma once

#include "core/clone/correction.h"
#include "core/clone/live_data.h"

#include <span>

namespace oversketch {

/// Everything that painting a layer on the screen may need; u in the domain's values.
struct BlendPainting {
  const LiveRegion::Data& region;
  const BlendOptions& options;
  const Correction& correction;
  /// Null in the encoded domain.
  const DomainTables* tables = nullptr;
  /// CloneSystem::depths; null where no feather is used.
  const std::vector<float>* depths = nullptr;
};

/// The blend of clone_into with any options, rounded and clamped.
void paint_blended(const BlendPainting& painting, std::span<const LiveRow> rows);

} // namespace oversketch
