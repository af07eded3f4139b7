// Closing and quitting: nothing is lost without having been asked for.
#include "ui/state/editor.h"

#include <algorithm>
#include <vector>

namespace oversketch {
namespace {

bool is_modified(const Tab& tab) {
  const auto snapshot = tab.session->snapshot();
  return snapshot->modified || snapshot->in_gesture;
}

Question ask_to_save(std::string title, Action save, Action discard) {
  Question question;
  question.title = std::move(title);
  question.text = "What was done since the last saving is lost otherwise.";
  question.answers = {{"save", "Save", {std::move(save)}, true},
                      {"discard", "Do not save", {std::move(discard)}, false},
                      {"cancel", "Cancel", {}, false}};
  return question;
}

/// A few of them, a line each.
std::string list_names(const std::vector<const Tab*>& tabs) {
  constexpr std::size_t kMost = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, tabs.size()); ++i)
    names += "\n" + tabs[i]->name;
  if (tabs.size() > kMost) names += "\nand " + std::to_string(tabs.size() - kMost) + " more";
  return names;
}

} // namespace

void Editor::close(const action::CloseTab& asked) {
  if (asked.tab >= state_.tabs.size()) return;
  Tab& tab = state_.tabs[asked.tab];
  if (asked.save_first || memories_[tab.id].saving) {
    leaving_ = Leaving{tab.id, {}};
    return;
  }
  if (!asked.without_asking && is_modified(tab)) {
    state_.question = ask_to_save("Save changes to " + tab.name + "?", action::CloseTab{asked.tab, false, true},
                                  action::CloseTab{asked.tab, true, false});
    return;
  }
  remove_tab(asked.tab);
}

void Editor::quit(const action::Quit& asked) {
  std::vector<const Tab*> modified;
  for (const Tab& tab : state_.tabs)
    if (is_modified(tab)) modified.push_back(&tab);
  if (asked.save_first) {
    leaving_ = Leaving{};
  } else if (asked.without_asking || modified.empty()) {
    // What is being saved is still saved.
    leaving_ = Leaving{};
    for (const Tab& tab : state_.tabs)
      leaving_->saved.insert(tab.id);
  } else {
    const std::string what =
        modified.size() == 1 ? modified.front()->name : std::to_string(modified.size()) + " documents";
    state_.question = ask_to_save("Save changes to " + what + " before leaving?", action::Quit{false, true},
                                  action::Quit{true, false});
    if (modified.size() > 1) state_.question->text += "\n" + list_names(modified);
  }
}

void Editor::advance_leaving() {
  if (!leaving_ || state_.file_request || state_.question) return;
  if (leaving_->tab && find_tab(*leaving_->tab) == nullptr) leaving_.reset();
  if (!leaving_) return;
  for (Tab& tab : state_.tabs) {
    if (leaving_->tab && tab.id != *leaving_->tab) continue;
    if (memories_[tab.id].saving) return;
    if (leaving_->saved.contains(tab.id) || !is_modified(tab)) continue;
    return save(tab);
  }
  if (leaving_->tab)
    remove_tab(*index_of(*leaving_->tab));
  else
    quit_ = true;
  leaving_.reset();
}

} // namespace oversketch
