#include "ui/panels/dialog_host.h"

namespace oversketch {
namespace {

/// How often the desktop's dialog is asked for its answer.
constexpr double kPoll_s = 0.1;

bool uses_system(const EditorState& state, const WindowState::Parts& parts) {
  return state.preferences.system_dialog && parts.system != nullptr && parts.system->available();
}

void emit_answer(const FileRequest& request, const std::filesystem::path& path, ActionSink& sink) {
  using For = FileRequest::For;
  sink.emit(action::Dismiss{});
  if (path.empty()) return;
  switch (request.purpose) {
  case For::kOpen:
    return sink.emit(action::Open{path});
  case For::kAddSource:
    return sink.emit(action::AddSource{path});
  case For::kSetTarget:
    return sink.emit(action::SetTarget{path});
  case For::kSaveAs:
    return sink.emit(action::SaveAs{path});
  case For::kExport:
    return sink.emit(action::Export{path});
  }
}

/// The desktop's dialog is a program of its own: it is started once for each request, then asked now and then.
void follow_system_dialog(const EditorState& state, WindowState::Parts& parts, const DrawContext& context) {
  const auto same = [](const FileRequest& a, const FileRequest& b) {
    return a.purpose == b.purpose && a.proposal == b.proposal;
  };
  const bool wanted = state.file_request && uses_system(state, parts);
  if (parts.system_request && (!wanted || !same(*parts.system_request, *state.file_request))) {
    parts.system->stop();
    parts.system_request.reset();
  }
  if (!wanted) return;
  if (!parts.system_request) {
    parts.system_request = state.file_request;
    parts.system->start(*state.file_request);
  }
  if (const auto path = parts.system->poll()) {
    emit_answer(*parts.system_request, *path, context.sink);
    parts.system_request.reset();
    return;
  }
  context.reply.ask_frame_at(context.now_s + kPoll_s);
}

} // namespace

bool has_dialog(const EditorState& state, const WindowState::Parts& parts) {
  return state.question || (state.file_request && !uses_system(state, parts)) || state.asks_new_document ||
         state.show_preferences || state.show_shortcuts || state.show_about;
}

void draw_dialogs(const EditorState& state, WindowState::Parts& parts, Pictures& pictures, const InputEvents& events,
                  const DrawContext& context) {
  follow_system_dialog(state, parts, context);
  const bool browses = state.file_request && !uses_system(state, parts);
  if (!browses) parts.browser.close();
  if (state.question) return draw_question_dialog(*state.question, parts.chosen_answer, events, context);
  if (browses) {
    parts.browser.update(*state.file_request, state.preferences.recent_files);
    return draw_file_browser(parts.browser, pictures, events, context);
  }
  if (state.asks_new_document) return draw_new_document_dialog(parts.new_document, events, context);
  if (state.show_preferences)
    return draw_preferences_dialog(state.preferences, parts.system != nullptr && parts.system->available(), events,
                                   context);
  if (state.show_shortcuts) return draw_shortcut_window(parts.shortcut_search, events, context);
  if (state.show_about) draw_about_dialog(events, context);
}

} // namespace oversketch
