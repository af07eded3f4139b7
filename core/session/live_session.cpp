#include "core/session/live_session.h"

#include "core/session/live_alternatives.h"
#include "core/session/live_bleed.h"
#include "core/session/live_inbox.h"
#include "core/session/live_picture.h"
#include "core/session/live_snapshot.h"
#include "core/session/picture_loader.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <type_traits>
#include <utility>

namespace oversketch {

namespace {

using Clock = std::chrono::steady_clock;

/// While requests come faster than they are served, what they do is shown this often all the same.
constexpr std::chrono::milliseconds kShowAtLeastEvery{50};

/// The work, with what libraries throw turned into an Error.
template <class Work>
std::invoke_result_t<Work> guarded(Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{"memory.exhausted", "there is not enough memory for this", ""};
  } catch (const std::exception& thrown) {
    return Error{"program.unexpected", thrown.what(), ""};
  }
}

/// Wherever it happened.
bool is_cancelled(const Error& error) {
  return error.code == cancelled().code;
}

/// What has not been taken yet, and then what is newer.
void merge(PictureUpdate& waiting, PictureUpdate newer) {
  if (newer.whole) {
    waiting = std::move(newer);
    return;
  }
  const auto covers = [](const PicturePatch& above, const PicturePatch& below) {
    return above.x <= below.x && above.y <= below.y &&
           above.x + above.pixels.width() >= below.x + below.pixels.width() &&
           above.y + above.pixels.height() >= below.y + below.pixels.height();
  };
  for (PicturePatch& patch : newer.patches) {
    std::erase_if(waiting.patches, [&](const PicturePatch& old) { return covers(patch, old); });
    waiting.patches.push_back(std::move(patch));
  }
}

} // namespace

struct LiveSession::State {
  std::function<void()> on_change;
  std::function<void(const Session&)> on_served;
  live::Inbox inbox;

  /// Guards what follows it.
  mutable std::mutex mutex;
  std::condition_variable idle;
  std::shared_ptr<const Snapshot> snapshot = std::make_shared<const Snapshot>();
  PictureUpdate update;
  Activity activity;
  /// As it was last asked for.
  live::View wanted;

  // The worker's own.
  Session session;
  live::SnapshotMaker snapshots;
  live::Picture picture;
  live::Picture compare_picture;
  live::Alternatives alternatives;
  live::View view;
  std::optional<Error> problem;
  std::uint64_t problem_number = 0;
  std::uint64_t revision = 0;
  bool preview_refused = false;
  Clock::time_point last_shown;

  std::thread worker;

  void post(live::Request request);
  template <class Change>
  void post_view(Change change);
  void work();
  void serve(live::Request& request);
  Result<void> carry_out(live::Execute& request, const Watch& watch);
  Result<void> carry_out(live::Preview& request, const Watch& watch);
  Result<void> carry_out(live::Commit&, const Watch&);
  Result<void> carry_out(live::Abandon&, const Watch&);
  Result<void> carry_out(live::Undo& request, const Watch&) { return session.undo(request.steps); }
  Result<void> carry_out(live::Redo& request, const Watch&) { return session.redo(request.steps); }
  Result<void> carry_out(live::Jump& request, const Watch&) { return session.jump(request.entry); }
  Result<void> carry_out(live::Run& request, const Watch& watch);
  Result<void> carry_out(live::LimitHistory& request, const Watch&) {
    session.limit_history(request.limits);
    return {};
  }
  Result<void> carry_out(live::View& request, const Watch&);
  void show(live::Quality quality, const std::stop_token& stop);
  Result<void> paint(live::Quality quality, const Watch& watch, PictureUpdate& changed, std::vector<DrawnLayer>& drawn);
  void add_bleed(const std::vector<DrawnLayer>& drawn, Snapshot& made) const;
  std::optional<Layer> compared_layer() const;
  Result<void> compare(live::Quality quality, Snapshot& made, const Watch& watch);
  void refuse(Error error);
  void publish(Snapshot made, PictureUpdate changed);
  /// Says that nothing is being done, if that is so.
  void rest();
  Watch watch_of(std::stop_token stop);
};

LiveSession::LiveSession(std::function<void()> on_change, std::function<void(const Session&)> on_served)
    : state_(std::make_unique<State>()) {
  state_->on_change = std::move(on_change);
  state_->on_served = std::move(on_served);
  state_->worker = std::thread([state = state_.get()] { state->work(); });
}

LiveSession::~LiveSession() {
  state_->inbox.close();
  state_->worker.join();
}

void LiveSession::State::post(live::Request request) {
  const std::lock_guard lock(mutex);
  activity.busy = true;
  inbox.post(std::move(request));
}

template <class Change>
void LiveSession::State::post_view(Change change) {
  const std::lock_guard lock(mutex);
  const live::View before = wanted;
  change(wanted);
  if (wanted == before) return;
  activity.busy = true;
  inbox.post(wanted);
}

void LiveSession::execute(Command command) {
  state_->post(live::Execute{std::move(command)});
}
void LiveSession::preview(Command command) {
  state_->post(live::Preview{std::move(command)});
}
void LiveSession::commit() {
  state_->post(live::Commit{});
}
void LiveSession::abandon() {
  state_->post(live::Abandon{});
}
void LiveSession::undo(int steps) {
  state_->post(live::Undo{static_cast<std::size_t>(std::max(steps, 0))});
}
void LiveSession::redo(int steps) {
  state_->post(live::Redo{static_cast<std::size_t>(std::max(steps, 0))});
}
void LiveSession::jump(std::size_t entry) {
  state_->post(live::Jump{entry});
}
void LiveSession::run(std::string label, Job job, std::function<void(const Result<void>&)> done) {
  state_->post(live::Run{std::move(label), std::move(job), std::move(done)});
}
void LiveSession::limit_history(const History::Limits& limits) {
  state_->post(live::LimitHistory{limits});
}
void LiveSession::show_compare(Compare compare) {
  state_->post_view([&](live::View& view) { view.compare = compare; });
}
void LiveSession::want_alternatives(bool wanted) {
  state_->post_view([&](live::View& view) { view.alternatives = wanted; });
}
void LiveSession::cancel() {
  state_->inbox.cancel();
}

std::shared_ptr<const Snapshot> LiveSession::snapshot() const {
  const std::lock_guard lock(state_->mutex);
  return state_->snapshot;
}

PictureUpdate LiveSession::take_picture_update() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->update, PictureUpdate{state_->update.width, state_->update.height, false, {}});
}

LiveSession::Activity LiveSession::activity() const {
  const std::lock_guard lock(state_->mutex);
  return state_->activity;
}

void LiveSession::wait_until_idle() {
  std::unique_lock lock(state_->mutex);
  state_->idle.wait(lock, [&] { return !state_->activity.busy; });
}

// The worker.

void LiveSession::State::work() {
  while (auto request = inbox.next()) {
    serve(*request);
    if (inbox.empty() || Clock::now() - last_shown > kShowAtLeastEvery) show(live::Quality::kFirst, inbox.serving());
    // Better as long as nobody asks for something else.
    if (inbox.empty()) show(live::Quality::kRest, inbox.refining());
    rest();
  }
}

void LiveSession::State::rest() {
  {
    const std::lock_guard lock(mutex);
    if (!inbox.empty()) return;
    activity = {};
  }
  idle.notify_all();
  if (on_change) on_change();
}

Watch LiveSession::State::watch_of(std::stop_token stop) {
  Watch watch;
  watch.stop = std::move(stop);
  watch.progress = [this](double done, std::string_view label) {
    {
      const std::lock_guard lock(mutex);
      activity.done = done;
      activity.label = label;
    }
    if (on_change) on_change();
  };
  return watch;
}

void LiveSession::State::serve(live::Request& request) {
  const Watch watch = watch_of(inbox.serving());
  auto outcome = guarded([&] { return std::visit([&](auto& one) { return carry_out(one, watch); }, request); });
  const bool only_shown = std::holds_alternative<live::Preview>(request) || std::holds_alternative<live::View>(request);
  if (on_served && !only_shown) on_served(session);
  // A preview is stopped by giving up its gesture: that is no news.
  if (outcome || (is_cancelled(outcome.error()) && std::holds_alternative<live::Preview>(request))) return;
  refuse(outcome.error());
}

void LiveSession::State::refuse(Error error) {
  problem = std::move(error);
  ++problem_number;
}

Result<void> LiveSession::State::carry_out(live::Execute& request, const Watch& watch) {
  session.drop_preview();
  if (auto loaded = PictureLoader("").load_into(request.command); !loaded) return loaded.error();
  return session.execute(request.command, watch);
}

Result<void> LiveSession::State::carry_out(live::Preview& request, const Watch& watch) {
  auto shown = session.preview(request.command, watch);
  preview_refused = !shown;
  return shown;
}

Result<void> LiveSession::State::carry_out(live::Commit&, const Watch&) {
  if (!std::exchange(preview_refused, false)) session.commit_preview();
  session.drop_preview();
  return {};
}

Result<void> LiveSession::State::carry_out(live::Abandon&, const Watch&) {
  preview_refused = false;
  session.drop_preview();
  return {};
}

Result<void> LiveSession::State::carry_out(live::Run& request, const Watch& watch) {
  {
    const std::lock_guard lock(mutex);
    activity.label = request.label;
  }
  session.drop_preview();
  auto outcome = guarded([&] { return request.job(session, watch); });
  if (request.done) request.done(outcome);
  return outcome;
}

Result<void> LiveSession::State::carry_out(live::View& request, const Watch&) {
  view = request;
  return {};
}

void LiveSession::State::show(live::Quality quality, const std::stop_token& stop) {
  const Watch watch = watch_of(stop);
  PictureUpdate changed;
  std::vector<DrawnLayer> drawn;
  const auto painted = guarded([&] { return paint(quality, watch, changed, drawn); });
  if (!painted && !is_cancelled(painted.error())) refuse(painted.error());
  const bool rested = quality == live::Quality::kRest && painted;
  Snapshot made = snapshots.make(session, rested, watch);
  for (LayerSnapshot& layer : made.layers)
    if (const auto timing = picture.timing_of(layer.id)) {
      layer.mask_ms = timing->mask_ms;
      layer.blend_ms = timing->blend_ms;
    }
  add_bleed(drawn, made);
  if (const auto compared = guarded([&] { return compare(quality, made, watch); });
      !compared && !is_cancelled(compared.error()))
    refuse(compared.error());
  if (view.alternatives)
    if (auto found = guarded([&] { return alternatives.list(session, rested, watch); }); found)
      made.alternatives = std::move(*found);
  publish(std::move(made), std::move(changed));
  last_shown = Clock::now();
}

Result<void> LiveSession::State::paint(live::Quality quality, const Watch& watch, PictureUpdate& changed,
                                       std::vector<DrawnLayer>& drawn) {
  auto layers = session.drawn_layers(nullptr, watch);
  if (!layers) return layers.error();
  drawn = std::move(*layers);
  return picture.paint(snapshots.show(session.shown().target.image).pixels, drawn, quality, watch, changed);
}

void LiveSession::State::add_bleed(const std::vector<DrawnLayer>& drawn, Snapshot& made) const {
  const Document& shown = made.document;
  const Layer* selected = shown.selected ? shown.find(*shown.selected) : nullptr;
  if (selected == nullptr) return;
  const auto layer = std::ranges::find(made.layers, selected->id, &LayerSnapshot::id);
  const auto part = std::ranges::find(drawn, selected->id, &DrawnLayer::id);
  if (layer == made.layers.end() || part == drawn.end() || layer->deformation == nullptr) return;
  layer->bleed = live::forecast_layer(shown.target.image, *selected, *layer->deformation, *part);
}

/// The selected layer, as the comparison takes it.
std::optional<Layer> LiveSession::State::compared_layer() const {
  const Document& shown = session.shown();
  const Layer* selected = shown.selected ? shown.find(*shown.selected) : nullptr;
  if (view.compare == Compare::kOff || selected == nullptr || selected->outline.empty()) return std::nullopt;
  Layer other = *selected;
  LayerSettings& settings = other.settings;
  settings.visible = view.compare != Compare::kHidden;
  if (view.compare == Compare::kPaste) settings.mode = CloneMode::kNone;
  if (view.compare == Compare::kInitial) settings.method = DeformMethod::kInitial;
  if (view.compare == Compare::kPaper) settings.method = DeformMethod::kPaper;
  if (view.compare == Compare::kFlipfree) settings.method = DeformMethod::kFlipfree;
  return other;
}

Result<void> LiveSession::State::compare(live::Quality quality, Snapshot& made, const Watch& watch) {
  const auto other = compared_layer();
  if (!other) {
    compare_picture = live::Picture();
    return {};
  }
  const auto layers = session.drawn_layers(&*other, watch);
  if (!layers) return layers.error();
  PictureUpdate changed;
  auto painted = compare_picture.paint(made.target.pixels, *layers, quality, watch, changed);
  if (!painted) return painted;
  const Rect rect = unite(picture.layers_rect(), compare_picture.layers_rect());
  if (!rect.empty())
    made.compare =
        ComparePicture{rect, std::make_shared<const Raster<Rgba8>>(live::part_of(compare_picture.pixels(), rect))};
  return {};
}

void LiveSession::State::publish(Snapshot made, PictureUpdate changed) {
  made.revision = ++revision;
  made.problem = problem;
  made.problem_number = problem_number;
  {
    const std::lock_guard lock(mutex);
    snapshot = std::make_shared<const Snapshot>(std::move(made));
    merge(update, std::move(changed));
  }
  if (on_change) on_change();
}

} // namespace oversketch
