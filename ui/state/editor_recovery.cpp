// Work that earlier runs left behind, and the end of this one.
#include "ui/state/editor.h"
#include "ui/state/editor_inbox.h"
#include "ui/state/recovered_work.h"

#include <algorithm>
#include <utility>

namespace oversketch {

namespace fs = std::filesystem;

void Editor::search_lost_work() {
  if (setup_.state_folder.empty()) return;
  searching_ = true;
  janitor_ = std::jthread([inbox = inbox_, wake = setup_.wake, folder = setup_.state_folder] {
    remove_old_journals(folder, std::chrono::system_clock::now());
    auto found = list_abandoned_journals(folder);
    {
      const std::lock_guard lock(inbox->mutex);
      inbox->found = std::move(found);
    }
    if (wake) wake();
  });
}

void Editor::take_lost_work(std::vector<AbandonedJournal> found) {
  searching_ = false;
  state_.recovered.clear();
  const auto now = std::chrono::system_clock::now();
  for (const AbandonedJournal& journal : found)
    if (journal.unsaved_steps > 0) state_.recovered.push_back(describe_lost_work(journal, now));
}

void Editor::recover(std::size_t index) {
  if (index >= state_.recovered.size()) return;
  const RecoveredWork work = state_.recovered[index];
  state_.recovered.erase(state_.recovered.begin() + static_cast<std::ptrdiff_t>(index));
  waiting_.push_back(work);
  recover_waiting();
}

void Editor::recover_waiting() {
  for (std::size_t i = 0; i < waiting_.size();) {
    if (is_opening(waiting_[i].project)) {
      ++i;
      continue;
    }
    const RecoveredWork work = waiting_[i];
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    recover_now(work);
  }
}

/// Until it rests, what was done in its tab cannot be told.
bool Editor::is_opening(const fs::path& project) const {
  return !project.empty() && std::ranges::any_of(state_.tabs, [&](const Tab& tab) {
    return memories_.at(tab.id).coming == project || (tab.path == project && tab.session->activity().busy);
  });
}

void Editor::recover_now(const RecoveredWork& work) {
  Tab& tab = empty_tab();
  memories_[tab.id].coming = work.project;
  tab.name = work.name;
  tab.folder = work.project.parent_path();
  const auto lacks = std::make_shared<std::string>();
  const auto claim = std::make_shared<std::optional<FileClaim>>();
  const auto job = [=, journal = memories_[tab.id].journal, folder = setup_.state_folder,
                    limits = io_limits()](Session& session, const Watch& watch) -> Result<void> {
    auto recovered = recover_journal(work.journal, limits, watch);
    if (!recovered) return recovered.error();
    session.adopt(std::move(recovered->session));
    journal->resume(session, std::move(recovered->journal));
    if (!work.project.empty())
      if (auto taken = FileClaim::take(folder, work.project)) *claim = std::move(*taken);
    *lacks = recovered->message;
    return {};
  };
  const auto then = [=, id = tab.id](Editor& editor, const Result<void>& result) {
    if (result) {
      editor.memories_[id].coming.clear();
      if (!*claim) *claim = editor.take_over(work.project);
      Tab& recovered = *editor.find_tab(id);
      recovered.path = work.project;
      recovered.read_only = !work.project.empty() && !*claim;
      editor.memories_[id].claim = std::move(*claim);
      editor.memories_[id].stamp = work.stamp;
      if (lacks->empty()) return editor.say(work.name + " is as it was before the program ended; it is not saved yet");
      return editor.told_.push_back(work.name + " is recovered as far as it goes: " + *lacks);
    }
    // Nothing is lost: it is offered again, behind the others, whose places do not change.
    editor.say(result.error());
    editor.remove_tab(*editor.index_of(id));
    editor.state_.recovered.push_back(work);
    editor.tell_unrecovered(editor.state_.recovered.size() - 1, result.error());
  };
  run(tab, "Recovering " + work.name, job, then);
}

void Editor::tell_unrecovered(std::size_t index, const Error& error) {
  if (error.code == cancelled().code || state_.question) return;
  Question question;
  question.title = state_.recovered[index].name + " cannot be recovered";
  std::string why = to_line(error);
  if (!why.ends_with('.')) why += ".";
  question.text = why + " It is kept for a week, and offered again.";
  question.answers = {{"keep", "Keep", {}, true},
                      {"discard", "Throw away", {action::DiscardRecovered{index, true}}, false}};
  state_.question = std::move(question);
}

std::optional<FileClaim> Editor::take_over(const fs::path& project) {
  for (std::size_t i = 0; i < state_.tabs.size(); ++i) {
    const Tab& tab = state_.tabs[i];
    Memory& memory = memories_[tab.id];
    if (!memory.claim || tab.path != project) continue;
    // What was in hand when it is asked may not be in the snapshot.
    if (tab.session->activity().busy || tab.session->snapshot()->modified) return std::nullopt;
    std::optional<FileClaim> claim = std::exchange(memory.claim, std::nullopt);
    remove_tab(i);
    return claim;
  }
  return std::nullopt;
}

void Editor::discard_recovered(const action::DiscardRecovered& asked) {
  if (asked.index >= state_.recovered.size()) return;
  const RecoveredWork work = state_.recovered[asked.index];
  if (!asked.without_asking) {
    Question question;
    question.title = "Throw away the unsaved work on " + work.name + "?";
    question.text = "It cannot be brought back. Left alone, it is kept for a week.";
    question.answers = {{"discard", "Throw away", {action::DiscardRecovered{asked.index, true}}, false},
                        {"cancel", "Keep", {}, true}};
    state_.question = std::move(question);
    return;
  }
  state_.recovered.erase(state_.recovered.begin() + static_cast<std::ptrdiff_t>(asked.index));
  janitor_ = std::jthread([folder = work.journal] { discard_abandoned_journal(folder); });
}

void Editor::leave() {
  for (auto& [id, memory] : memories_)
    memory.journal->discard();
  for (Closed& closed : closed_)
    closed.journal->discard();
}

} // namespace oversketch
