#include "app/gui/ui_map.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <fstream>

namespace oversketch::gui {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Tool tool) {
  switch (tool) {
  case Tool::kOutline:
    return "outline";
  case Tool::kSketch:
    return "sketch";
  case Tool::kPin:
    return "pin";
  case Tool::kMove:
    return "move";
  case Tool::kPan:
    return "pan";
  }
  return "";
}

const char* name_of(FileRequest::For purpose) {
  switch (purpose) {
  case FileRequest::For::kOpen:
    return "open";
  case FileRequest::For::kAddSource:
    return "add-source";
  case FileRequest::For::kSetTarget:
    return "set-target";
  case FileRequest::For::kSaveAs:
    return "save-as";
  case FileRequest::For::kExport:
    return "export";
  }
  return "";
}

Json to_json(const WidgetMap::Box& box) {
  return {box.x, box.y, box.w, box.h};
}

Json canvas_json(const std::optional<WidgetMap::Box>& rect, const View& view) {
  if (!rect) return nullptr;
  return {{"rect", to_json(*rect)}, {"zoom", view.zoom}, {"origin", {view.origin.x, view.origin.y}}};
}

void add_document(Json& map, const Tab& tab, const CanvasRects& canvases) {
  map["canvases"] = {{"source", canvas_json(canvases.source, tab.view.source.view)},
                     {"target", canvas_json(canvases.target, tab.view.target.view)}};
  const auto snapshot = tab.session->snapshot();
  map["revision"] = snapshot->revision;
  map["history"] = snapshot->history;
  map["cursor"] = snapshot->cursor;
  map["modified"] = snapshot->modified;
  map["in_gesture"] = snapshot->in_gesture;
  map["selected"] = snapshot->document.selected ? Json(to_string(*snapshot->document.selected)) : Json(nullptr);
}

} // namespace

std::string print_ui_map(const EditorState& state, const ShownFrame& frame) {
  Json map;
  map["window"] = to_json(frame.window);
  map["title"] = frame.title;
  map["status"] = frame.status;
  map["busy"] = frame.busy;
  map["canvases"] = {{"source", nullptr}, {"target", nullptr}};
  map["revision"] = 0;
  map["history"] = Json::array();
  map["cursor"] = 0;
  if (const Tab* tab = state.tab()) add_document(map, *tab, frame.canvases);
  map["tool"] = name_of(state.tool);
  map["tabs"] = Json::array();
  for (const Tab& tab : state.tabs)
    map["tabs"].push_back(tab.name);
  map["tab"] = state.front;
  map["question"] = state.question ? Json(state.question->title) : Json(nullptr);
  map["file_request"] = state.file_request ? Json(name_of(state.file_request->purpose)) : Json(nullptr);
  map["wants_text"] = frame.wants_text;
  map["pointer"] = {frame.pointer.x, frame.pointer.y};
  map["events"] = frame.events;
  map["widgets"] = Json::object();
  for (const auto& [id, box] : frame.widgets.boxes())
    map["widgets"][id] = to_json(box);
  return map.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<void> UiMapFile::write(const std::string& text) {
  if (text == last_) return {};
  // No sync to the disk, unlike write_file(): nobody reads it after the power has failed.
  const std::filesystem::path fresh = path_.string() + "." + std::to_string(getpid()) + ".tmp";
  std::ofstream file(fresh, std::ios::binary);
  file << text;
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(fresh, path_, failure);
  if (!file || failure) return Error{"file.write", "the map of the window cannot be written", path_.string()};
  last_ = text;
  return {};
}

} // namespace oversketch::gui
