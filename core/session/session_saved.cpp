// A Session to and from the value that project files hold.

#include "core/session/layer_input.h"
#include "core/session/session_solve.h"

#include <unordered_map>
#include <unordered_set>

namespace oversketch {
namespace {

/// The window of the history that is kept: [first, last).
struct Window {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Grows from the present step into the past, then into the future, as far as the limits let it.
Window choose_window(const History& history, const KeptHistory& kept) {
  const auto& entries = history.entries();
  std::unordered_set<const void*> counted;
  for_each_image(history.present(), [&](const Image& image) { counted.insert(&image.pixels()); });
  std::size_t bytes = 0;
  const auto fits = [&](const History::Entry& entry) {
    std::unordered_set<const void*> added;
    std::size_t more = 0;
    for_each_image(entry.document, [&](const Image& image) {
      if (!counted.contains(&image.pixels()) && added.insert(&image.pixels()).second)
        more += image.pixels().values().size_bytes();
    });
    if (bytes + more > kept.image_bytes) return false;
    bytes += more;
    counted.merge(added);
    return true;
  };
  Window window{history.cursor(), history.cursor() + 1};
  const auto room = [&] { return window.last - window.first < kept.steps; };
  while (window.first > 0 && room() && fits(entries[window.first - 1]))
    --window.first;
  while (window.last < entries.size() && room() && fits(entries[window.last]))
    ++window.last;
  return window;
}

Error inconsistent(const std::string& what) {
  return {"session.inconsistent", "the saved session contradicts itself: " + what, ""};
}

} // namespace

SavedSession shortened(const SavedSession& saved, std::size_t steps) {
  CHECK(steps >= 1 && saved.cursor < saved.steps.size(), "the present step is kept");
  const std::size_t first = std::min(saved.steps.size() - std::min(steps, saved.steps.size()), saved.cursor);
  const std::size_t last = std::min(saved.steps.size(), first + steps);
  std::vector<bool> is_needed(saved.solves.size());
  for (std::size_t i = first; i < last; ++i)
    for (const auto& [id, solve] : saved.steps[i].solves)
      for (std::optional<std::size_t> at = solve; at && !is_needed[*at]; at = saved.solves[*at].warm)
        is_needed[*at] = true;
  SavedSession out;
  std::vector<std::size_t> place(saved.solves.size());
  for (std::size_t i = 0; i < saved.solves.size(); ++i) {
    if (!is_needed[i]) continue;
    place[i] = out.solves.size();
    SavedSession::Solve& solve = out.solves.emplace_back(saved.solves[i]);
    if (solve.warm) solve.warm = place[*solve.warm];
  }
  for (std::size_t i = first; i < last; ++i)
    for (auto& [id, solve] : out.steps.emplace_back(saved.steps[i]).solves)
      solve = place[solve];
  out.cursor = saved.cursor - first;
  return out;
}

SavedSession Session::saved(const KeptHistory& kept) const {
  SavedSession saved;
  if (history_.entries().empty()) return saved;
  std::unordered_map<const Solve*, std::size_t> known;
  const auto index_of = [&](const Solve& solve) {
    // From the first of the chain that is not there yet, so that each comes behind what it starts from.
    std::vector<const Solve*> chain;
    for (const Solve* at = &solve; at != nullptr && !known.contains(at); at = at->warm.get())
      chain.push_back(at);
    for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
      const auto warm = known.find((*at)->warm.get());
      known.emplace(*at, saved.solves.size());
      saved.solves.push_back({(*at)->layer, warm == known.end() ? std::nullopt : std::optional(warm->second)});
    }
    return known.at(&solve);
  };
  const Window window = choose_window(history_, kept);
  for (std::size_t i = window.first; i < window.last; ++i) {
    const History::Entry& entry = history_.entries()[i];
    SavedSession::Step step{entry.document, entry.command, entry.label, {}};
    for (const auto& [id, solve] : solves_.at(entry.id))
      step.solves.emplace(id, index_of(*solve));
    saved.steps.push_back(std::move(step));
  }
  saved.cursor = history_.cursor() - window.first;
  return saved;
}

Result<Session> Session::restore(SavedSession saved, History::Limits limits) {
  if (saved.steps.empty() ? saved.cursor != 0 : saved.cursor >= saved.steps.size())
    return inconsistent("its present step is none of its steps");
  std::vector<std::shared_ptr<const Solve>> solves;
  for (SavedSession::Solve& given : saved.solves) {
    const std::string place = "solve " + std::to_string(solves.size());
    if (given.layer.outline.empty()) return inconsistent(place + " has no region");
    std::shared_ptr<const Solve> warm;
    if (given.warm) {
      if (*given.warm >= solves.size()) return inconsistent(place + " starts from a later one");
      warm = solves[*given.warm];
      const bool flipfree = given.layer.settings.method == DeformMethod::kFlipfree;
      if (!flipfree || solver_key(warm->layer) != solver_key(given.layer))
        return inconsistent(place + " starts from one of another region");
    }
    solves.push_back(make_solve(std::move(given.layer), std::move(warm)));
  }

  Session session(limits);
  std::vector<History::Entry> entries;
  std::vector<Solves> by_step;
  for (SavedSession::Step& step : saved.steps) {
    Solves& planned = by_step.emplace_back();
    for (const Layer& layer : step.document.layers) {
      const auto index = step.solves.find(layer.id);
      const bool known = index != step.solves.end() && index->second < solves.size();
      if (layer.outline.empty()) continue;
      if (!known || !is_same_solve(solves[index->second]->layer, layer))
        return inconsistent("step " + std::to_string(entries.size()) + " has no solve for layer " +
                            to_string(layer.id));
      planned.emplace(layer.id, solves[index->second]);
    }
    session.log_.push_back(step.command);
    entries.push_back({0, std::move(step.document), std::move(step.command), std::move(step.label), 0});
  }
  // A history that lost its beginning cannot be replayed from nothing.
  const bool whole = !entries.empty() && std::holds_alternative<DocumentNew>(entries.front().command);
  if (!whole) session.log_.clear();
  if (const std::size_t undone = entries.empty() ? 0 : entries.size() - 1 - saved.cursor; whole && undone > 0)
    session.log_.push_back(UndoStep{static_cast<int>(undone)});
  session.history_.restore(std::move(entries), saved.cursor);
  for (std::size_t i = 0; i < by_step.size(); ++i)
    session.solves_[session.history_.entries()[i].id] = std::move(by_step[i]);
  return session;
}

void Session::adopt(Session other) {
  pending_ = std::move(other.pending_);
  other.history_.set_limits(history_.limits());
  history_ = std::move(other.history_);
  log_ = std::move(other.log_);
  ++log_number_;
  solves_ = std::move(other.solves_);
  caches_.swap(other.caches_);
  counters_ += other.counters_;
}

} // namespace oversketch
