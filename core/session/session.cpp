#include "core/session/session.h"

#include "core/session/layer_input.h"
#include "core/session/session_caches.h"
#include "core/session/session_solve.h"

namespace oversketch {

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
  auto solved = (*system)->alternatives(layer->sketch, {}, deform_options(*layer), count, counters_.deform, watch);
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
  placed.boundary = transformed(placed.boundary, to_target);
  return measure(placed, ClosedCurve(layer.sketch_in_target()), {});
}

} // namespace oversketch
