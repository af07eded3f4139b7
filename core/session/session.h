#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/clone/bleed.h"
#include "core/deform/deformation.h"
#include "core/document/history.h"
#include "core/image/pyramid.h"
#include "core/image/warped_region.h"
#include "core/session/drawn_layer.h"
#include "core/session/saved_session.h"
#include "core/session/script.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace oversketch {

/// How often each kind of work was done since the session began; tests hold edits against these.
struct Counters {
  DeformCounts deform;
  /// Rasters and factorizations of a mask.
  std::int64_t mask_setups = 0;
  /// Right-hand side, solve and painting of one layer.
  std::int64_t clone_solves = 0;

  Counters& operator+=(const Counters& other);
};

/// A document with its history and everything derived from it: what programs talk to.
///
/// Derived results are kept by the content they depend on, so that an edit redoes only what it touches, and undo finds
/// what was there:
///
///     outline, method (the paper's: cell) → solved mesh, symbolic and numeric factor
///     … + sketch, pins, weights           → solution
///     … + cell                            → drawn mesh
///     … + source, sampling, turn, scale   → pixel mask, warped source, factor of the mask
///     … + whole-pixel place, blending, what lies below → the picture
///
/// A flip-free solution starts from the one before it where an oversketch, a pin or a weight changed it, so it depends
/// on the steps that led to it: the same steps give the same bits, whenever they are solved.
///
/// @threads one at a time; the images and deformations that are handed out may be read from any.
class Session {
public:
  Session();
  explicit Session(History::Limits limits);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  const Document& document() const { return history_.present(); }
  /// What deformation(), metrics() and the pictures are of: the preview's document while there is one.
  const Document& shown() const { return pending_ ? pending_->document : history_.present(); }
  bool has_preview() const { return pending_.has_value(); }
  const History& history() const { return history_; }
  const Counters& counters() const { return counters_; }

  /// Applies a command whose images are loaded, and meshes the regions it changed, so that what cannot be meshed is
  /// refused here.
  /// @errors those of apply() and make_region_mesh(), with the layer as the place; nothing is changed then.
  Result<void> execute(const Command& command, const Watch& watch = {});
  /// What the command would give, each time from the present document: shown, but no part of the history.
  /// @errors those of execute(); the preview before it stays then.
  Result<void> preview(const Command& command, const Watch& watch = {});
  /// The preview becomes one step of the history, as if its command had been executed.  Nothing without a preview.
  void commit_preview();
  void drop_preview() { pending_.reset(); }

  /// Undo, redo and jump drop the preview.
  Result<void> undo(std::size_t steps = 1);
  Result<void> redo(std::size_t steps = 1);
  /// To that entry of the history: the undo or redo steps that lead there.
  Result<void> jump(std::size_t entry);
  void mark_saved() { history_.mark_saved(); }
  /// From the next step on.
  void limit_history(const History::Limits& limits) { history_.set_limits(limits); }
  /// What drawing one layer may take, kLayerPixelBytes for each pixel of its box: from then on a larger one is refused
  /// with warp.too-large before anything is allocated.
  void limit_memory(std::size_t bytes) { memory_bytes_ = bytes; }
  static constexpr std::size_t kMemoryBytes = std::size_t{8} << 30;
  /// 16 for the warped source, 40 for what is solved on every pixel (MultigridSolve).
  static constexpr std::size_t kLayerPixelBytes = 56;
  /// Takes over the document, history and log of another session; the counters add up, the limits stay this one's.
  void adopt(Session other);

  /// What a project file needs; solving it anew gives the same bits.  @cost O(steps kept); pictures are shared.
  SavedSession saved(const KeptHistory& kept = {}) const;
  /// The reverse: unmodified, nothing solved yet.
  /// @errors session.inconsistent.
  static Result<Session> restore(SavedSession saved, History::Limits limits = {});

  /// Every command, undo and redo since the document was begun: replaying it gives this document and this history.
  /// After restore() of a history that had lost its beginning: since then.
  const std::vector<Step>& log() const { return log_; }
  /// Another one whenever log() is not the one before with more behind it: another document is there.
  std::uint64_t log_number() const { return log_number_; }

  /// The layer's deformed region, in its own space; apply the placement for target pixels.
  /// @errors layer.unknown, layer.no-region, those of the solvers, cancelled.
  Result<std::shared_ptr<const Deformation>> deformation(LayerId id, const Watch& watch = {});
  /// What names that result by its content; none where there is no region.
  std::optional<Hash> deformation_name(LayerId id) const;
  /// Its distortion; lengths in target pixels.
  Result<Metrics> metrics(LayerId id, const Watch& watch = {});

  /// The best match of a flip-free layer's curves, solved from nothing as if it had no pins, and up to `count` − 1
  /// runners-up.
  /// @errors as deformation().
  Result<std::vector<Deformation>> alternatives(LayerId id, int count, const Watch& watch = {});

  /// The target with all visible layers blended in, lowest first.  Each is blended onto what is seen of those below:
  /// where the target itself has nothing darker than black or brighter than white, what they have is cut off for that.
  /// The result is not clamped.
  /// @errors document.none, those of warp and clone with the layer as the place, cancelled.
  Result<Image> composite(const Watch& watch = {});

  /// One layer as it stands in the composite of those below it: opaque where it is, transparent elsewhere; the box
  /// round what it paints within the target, empty where that is nothing.
  Result<WarpedRegion> layer_pixels(LayerId id, const Watch& watch = {});
  /// The same, of the target's size.
  Result<Image> layer_picture(LayerId id, const Watch& watch = {});

  /// Where colours will bleed into a layer, along its boundary in target pixels; nothing where it is not drawn,
  /// nor in mode none, which matches nothing.
  /// @errors those of composite().
  Result<BleedForecast> bleed(LayerId id, const Watch& watch = {});

  /// What composite() is painted from, lowest first, for who paints it otherwise; every system is there.
  /// @param otherwise  a layer to be taken with other settings, for comparison; may be null.
  /// @errors those of the solvers and of warp with the layer as the place, cancelled.
  Result<std::vector<DrawnLayer>> drawn_layers(const Layer* otherwise = nullptr, const Watch& watch = {});

  /// Pixels of the target that a layer paints: 0 where it is not drawn, lies outside, or is so small or thin that it
  /// covers no pixel's centre.
  /// @errors those of the solvers and of warp with the layer as the place, cancelled.
  Result<std::int64_t> painted_pixels(LayerId id, const Watch& watch = {});

private:
  struct Caches;
  struct Solve;
  /// How each layer of a history entry is solved.
  using Solves = std::map<LayerId, std::shared_ptr<const Solve>>;

  /// A document that is not in the history, and how it came about.
  struct Pending {
    Command command;
    Document document;
    Solves solves;
  };

  const Solves& present_solves() const;
  const Solves& shown_solves() const { return pending_ ? pending_->solves : present_solves(); }
  Result<Pending> prepare(const Command& command, const Watch& watch);
  void take(Pending pending);
  Solves plan(const Document& after, const Command& command) const;
  static std::shared_ptr<const Solve> plan_layer(const Layer& layer, const std::shared_ptr<const Solve>& last,
                                                 bool anew);
  static std::shared_ptr<const Solve> make_solve(Layer layer, std::shared_ptr<const Solve> warm);
  void keep(Solves solves);
  const Solve& solve_of(const Layer& layer) const;
  Result<std::shared_ptr<const DeformSystem>> system_of(const Layer& layer, const Watch& watch);
  Result<std::shared_ptr<const Deformation>> run(const Solve& solve, const Watch& watch);
  /// Copies share what is made of it.
  ImagePyramid source_of(const Layer& layer);
  Result<std::shared_ptr<const LayerShape>> shape_of(const Layer& layer, const Solve& solve, bool needs_system,
                                                     const Watch& watch);
  /// Onto the picture below it, in place; or onto what is seen of it (see composite()).
  /// @returns the part that may have changed, as it is after.
  Result<WarpedRegion> blend(const Layer& layer, bool onto_seen, Raster<Rgba>& pixels, const Watch& watch);
  /// The picture up to and including the layer of that index.
  Result<Image> composite_until(const Document& document, std::size_t count, const Watch& watch);

  History history_;
  std::optional<Pending> pending_;
  Counters counters_;
  std::vector<Step> log_;
  std::uint64_t log_number_ = 0;
  std::size_t memory_bytes_ = kMemoryBytes;
  /// By the id of the history entry.
  std::map<std::uint64_t, Solves> solves_;
  std::unique_ptr<Caches> caches_;
};

} // namespace oversketch
