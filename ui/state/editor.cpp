#include "ui/state/editor.h"

#include "ui/state/editor_inbox.h"
#include "ui/state/settings.h"

#include <algorithm>
#include <utility>

namespace oversketch {
namespace {

/// For how long the status bar keeps what was said.
constexpr double kSaidFor_s = 7;

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

/// Whether an action answers what a dialog asked.
bool answers(const Action& action) {
  return std::holds_alternative<action::Open>(action) || std::holds_alternative<action::AddSource>(action) ||
         std::holds_alternative<action::SetTarget>(action) || std::holds_alternative<action::SaveAs>(action) ||
         std::holds_alternative<action::Export>(action) || std::holds_alternative<action::CloseTab>(action) ||
         std::holds_alternative<action::Quit>(action) || std::holds_alternative<action::DiscardRecovered>(action);
}

History::Limits history_limits(const Preferences& preferences) {
  History::Limits limits;
  limits.bytes = static_cast<std::size_t>(preferences.history_mib * (1 << 20));
  return limits;
}

} // namespace

std::string to_line(const Error& error) {
  return error.where.empty() ? error.sentence : error.where + ": " + error.sentence;
}

Editor::Editor(Setup setup) : setup_(std::move(setup)), inbox_(std::make_shared<Inbox>()) {
  state_.preferences = put_in_range(setup_.preferences);
  search_lost_work();
}

Editor::~Editor() = default;

void Editor::say(std::string text) {
  state_.said = std::move(text);
  state_.said_until = now_s_ + kSaidFor_s;
}

void Editor::say(const Error& error) {
  if (error.code == cancelled().code) return say(std::string("Stopped"));
  problems_.push_back(error);
  say(to_line(error));
}

std::vector<Error> Editor::take_problems() {
  return std::exchange(problems_, {});
}

Tab& Editor::add_tab(std::string name) {
  Tab tab;
  tab.id = next_tab_++;
  tab.name = std::move(name);
  const auto journal = std::make_shared<SessionJournal>(setup_.state_folder, tab.name, setup_.wake);
  tab.session =
      std::make_unique<LiveSession>(setup_.wake, [journal](const Session& session) { journal->follow(session); });
  tab.session->limit_history(history_limits(state_.preferences));
  memories_[tab.id].journal = journal;
  state_.tabs.push_back(std::move(tab));
  state_.front = state_.tabs.size() - 1;
  return state_.tabs.back();
}

std::optional<std::size_t> Editor::index_of(int id) const {
  const auto found = std::ranges::find(state_.tabs, id, &Tab::id);
  if (found == state_.tabs.end()) return std::nullopt;
  return static_cast<std::size_t>(found - state_.tabs.begin());
}

Tab* Editor::find_tab(int id) {
  const auto index = index_of(id);
  return index ? &state_.tabs[*index] : nullptr;
}

void Editor::remove_tab(std::size_t index) {
  Tab& tab = state_.tabs[index];
  const auto journal = memories_[tab.id].journal;
  tab.session->cancel();
  tab.session->run("", [journal](Session&, const Watch&) {
    journal->discard();
    return Result<void>{};
  });
  memories_.erase(tab.id);
  closed_.push_back({std::move(tab.session), journal});
  state_.tabs.erase(state_.tabs.begin() + static_cast<std::ptrdiff_t>(index));
  if (state_.front > index || state_.front == state_.tabs.size()) state_.front -= state_.front > 0 ? 1 : 0;
}

void Editor::run(Tab& tab, std::string label, LiveSession::Job job, Then then) {
  ++memories_[tab.id].running;
  const auto deliver = [inbox = inbox_, wake = setup_.wake, id = tab.id,
                        then = std::move(then)](const Result<void>& result) {
    {
      const std::lock_guard lock(inbox->mutex);
      inbox->entries.push_back({id, then, result});
    }
    if (wake) wake();
  };
  tab.session->run(std::move(label), std::move(job), deliver);
}

void Editor::take_inbox() {
  std::vector<Inbox::Entry> entries;
  std::optional<std::vector<AbandonedJournal>> found;
  {
    const std::lock_guard lock(inbox_->mutex);
    entries.swap(inbox_->entries);
    found.swap(inbox_->found);
  }
  if (found) take_lost_work(std::move(*found));
  for (const Inbox::Entry& entry : entries) {
    if (find_tab(entry.tab) == nullptr) continue;
    --memories_[entry.tab].running;
    if (entry.then) entry.then(*this, entry.result);
  }
}

void Editor::update(const CanvasRects& canvases, double now_s) {
  now_s_ = now_s;
  canvases_ = canvases;
  std::erase_if(closed_, [](const Closed& closed) { return !closed.session->activity().busy; });
  take_inbox();
  for (Tab& tab : state_.tabs)
    watch_tab(tab);
  write_notice();
  recover_waiting();
  advance_leaving();
  if (Tab* tab = state_.tab()) {
    for (const Side side : {Side::kSource, Side::kTarget})
      fit(*tab, side);
    last_canvases_ = canvases_;
  }
}

void Editor::write_notice() {
  std::string& notice = state_.notice;
  notice.clear();
  const auto add = [&](const std::string& line) { notice += (notice.empty() ? "" : "\n") + line; };
  for (const std::string& line : told_)
    add(line);
  for (const Tab& tab : state_.tabs)
    if (const Memory& memory = memories_[tab.id]; memory.tells_unkept)
      add("Unsaved work on " + tab.name + " cannot be kept against a crash: " + memory.unkept->sentence);
}

void Editor::dismiss_notice() {
  told_.clear();
  for (auto& [id, memory] : memories_)
    memory.tells_unkept = false;
  write_notice();
}

void Editor::watch_tab(Tab& tab) {
  Memory& memory = memories_[tab.id];
  // Asked first: what was in hand then may not be in the snapshot.
  const bool working = tab.session->activity().busy;
  const auto snapshot = tab.session->snapshot();
  if (snapshot->problem && snapshot->problem_number != memory.problem_number) say(*snapshot->problem);
  memory.problem_number = snapshot->problem_number;
  // No work of anybody's has failed: it is told as long as it is so, and work goes on.
  if (auto problem = memory.journal->problem(); problem != memory.unkept) {
    memory.unkept = std::move(problem);
    memory.tells_unkept = memory.unkept.has_value();
  }

  const Document& document = snapshot->document;
  const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
  auto& pin = tab.view.selected_pin;
  // A pin is selected when it is asked for: it is there once the session has come to it.
  if (pin && !working && (layer == nullptr || std::ranges::find(layer->pins, *pin, &Pin::id) == layer->pins.end()))
    pin.reset();
  // Another picture is looked at from the beginning.
  const Hash source = layer != nullptr ? layer->source.image.content_hash() : Hash{};
  const Hash target = document.empty() ? Hash{} : document.target.image.content_hash();
  if (source != memory.source) tab.view.source.fit_wanted = true;
  if (target != memory.target) tab.view.target.fit_wanted = true;
  memory.source = source;
  memory.target = target;
}

bool Editor::busy() const {
  const auto works = [](const auto& session) { return session->activity().busy; };
  const auto runs = [](const auto& memory) { return memory.second.running > 0; };
  return std::ranges::any_of(memories_, runs) || searching_ || !waiting_.empty() ||
         std::ranges::any_of(state_.tabs, works, &Tab::session) ||
         std::ranges::any_of(closed_, works, &Closed::session);
}

void Editor::perform_all(std::vector<Action> actions) {
  const bool answered = std::ranges::any_of(actions, answers);
  const auto is_dismissal = [](const Action& action) { return std::holds_alternative<action::Dismiss>(action); };
  // What an answer leads to may ask the next question: the old one goes first.
  if (std::erase_if(actions, is_dismissal) > 0) {
    if (!answered) leaving_.reset();
    perform(action::Dismiss{});
  }
  for (Action& action : actions)
    perform(std::move(action));
}

void Editor::perform(Action action) {
  const auto in_front = [&](const auto& work) {
    if (Tab* tab = state_.tab()) work(*tab);
  };
  std::visit(Overloaded{
                 [&](action::Execute& a) { in_front([&](Tab& tab) { tab.session->execute(std::move(a.command)); }); },
                 [&](action::Preview& a) { in_front([&](Tab& tab) { tab.session->preview(std::move(a.command)); }); },
                 [&](action::Commit&) { in_front([](Tab& tab) { tab.session->commit(); }); },
                 [&](action::Abandon&) { in_front([](Tab& tab) { tab.session->abandon(); }); },
                 [&](action::Undo& a) { in_front([&](Tab& tab) { tab.session->undo(a.steps); }); },
                 [&](action::Redo& a) { in_front([&](Tab& tab) { tab.session->redo(a.steps); }); },
                 [&](action::Jump& a) { in_front([&](Tab& tab) { tab.session->jump(a.entry); }); },
                 [&](action::CancelWork&) { in_front([](Tab& tab) { tab.session->cancel(); }); },
                 [&](action::NewDocument& a) { new_document(a); },
                 [&](action::Open& a) { open(a.path); },
                 [&](action::AddSource& a) { add_source(a.path); },
                 [&](action::SetTarget& a) { set_target(a.path); },
                 [&](action::Save&) { in_front([&](Tab& tab) { save(tab); }); },
                 [&](action::SaveAs& a) { save_as(a); },
                 [&](action::ExportAgain&) { export_again(); },
                 [&](action::Export& a) { export_to(a); },
                 [&](action::OpenSample&) { open(setup_.assets / "samples" / "puffer.jsonl", false); },
                 [&](action::Recover& a) { recover(a.index); },
                 [&](action::DiscardRecovered& a) { discard_recovered(a); },
                 [&](action::CloseTab& a) { close(a); },
                 [&](action::Quit& a) { quit(a); },
                 [&](auto&) { perform_view(action); },
             },
             action);
}

void Editor::perform_view(const Action& action) {
  Tab* tab = state_.tab();
  if (tab == nullptr) return perform_window(action);
  DocumentView& view = tab->view;
  std::visit(Overloaded{
                 [&](const action::SetView& a) {
                   view.canvas(a.side) = {a.view, false};
                 },
                 [&](const action::Fit& a) { view.canvas(a.side).fit_wanted = true; },
                 [&](const action::ZoomBy& a) { zoom(a.side, a.factor); },
                 [&](const action::ZoomTo& a) { zoom(a.side, a.zoom / view.canvas(a.side).view.zoom); },
                 [&](const action::SetSplit& a) { view.split = std::clamp(a.split, 0.0, 1.0); },
                 [&](const action::SetCompare& a) {
                   view.compare = a.compare;
                   view.compare_split = std::clamp(a.split, 0.0, 1.0);
                   show_compare(*tab);
                 },
                 [&](const action::HoldBefore& a) {
                   view.before_held = a.held;
                   show_compare(*tab);
                 },
                 [&](const action::SelectPin& a) { view.selected_pin = a.pin; },
                 [&](const action::WantAlternatives& a) { tab->session->want_alternatives(a.wanted); },
                 [&](const auto&) { perform_window(action); },
             },
             action);
}

void Editor::perform_window(const Action& action) {
  std::visit(Overloaded{
                 [&](const action::SelectTab& a) {
                   if (a.tab < state_.tabs.size()) state_.front = a.tab;
                 },
                 [&](const action::Dismiss&) {
                   state_.question.reset();
                   state_.file_request.reset();
                   state_.asks_new_document = false;
                 },
                 [&](const action::PickTool& a) { state_.tool = a.tool; },
                 [&](const action::SetOverlays& a) { state_.overlays = a.overlays; },
                 [&](const action::LeaveRecovered&) { state_.recovered_left = true; },
                 [&](const action::SetPreferences& a) {
                   const double memory_before = state_.preferences.history_mib;
                   state_.preferences = put_in_range(a.preferences);
                   if (state_.preferences.history_mib != memory_before)
                     for (const Tab& each : state_.tabs)
                       each.session->limit_history(history_limits(state_.preferences));
                   if (setup_.keep_preferences) setup_.keep_preferences(state_.preferences);
                 },
                 [&](const action::ShowWindow& a) {
                   if (a.window == action::Window::kShortcuts) state_.show_shortcuts = a.shown;
                   if (a.window == action::Window::kPreferences) state_.show_preferences = a.shown;
                   if (a.window == action::Window::kAbout) state_.show_about = a.shown;
                 },
                 [&](const action::DismissNotice&) { dismiss_notice(); },
                 [&](const action::Say& a) { say(a.text); },
                 [](const auto&) {},
             },
             action);
}

} // namespace oversketch
