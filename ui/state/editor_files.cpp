// The editor's files: opening, adding, saving, exporting.
#include "ui/state/editor.h"

#include <algorithm>
#include <cctype>
#include <memory>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

fs::path made_absolute(const fs::path& path) {
  std::error_code failure;
  const fs::path absolute = fs::absolute(path, failure).lexically_normal();
  return failure ? path : absolute;
}

/// The name with that ending, unless it has one.
fs::path with_ending(fs::path path, const char* ending) {
  return path.has_extension() ? path : path += ending;
}

/// Whether nobody else has the project open; without a place for claims, nobody is known to.
bool claim_file(const fs::path& state_folder, const fs::path& project, std::optional<FileClaim>& claim) {
  if (state_folder.empty()) return true;
  auto taken = FileClaim::take(state_folder, project);
  if (!taken) return true;
  claim = std::move(*taken);
  return claim.has_value();
}

bool is_on_disk(const fs::path& path) {
  std::error_code failure;
  return fs::exists(path, failure);
}

} // namespace

bool Editor::is_untouched(const Tab& tab) const {
  return memories_.at(tab.id).running == 0 && !tab.session->activity().busy &&
         tab.session->snapshot()->document.empty() && tab.path.empty();
}

Tab& Editor::empty_tab() {
  return state_.tab() != nullptr && is_untouched(*state_.tab()) ? *state_.tab() : add_tab("");
}

void Editor::request_file(FileRequest::For purpose, fs::path proposal) {
  state_.file_request = FileRequest{purpose, std::move(proposal)};
}

void Editor::remember_file(const fs::path& path) {
  auto& recent = state_.preferences.recent_files;
  std::erase(recent, path);
  recent.insert(recent.begin(), path);
  perform(action::SetPreferences{state_.preferences});
}

IoLimits Editor::io_limits() const {
  IoLimits limits;
  limits.memory_bytes = static_cast<std::size_t>(state_.preferences.pictures_mib) << 20;
  return limits;
}

std::string Editor::unused_name(const std::string& stem) const {
  std::string name = stem;
  for (int n = 2; std::ranges::find(state_.tabs, name, &Tab::name) != state_.tabs.end(); ++n)
    name = stem + " " + std::to_string(n);
  return name;
}

void Editor::new_document(const action::NewDocument& asked) {
  if (!asked.what) {
    state_.asks_new_document = true;
    return;
  }
  state_.asks_new_document = false;
  Tab& tab = add_tab(unused_name("Untitled"));
  const auto job = [what = *asked.what, limits = io_limits()](Session& session, const Watch& watch) {
    return make_document(session, what, limits, watch);
  };
  const auto then = [id = tab.id](Editor& editor, const Result<void>& result) {
    if (result) return;
    editor.say(result.error());
    editor.remove_tab(*editor.index_of(id));
  };
  run(tab, "Making a picture", job, then);
  state_.tool = Tool::kOutline;
}

void Editor::open(const fs::path& path, bool remember) {
  if (path.empty()) {
    const Tab* tab = state_.tab();
    return request_file(FileRequest::For::kOpen, tab != nullptr ? tab->folder : fs::path());
  }
  state_.file_request.reset();
  told_.clear();
  const fs::path file = made_absolute(path);
  for (std::size_t i = 0; i < state_.tabs.size(); ++i)
    if (state_.tabs[i].path == file || memories_[state_.tabs[i].id].coming == file) {
      state_.front = i;
      return say(file.filename().string() + " is open already");
    }
  Tab& tab = empty_tab();
  tab.name = file.stem().string();
  // Beside the sample nobody wants to save.
  tab.folder = remember ? file.parent_path() : fs::path();
  const auto opened = std::make_shared<OpenedFile>();
  const bool project = kind_of_file(file) == FileKind::kProject;
  if (project) memories_[tab.id].coming = file;
  const auto claim = std::make_shared<std::optional<FileClaim>>();
  const auto stamp = std::make_shared<std::optional<FileStamp>>();
  const auto job = [=, journal = memories_[tab.id].journal, folder = setup_.state_folder,
                    limits = io_limits()](Session& session, const Watch& watch) -> Result<void> {
    *stamp = stamp_of(file);
    auto result = open_file(session, file, limits, watch);
    if (!result) return result.error();
    *opened = std::move(*result);
    journal->begin(session, project ? file.string() : file.stem().string(), project ? file : fs::path());
    if (project && !opened->read_only && !claim_file(folder, file, *claim)) {
      opened->read_only = true;
      opened->message = file.filename().string() +
                        " is open in another Oversketch window: here it can only be saved under another name";
    }
    return {};
  };
  const auto then = [=, id = tab.id](Editor& editor, const Result<void>& result) {
    if (!result) {
      editor.say(result.error());
      editor.tell_unopened(file, result.error());
      return editor.remove_tab(*editor.index_of(id));
    }
    editor.memories_[id].coming.clear();
    Tab& done = *editor.find_tab(id);
    done.read_only = opened->read_only;
    if (project) done.path = file;
    editor.memories_[id].claim = std::move(*claim);
    editor.memories_[id].stamp = *stamp;
    if (!remember) return;
    if (!opened->message.empty()) editor.say(opened->message);
    editor.remember_file(file);
  };
  run(tab, "Opening " + file.filename().string(), job, then);
}

void Editor::run_script_in_tab(const fs::path& script, const fs::path& out) {
  const fs::path file = made_absolute(script), folder = made_absolute(out);
  Tab& tab = add_tab(file.stem().string());
  tab.folder = file.parent_path();
  run(tab, "Running " + file.filename().string(),
      [file, folder, limits = io_limits()](Session& session, const Watch& watch) {
        return run_whole_script(session, file, folder, limits, watch);
      },
      {});
}

Result<void> Editor::record_front(const fs::path& path) {
  Tab* tab = state_.tab();
  if (tab == nullptr) return Error{"record.nothing", "no document is open: there is nothing to record", path.string()};
  const auto outcome = std::make_shared<Result<void>>(cancelled());
  tab->session->run(
      "Recording", [path](Session& session, const Watch&) { return record_session(session, path); },
      [outcome](const Result<void>& result) { *outcome = result; });
  tab->session->wait_until_idle();
  return *outcome;
}

void Editor::add_source(const fs::path& path) {
  Tab* tab = state_.tab();
  if (path.empty()) return request_file(FileRequest::For::kAddSource, tab != nullptr ? tab->folder : fs::path());
  state_.file_request.reset();
  told_.clear();
  const bool own_target = path == kTargetName;
  if (tab == nullptr || (is_untouched(*tab) && !own_target)) return open(path);
  const fs::path file = own_target ? path : made_absolute(path);
  const auto job = [file, limits = io_limits()](Session& session, const Watch& watch) {
    return oversketch::add_source(session, file, limits, watch);
  };
  const auto then = [file](Editor& editor, const Result<void>& result) {
    if (!result) return editor.tell_unopened(file, result.error());
    editor.state_.tool = Tool::kOutline;
  };
  run(*tab, "Adding " + file.filename().string(), job, then);
}

void Editor::set_target(const fs::path& path) {
  Tab* tab = state_.tab();
  if (path.empty()) return request_file(FileRequest::For::kSetTarget, tab != nullptr ? tab->folder : fs::path());
  state_.file_request.reset();
  told_.clear();
  if (tab == nullptr || is_untouched(*tab)) return open(path);
  const fs::path file = made_absolute(path);
  const auto job = [file, limits = io_limits()](Session& session, const Watch& watch) {
    return oversketch::set_target(session, file, limits, watch);
  };
  const auto then = [file](Editor& editor, const Result<void>& result) {
    if (!result) editor.tell_unopened(file, result.error());
  };
  run(*tab, "Opening " + file.filename().string(), job, then);
}

bool Editor::ask_to_replace(const fs::path& path, Action again) {
  if (!is_on_disk(path)) return false;
  Question question;
  question.title = "Replace " + path.filename().string() + "?";
  question.text = "A file of that name is there already. Its contents will be lost.";
  question.answers = {{"replace", "Replace", {std::move(again)}, false}, {"cancel", "Cancel", {}, true}};
  state_.question = std::move(question);
  return true;
}

bool Editor::ask_to_replace_newer(const Tab& tab) {
  const auto there = stamp_of(tab.path);
  if (!there || there == memories_[tab.id].stamp) return false;
  const fs::path path = tab.path;
  state_.front = *index_of(tab.id);
  Question question;
  question.title = "Replace " + path.filename().string() + "?";
  question.text = "The file is another one than was opened or saved here: something has written it meanwhile. "
                  "What it holds now will be lost.";
  question.answers = {{"replace", "Replace", {action::SaveAs{path, true}}, false},
                      {"elsewhere", "Save elsewhere…", {action::SaveAs{}}, true},
                      {"cancel", "Cancel", {}, false}};
  state_.question = std::move(question);
  return true;
}

void Editor::tell_failure(const std::string& title, const Error& error, const std::string& elsewhere, Action again) {
  // A question that is open already is not to be lost; what failed is in the status line, too.
  if (error.code == cancelled().code || state_.question) return;
  Question question;
  question.title = title;
  question.text = error.where.empty() ? error.sentence : error.where + ": " + error.sentence;
  question.answers = {{"elsewhere", elsewhere, {std::move(again)}, true}, {"cancel", "Close", {}, false}};
  state_.question = std::move(question);
}

void Editor::tell_unopened(const fs::path& path, const Error& error) {
  if (error.code == cancelled().code) return;
  const bool named = error.where.empty() || fs::path(error.where) == path;
  std::string why = named ? error.sentence : to_line(error);
  // Some are whole sentences, which here go on after the colon.
  if (named && why.size() > 1 && std::islower(static_cast<unsigned char>(why[1])) != 0)
    why[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(why[0])));
  told_.push_back(path.filename().string() + " is not opened: " + why);
}

void Editor::save(Tab& tab) {
  if (!tab.path.empty() && !tab.read_only) {
    if (!ask_to_replace_newer(tab)) save_to(tab, tab.path);
    return;
  }
  state_.front = *index_of(tab.id);
  request_file(FileRequest::For::kSaveAs, tab.folder / (tab.name + kProjectEnding));
}

void Editor::save_as(const action::SaveAs& asked) {
  Tab* tab = state_.tab();
  if (tab == nullptr) return;
  if (asked.path.empty()) {
    const fs::path proposal = tab->path.empty() ? tab->folder / (tab->name + kProjectEnding) : tab->path;
    return request_file(FileRequest::For::kSaveAs, proposal);
  }
  state_.file_request.reset();
  const fs::path file = with_ending(made_absolute(asked.path), kProjectEnding);
  const bool own = file == tab->path && !tab->read_only;
  if (!asked.replace && (own ? ask_to_replace_newer(*tab) : ask_to_replace(file, action::SaveAs{file, true}))) return;
  save_to(*tab, file);
}

void Editor::save_to(Tab& tab, const fs::path& path) {
  Memory& memory = memories_[tab.id];
  if (memory.saving) return say(std::string("It is being saved already"));
  memory.saving = true;
  const bool claimed = path == tab.path && memory.claim;
  const auto claim = std::make_shared<std::optional<FileClaim>>();
  const auto stamp = std::make_shared<std::optional<FileStamp>>();
  const auto job = [=, journal = memory.journal, folder = setup_.state_folder](Session& session,
                                                                               const Watch& watch) -> Result<void> {
    if (!claimed && !claim_file(folder, path, *claim))
      return Error{"save.open-elsewhere", "it is open in another window: save under another name", path.string()};
    const auto saved = save_file(session, path, watch);
    *stamp = stamp_of(path);
    if (saved) journal->mark_saved(session, path);
    return saved;
  };
  const auto then = [=, id = tab.id](Editor& editor, const Result<void>& result) {
    editor.memories_[id].saving = false;
    if (!result) {
      editor.leaving_.reset();
      if (const auto index = editor.index_of(id)) editor.state_.front = *index;
      return editor.tell_failure(path.filename().string() + " is not saved", result.error(), "Save elsewhere…",
                                 action::SaveAs{});
    }
    Tab& saved = *editor.find_tab(id);
    saved.path = path;
    saved.folder = path.parent_path();
    saved.name = path.stem().string();
    saved.read_only = false;
    editor.memories_[id].stamp = *stamp;
    if (!claimed) editor.memories_[id].claim = std::move(*claim);
    if (editor.leaving_) editor.leaving_->saved.insert(id);
    editor.say("Saved " + path.filename().string());
    editor.remember_file(path);
  };
  run(tab, "Saving " + path.filename().string(), job, then);
}

void Editor::export_again() {
  const Tab* tab = state_.tab();
  if (tab == nullptr) return;
  export_to({tab->exported_to, tab->export_depth, true});
}

void Editor::export_to(const action::Export& asked) {
  Tab* tab = state_.tab();
  if (tab == nullptr) return;
  if (asked.path.empty()) {
    const fs::path proposal = tab->exported_to.empty() ? tab->folder / (tab->name + ".png") : tab->exported_to;
    return request_file(FileRequest::For::kExport, proposal);
  }
  state_.file_request.reset();
  const fs::path file = with_ending(made_absolute(asked.path), ".png");
  const bool replaces = !asked.replace && file != tab->exported_to;
  if (replaces && ask_to_replace(file, action::Export{file, asked.depth, true})) return;
  const auto job = [file, depth = asked.depth](Session& session, const Watch& watch) {
    return export_picture(session, file, depth, watch);
  };
  const auto then = [file, depth = asked.depth, id = tab->id](Editor& editor, const Result<void>& result) {
    if (!result)
      return editor.tell_failure(file.filename().string() + " is not exported", result.error(), "Export elsewhere…",
                                 action::Export{{}, depth, false});
    Tab& exported = *editor.find_tab(id);
    exported.exported_to = file;
    exported.export_depth = depth;
    editor.say("Exported " + file.filename().string());
  };
  run(*tab, "Exporting " + file.filename().string(), job, then);
}

} // namespace oversketch
