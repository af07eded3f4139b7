#include "core/session/session.h"

#include "core/clone/clone.h"
#include "core/clone/clone_system.h"
#include "core/session/content_cache.h"
#include "core/session/layer_input.h"
#include "core/session/session_solve.h"
#include "core/warp/warp.h"

#include <cmath>

namespace oversketch {

struct Session::Caches {
  // Systems are small beside their use; shapes hold a factor of about 240 bytes a pixel, composites 16.
  ContentCache<DeformSystem> systems{16};
  ContentCache<DeformSystem> systems_by_solver{16};
  // About 100 kB each.
  ContentCache<Deformation> solutions{256};
  ContentCache<Deformation> deformations{64};
  // By the picture's content; at most a third of it more, made where a region is shrunk.
  ContentCache<ImagePyramid> sources{4};
  ContentCache<LayerShape> shapes{6};
  ContentCache<Image> composites{6};
};

namespace {

std::string place_of(const Layer& layer) {
  return "layer " + to_string(layer.id);
}

/// The pasted region's mask: the raster of its deformed boundary.
Result<Mask> raster_of(const Points& boundary) {
  const Box box = bounds(boundary);
  for (const Point p : {box.low, box.high})
    if (!is_finite(p) || std::abs(p.x) >= kMaskCoordinateLimit || std::abs(p.y) >= kMaskCoordinateLimit)
      return Error{"layer.too-far", "the deformed region reaches more than a million pixels away", ""};
  const int x = static_cast<int>(std::floor(box.low.x)), y = static_cast<int>(std::floor(box.low.y));
  const Rect clip{x, y, static_cast<int>(std::ceil(box.high.x)) - x, static_cast<int>(std::ceil(box.high.y)) - y};
  return rasterize_polygon(boundary, clip);
}

} // namespace

Counters& Counters::operator+=(const Counters& other) {
  deform.meshings += other.deform.meshings;
  deform.symbolic_factorizations += other.deform.symbolic_factorizations;
  deform.numeric_factorizations += other.deform.numeric_factorizations;
  deform.matches += other.deform.matches;
  mask_setups += other.mask_setups;
  clone_solves += other.clone_solves;
  return *this;
}

Session::Session() : Session(History::Limits{}) {}
Session::Session(History::Limits limits) : history_(limits), caches_(std::make_unique<Caches>()) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Result<void> Session::execute(const Command& command, const Watch& watch) {
  auto prepared = prepare(command, watch);
  if (!prepared) return prepared.error();
  take(std::move(*prepared));
  return {};
}

Result<void> Session::preview(const Command& command, const Watch& watch) {
  auto prepared = prepare(command, watch);
  if (!prepared) return prepared.error();
  pending_ = std::move(*prepared);
  return {};
}

void Session::commit_preview() {
  if (pending_) take(std::move(*pending_));
}

Result<Session::Pending> Session::prepare(const Command& command, const Watch& watch) {
  auto after = apply(document(), command);
  if (!after) return after.error();
  const Solves& before = present_solves();
  Solves solves = plan(*after, command);
  for (const auto& [id, solve] : solves) {
    const auto known = before.find(id);
    if (known != before.end() && known->second == solve) continue;
    if (auto deformed = run(*solve, watch); !deformed) return deformed.error();
  }
  return Pending{command, std::move(*after), std::move(solves)};
}

void Session::take(Pending pending) {
  if (std::holds_alternative<DocumentNew>(pending.command)) {
    log_.clear();
    ++log_number_;
  }
  log_.push_back(pending.command);
  std::string label = label_of(pending.command, document(), pending.document);
  history_.push(std::move(pending.document), pending.command, std::move(label));
  keep(std::move(pending.solves));
  pending_.reset();
}

const Session::Solves& Session::present_solves() const {
  static const Solves kNone;
  if (history_.entries().empty()) return kNone;
  return solves_.at(history_.entries()[history_.cursor()].id);
}

Session::Solves Session::plan(const Document& after, const Command& command) const {
  const Solves& before = present_solves();
  // A curve drawn anew is matched anew, whatever was there before it.
  const bool anew = std::holds_alternative<SketchSet>(command) || std::holds_alternative<SketchReset>(command);
  Solves solves;
  for (const Layer& layer : after.layers) {
    if (layer.outline.empty()) continue;
    const auto known = before.find(layer.id);
    const std::shared_ptr<const Solve> last = known == before.end() ? nullptr : known->second;
    solves.emplace(layer.id, last && is_same_solve(last->layer, layer) ? last : plan_layer(layer, last, anew));
  }
  return solves;
}

std::shared_ptr<const Session::Solve> Session::plan_layer(const Layer& layer, const std::shared_ptr<const Solve>& last,
                                                          bool anew) {
  if (last && solution_key(last->layer) == solution_key(layer)) return make_solve(layer, last->warm);
  const bool flipfree = layer.settings.method == DeformMethod::kFlipfree;
  const bool starts_warm = last && flipfree && !anew && solver_key(last->layer) == solver_key(layer);
  return make_solve(layer, starts_warm ? last : nullptr);
}

std::shared_ptr<const Session::Solve> Session::make_solve(Layer layer, std::shared_ptr<const Solve> warm) {
  auto solve = std::make_shared<Solve>();
  solve->solution = Hasher().add(solution_key(layer)).add(warm ? warm->solution : Hash()).finish();
  solve->deformation = Hasher().add(solve->solution).add(layer.settings.cell_px).finish();
  solve->layer = std::move(layer);
  solve->warm = std::move(warm);
  return solve;
}

void Session::keep(Solves solves) {
  const auto& entries = history_.entries();
  const std::uint64_t id = entries.back().id;
  // What was undone and dropped, and what the history no longer holds.
  if (entries.size() > 1) solves_.erase(solves_.upper_bound(entries[entries.size() - 2].id), solves_.end());
  solves_.erase(solves_.begin(), solves_.lower_bound(entries.front().id));
  solves_[id] = std::move(solves);
}

const Session::Solve& Session::solve_of(const Layer& layer) const {
  return *shown_solves().at(layer.id);
}

Result<void> Session::undo(std::size_t steps) {
  pending_.reset();
  auto done = history_.undo(steps);
  if (done) log_.push_back(UndoStep{static_cast<int>(steps)});
  return done;
}

Result<void> Session::redo(std::size_t steps) {
  pending_.reset();
  auto done = history_.redo(steps);
  if (done) log_.push_back(RedoStep{static_cast<int>(steps)});
  return done;
}

Result<void> Session::jump(std::size_t entry) {
  const std::size_t cursor = history_.cursor();
  if (entry < cursor) return undo(cursor - entry);
  if (entry > cursor) return redo(entry - cursor);
  pending_.reset();
  return {};
}

Result<std::shared_ptr<const DeformSystem>> Session::system_of(const Layer& layer, const Watch& watch) {
  const Hash key = system_key(layer), by_solver = solver_key(layer);
  if (auto cached = caches_->systems.find(key)) return cached;
  const auto like = caches_->systems_by_solver.find(by_solver);
  auto made = DeformSystem::make(layer.outline, deform_options(layer), like.get(), counters_.deform, watch);
  if (!made) return at(place_of(layer), made.error());
  auto system = std::make_shared<const DeformSystem>(std::move(*made));
  if (!like) caches_->systems_by_solver.put(by_solver, system);
  return caches_->systems.put(key, std::move(system));
}

Result<std::shared_ptr<const Deformation>> Session::run(const Solve& solve, const Watch& watch) {
  if (auto cached = caches_->deformations.find(solve.deformation)) return cached;
  const Layer& layer = solve.layer;
  const auto system = system_of(layer, watch);
  if (!system) return system.error();
  const auto solution = caches_->solutions.find(solve.solution);
  if (solution && solution->flipfree)
    return caches_->deformations.put(solve.deformation,
                                     std::make_shared<const Deformation>((*system)->redisplay(*solution)));

  // What this solve starts from may have been forgotten: find the last one that is there, or that starts from nothing.
  std::vector<const Solve*> chain;
  std::shared_ptr<const Deformation> warm;
  for (const Solve* before = solve.warm.get(); before != nullptr && !warm; before = before->warm.get()) {
    warm = caches_->solutions.find(before->solution);
    if (!warm) chain.push_back(before);
  }
  chain.insert(chain.begin(), &solve);
  for (auto step = chain.rbegin(); step != chain.rend(); ++step) {
    const Layer& input = (*step)->layer;
    auto made =
        (*system)->deform(input.sketch, pin_pairs(input), deform_options(input), warm.get(), counters_.deform, watch);
    if (!made) return at(place_of(layer), made.error());
    warm = caches_->solutions.put((*step)->solution, std::make_shared<const Deformation>(std::move(*made)));
  }
  return caches_->deformations.put(solve.deformation, warm);
}

Result<std::shared_ptr<const Deformation>> Session::deformation(LayerId id, const Watch& watch) {
  const Layer* layer = shown().find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  if (layer->outline.empty()) return Error{"layer.no-region", "set the region's outline first", place_of(*layer)};
  return run(solve_of(*layer), watch);
}

Result<std::vector<Deformation>> Session::alternatives(LayerId id, int count, const Watch& watch) {
  const Layer* layer = shown().find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  if (layer->outline.empty()) return Error{"layer.no-region", "set the region's outline first", place_of(*layer)};
  const auto system = system_of(*layer, watch);
  if (!system) return system.error();
  auto solved =
      (*system)->alternatives(layer->sketch, pin_pairs(*layer), deform_options(*layer), count, counters_.deform, watch);
  if (!solved) return at(place_of(*layer), solved.error());
  return solved;
}

std::optional<Hash> Session::deformation_name(LayerId id) const {
  const auto& solves = shown_solves();
  const auto found = solves.find(id);
  return found == solves.end() ? std::nullopt : std::optional(found->second->deformation);
}

Result<Metrics> Session::metrics(LayerId id, const Watch& watch) {
  const auto deformed = deformation(id, watch);
  if (!deformed) return deformed.error();
  const Layer& layer = *shown().find(id);
  const Similarity to_target = layer.placement.to_target();
  Deformation placed = **deformed;
  placed.positions = transformed(placed.positions, to_target);
  placed.outline = transformed(placed.outline, to_target);
  return measure(placed, ClosedCurve(layer.sketch_in_target()), {});
}

ImagePyramid Session::source_of(const Layer& layer) {
  const Hash key = layer.source.image.content_hash();
  if (const auto cached = caches_->sources.find(key)) return *cached;
  return *caches_->sources.put(key, std::make_shared<const ImagePyramid>(layer.source.image));
}

Result<std::shared_ptr<const LayerShape>> Session::shape_of(const Layer& layer, const Solve& solve, bool needs_system,
                                                            const Watch& watch) {
  const Hash key = shape_key(layer, solve.deformation);
  auto shape = caches_->shapes.find(key);
  if (shape && (shape->system || !needs_system || shape->mask.empty())) return shape;

  auto made = std::make_shared<LayerShape>();
  if (shape) {
    *made = *shape;
  } else {
    const auto deformed = run(solve, watch);
    if (!deformed) return deformed.error();
    const Similarity place = layer.placement.sub_pixel();
    StageTimer timer(watch.times, "warp");
    auto mask = raster_of(transformed((*deformed)->boundary, place));
    if (!mask) return at(place_of(layer), mask.error());
    if (!mask->empty()) {
      const Mask region = rasterize_polygon(layer.outline, layer.source.image.rect());
      auto warped = warp_region(source_of(layer), *(*deformed)->mesh, transformed((*deformed)->positions, place), *mask,
                                watch, &region, warp_options(layer));
      if (!warped) return at(place_of(layer), warped.error());
      made->mask = opaque_part(*warped, *mask);
      made->warped = std::move(*warped);
    }
  }
  if (needs_system && !made->mask.empty()) {
    StageTimer timer(watch.times, "mask");
    auto system = CloneSystem::make(made->mask);
    if (!system) return at(place_of(layer), system.error());
    made->system = std::make_shared<const CloneSystem>(std::move(*system));
    ++counters_.mask_setups;
  }
  return caches_->shapes.put(key, std::move(made));
}

Result<Image> Session::blend(const Layer& layer, const Image& below, const Watch& watch) {
  const auto shape = shape_of(layer, solve_of(layer), layer.settings.mode != CloneMode::kNone, watch);
  if (!shape) return shape.error();
  if ((*shape)->mask.empty()) return below;
  StageTimer timer(watch.times, "blend");
  Raster<Rgba> pixels = below.pixels();
  const LayerShape& s = **shape;
  const auto [dx, dy] = std::pair(layer.placement.dx, layer.placement.dy);
  const auto report =
      layer.settings.mode == CloneMode::kNone
          ? paste_into(pixels, s.warped, s.mask, dx, dy, blend_options(layer), watch)
          : clone_into(pixels, s.warped, dx, dy, *s.system, blend_options(layer), CloneQuality::kExport, watch);
  if (!report) return at(place_of(layer), report.error());
  ++counters_.clone_solves;
  return Image(std::move(pixels));
}

Result<Image> Session::composite_until(const Document& document, std::size_t count, const Watch& watch) {
  if (document.empty()) return Error{"document.none", "there is no document yet: begin with document.new", ""};
  std::vector<const Layer*> drawn;
  for (std::size_t i = 0; i < count; ++i)
    if (is_drawn(document.layers[i])) drawn.push_back(&document.layers[i]);
  std::vector<Hash> keys{document.target.image.content_hash()};
  for (const Layer* layer : drawn)
    keys.push_back(Hasher().add(keys.back()).add(blend_key(*layer, solve_of(*layer).deformation)).finish());

  // The highest picture that is still there, then what stands above it.
  std::size_t have = drawn.size();
  Image picture = document.target.image;
  for (; have > 0; --have)
    if (const auto cached = caches_->composites.find(keys[have])) {
      picture = *cached;
      break;
    }
  for (; have < drawn.size(); ++have) {
    if (watch.stopped()) return cancelled();
    watch.report(static_cast<double>(have) / static_cast<double>(drawn.size()), "blending " + drawn[have]->name);
    auto blended = blend(*drawn[have], picture, watch);
    if (!blended) return blended.error();
    picture = std::move(*blended);
    caches_->composites.put(keys[have + 1], std::make_shared<const Image>(picture));
  }
  return picture;
}

Result<std::vector<DrawnLayer>> Session::drawn_layers(const Layer* otherwise, const Watch& watch) {
  // All of them, and as many again for what a gesture makes of them.
  caches_->shapes.grow(2 * shown().layers.size());
  std::vector<DrawnLayer> drawn;
  for (const Layer& own : shown().layers) {
    const bool other = otherwise != nullptr && otherwise->id == own.id;
    const Layer& layer = other ? *otherwise : own;
    if (!is_drawn(layer)) continue;
    const auto solve = other ? plan_layer(layer, nullptr, true) : shown_solves().at(layer.id);
    auto shape = shape_of(layer, *solve, true, watch);
    if (!shape) return shape.error();
    drawn.push_back({layer.id, std::move(*shape), shape_key(layer, solve->deformation), layer.placement.dx,
                     layer.placement.dy, blend_options(layer)});
  }
  return drawn;
}

Result<Image> Session::composite(const Watch& watch) {
  return composite_until(shown(), shown().layers.size(), watch);
}

Result<WarpedRegion> Session::layer_pixels(LayerId id, const Watch& watch) {
  const Document& now = shown();
  const Layer* layer = now.find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  const auto index = static_cast<std::size_t>(layer - now.layers.data());
  Document shown = now;
  shown.layers[index].settings.visible = true;
  const auto picture = composite_until(shown, index + 1, watch);
  if (!picture) return picture.error();
  if (!is_drawn(shown.layers[index])) return WarpedRegion{};
  const auto shape = shape_of(shown.layers[index], solve_of(shown.layers[index]), false, watch);
  if (!shape) return shape.error();
  const Mask placed = translated((*shape)->mask, layer->placement.dx, layer->placement.dy);
  WarpedRegion alone;
  alone.rect = intersect(placed.bounds(), picture->rect());
  if (alone.rect.empty()) return WarpedRegion{};
  alone.pixels = Raster<Rgba>(alone.rect.width, alone.rect.height, {0, 0, 0, 0});
  for (const Mask::Run& run : placed.runs()) {
    if (run.y < alone.rect.y || run.y >= alone.rect.bottom()) continue;
    for (int x = std::max(run.x0, alone.rect.x); x < std::min(run.x1, alone.rect.right()); ++x)
      alone.pixels.at(x - alone.rect.x, run.y - alone.rect.y) = picture->at(x, run.y);
  }
  return alone;
}

Result<Image> Session::layer_picture(LayerId id, const Watch& watch) {
  const auto alone = layer_pixels(id, watch);
  if (!alone) return alone.error();
  const Rect& rect = alone->rect;
  Raster<Rgba> whole(document().target.image.width(), document().target.image.height(), {0, 0, 0, 0});
  for (int y = 0; y < rect.height; ++y)
    std::copy_n(alone->pixels.row(y).begin(), rect.width, whole.row(rect.y + y).begin() + rect.x);
  return Image(std::move(whole));
}

} // namespace oversketch
