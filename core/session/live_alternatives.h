#pragma once

#include "core/session/content_cache.h"
#include "core/session/snapshot.h"

namespace oversketch::live {

/// The matcher's other answers for the selected layer, to choose from.
class Alternatives {
public:
  /// None where there is no choice: no region, no second answer, pins that hold none of them, or another method.
  /// @param find  whether they are solved where they are not known yet.
  /// @errors those of the solver and of warp, cancelled.
  /// @cost up to kOffered cold solves the first time, until outline, sketch or a setting of the method changes.
  Result<std::vector<AlternativeSnapshot>> list(Session& session, bool find, const Watch& watch);

  /// How many are solved at the most, the one that is shown among them.
  static constexpr int kOffered = 4;
  /// Runners-up whose match costs this much more than the best one's are no close calls: ambiguous bars and squares
  /// differ by up to 0.003, a fish from the same fish turned over by 0.05.
  static constexpr double kCloseCall = 0.02;

private:
  /// One of the answers, in the layer's own space.
  struct Match {
    /// The point that tells it best from the others, and where it has that, on the sketch.
    Point outline, sketch;
    /// Where it has all the outline.
    Points places;
    double cost = 0;
    std::shared_ptr<const Raster<Rgba8>> picture;
  };
  using Matches = std::vector<Match>;

  static Result<Matches> find_matches(Session& session, const Layer& layer, const Watch& watch);
  /// Which of them the layer shows, if any.
  static Result<const Match*> chosen_of(const Matches& matches, Session& session, const Layer& layer,
                                        const Watch& watch);

  ContentCache<Matches> known_{4};
};

} // namespace oversketch::live
