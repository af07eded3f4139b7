#pragma once

#include "core/session/content_cache.h"
#include "core/session/snapshot.h"

namespace oversketch::live {

/// The matcher's other answers for the selected layer, to choose from.
class Alternatives {
public:
  /// None where there is no choice: no region, pins, or another method.
  /// @errors those of the solver and of warp, cancelled.
  /// @cost up to kOffered cold solves the first time.
  Result<std::vector<AlternativeSnapshot>> list(Session& session, const Watch& watch);

  /// How many are solved at the most, the one that is shown among them.
  static constexpr int kOffered = 4;
  /// Runners-up whose match costs this much more than the best one's are no close calls: ambiguous bars and squares
  /// differ by up to 0.003, a fish from the same fish turned over by 0.05.
  static constexpr double kCloseCall = 0.02;

private:
  ContentCache<std::vector<AlternativeSnapshot>> known_{4};
};

} // namespace oversketch::live
