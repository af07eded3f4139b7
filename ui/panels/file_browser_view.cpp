#include "ui/panels/file_browser.h"

#include "ui/panels/panel_parts.h"
#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"
#include "ui/widgets/dialog.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <utility>

namespace oversketch {
namespace {

using For = FileRequest::For;

constexpr float kFileRow = 26, kPlaces = 130, kPreview = 210;

const char* title_of(For purpose) {
  switch (purpose) {
  case For::kOpen:
    return "Open";
  case For::kAddSource:
    return "Add source image";
  case For::kSetTarget:
    return "Change target";
  case For::kSaveAs:
    return "Save as";
  case For::kExport:
    return "Export picture";
  }
  return "";
}

const char* verb_of(For purpose) {
  switch (purpose) {
  case For::kOpen:
    return "Open";
  case For::kAddSource:
    return "Add";
  case For::kSetTarget:
    return "Change";
  case For::kSaveAs:
    return "Save";
  case For::kExport:
    return "Export";
  }
  return "";
}

const char* icon_of(const FileRow& row) {
  return row.folder             ? icon::kFolder
         : is_picture(row.path) ? icon::kPicture
         : is_project(row.path) ? icon::kFileText
                                : icon::kFile;
}

/// Tab in the path field: as far as all names agree.  What has begun outside goes on behind it.
int complete(ImGuiInputTextCallbackData* data) {
  FileBrowser& browser = *static_cast<FileBrowser*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackAlways) {
    if (!std::exchange(browser.path_begins, false)) return 0;
    data->CursorPos = data->BufTextLen;
    data->ClearSelection();
    return 0;
  }
  const std::string text = complete_path({data->Buf, static_cast<std::size_t>(data->BufTextLen)}, browser.folder());
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, text.c_str());
  return 0;
}

void draw_path_row(FileBrowser& browser, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, side = look.px(28);
  if (draw_icon_button(context, "browser.up", icon::kLevelUp, {"To the folder above.", "Backspace"},
                       {.enabled = !browser.folder().empty(), .width = 28, .height = 28}))
    browser.go_up();
  ImGui::SetCursorScreenPos(ImVec2(at.x + side + look.px(6), at.y));
  ImGui::SetNextItemWidth(width - 2 * (side + look.px(6)));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(look.px(8), (side - ImGui::GetFontSize()) / 2));
  if (browser.path_begins) give_keys_to_next_field(context);
  const bool entered = ImGui::InputText("##path", &browser.path_text,
                                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
                                            ImGuiInputTextFlags_CallbackAlways,
                                        complete, &browser);
  ImGui::PopStyleVar();
  finish_item(context, "browser.path", {"Where it is: type a folder or a file. Tab completes, Enter goes there.", {}});
  if (entered) browser.accept_path(context.sink);
  ImGui::SetCursorScreenPos(ImVec2(at.x + width - side, at.y));
  if (draw_icon_button(context, "browser.new_folder", icon::kPlus, {"A new folder in this one.", {}},
                       {.enabled = !browser.folder().empty(), .width = 28, .height = 28})) {
    browser.asks_folder = !browser.asks_folder;
    browser.new_folder.clear();
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + side + look.px(8)));
}

void draw_new_folder(FileBrowser& browser, const DrawContext& context) {
  if (!browser.asks_folder) return;
  const RowBox row = begin_row(context, "New folder");
  ImGui::SetNextItemWidth(row.width() - context.look.px(90));
  const bool entered = ImGui::InputText("##folder", &browser.new_folder, ImGuiInputTextFlags_EnterReturnsTrue);
  finish_item(context, "browser.folder_name", {"The new folder's name. Enter makes it.", {}});
  ImGui::SetCursorScreenPos(ImVec2(row.end.x - context.look.px(80), row.corner.y));
  const bool clicked = draw_button(context, "browser.make_folder", "Make", {"Makes the folder and goes into it.", {}},
                                   {.enabled = !browser.new_folder.empty(), .width = 80, .height = 24});
  if (entered || clicked) browser.make_folder();
  end_row(context, row);
}

void draw_places(FileBrowser& browser, ImVec2 size, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImGui::BeginChild("##places", size);
  for (const Place& place : browser.places()) {
    const IdScope scope(place.id);
    const ImVec2 at = ImGui::GetCursorScreenPos(), end(at.x + size.x - look.px(8), at.y + look.px(kFileRow));
    if (ImGui::InvisibleButton("##place", ImVec2(end.x - at.x, end.y - at.y))) {
      if (place.path.empty())
        browser.go_to_recent();
      else
        browser.go_to(place.path);
    }
    const bool here = browser.folder() == place.path, hovered = ImGui::IsItemHovered();
    if (here || hovered)
      ImGui::GetWindowDrawList()->AddRectFilled(at, end, here ? look.selected : look.raised, look.px(4));
    draw_text(ImVec2(at.x + look.px(8), at.y), end, here ? look.ink : mixed(look.ink, look.ink_quiet, 0.4F),
              place.label);
    finish_item(context, "browser.place." + place.id,
                {place.path.empty() ? "What was opened before." : place.path.string(), {}});
    ImGui::SetCursorScreenPos(ImVec2(at.x, end.y + look.px(1)));
  }
  ImGui::Dummy(ImVec2(1, 1));
  ImGui::EndChild();
}

/// What is typed or pasted while no field has the keyboard.
void read_path(FileBrowser& browser, const InputEvents& events) {
  std::string typed;
  for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters)
    typed += letter < 128 ? static_cast<char>(letter) : ' ';
  if (browser.begin_path(typed)) return;
  const bool pasted = std::ranges::any_of(events, [](const InputEvent& event) {
    return event.kind == InputEvent::Kind::kKeyDown && event.modifiers.ctrl && event.key == key_of('V');
  });
  const char* text = pasted ? ImGui::GetClipboardText() : nullptr;
  if (text != nullptr) browser.begin_path(text);
}

/// Right edges of the columns: name, size, date.
struct Columns {
  float name = 0;
  float size = 0;
  float date = 0;
};
Columns columns_of(const DrawContext& context, float left, float width) {
  const bool wide = width > context.look.px(380);
  const float date = wide ? context.look.px(125) : 0, size = width > context.look.px(240) ? context.look.px(80) : 0;
  return {left + width - date - size, left + width - date, left + width};
}

void draw_header(FileBrowser& browser, float width, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const Columns columns = columns_of(context, at.x, width);
  struct Head {
    FileSort sort;
    const char* id;
    const char* label;
    float left;
    float right;
    float align;
  };
  const std::array heads = {Head{FileSort::kName, "browser.sort.name", "Name", at.x, columns.name, 0},
                            Head{FileSort::kSize, "browser.sort.size", "Size", columns.name, columns.size, 1},
                            Head{FileSort::kDate, "browser.sort.date", "Changed", columns.size, columns.date, 1}};
  for (const Head& head : heads) {
    if (head.right - head.left < 2) continue;
    const IdScope scope(head.id);
    ImGui::SetCursorScreenPos(ImVec2(head.left, at.y));
    if (ImGui::InvisibleButton("##head", ImVec2(head.right - head.left, look.px(22)))) browser.sort_by(head.sort);
    const bool hovered = ImGui::IsItemHovered(), on = browser.sort() == head.sort;
    finish_item(context, head.id, {"Puts the list in this order; again turns it round.", {}});
    const std::string label = std::string(head.label) + (!on ? "" : browser.descending() ? " ↓" : " ↑");
    draw_text(ImVec2(head.left + look.px(8), at.y), ImVec2(head.right - look.px(8), at.y + look.px(22)),
              hovered || on ? look.ink : look.ink_quiet, label, head.align);
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + look.px(24)));
}

void draw_file(FileBrowser& browser, int index, float width, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const FileRow row = browser.rows()[static_cast<std::size_t>(index)];
  const std::string id = "browser.row." + std::to_string(index);
  const IdScope scope(id);
  const ImVec2 at = ImGui::GetCursorScreenPos(), end(at.x + width, at.y + look.px(kFileRow));
  const bool clicked = ImGui::InvisibleButton("##file", ImVec2(width, end.y - at.y));
  const bool hovered = ImGui::IsItemHovered(), twice = hovered && ImGui::IsMouseDoubleClicked(0);
  finish_item(context, id, {row.path.string(), "Double-click opens"});
  const bool chosen = browser.chosen() == index;
  if (chosen || hovered)
    ImGui::GetWindowDrawList()->AddRectFilled(at, end, chosen ? look.selected : look.raised, look.px(4));
  const Columns columns = columns_of(context, at.x, width);
  const float x = at.x + look.px(8);
  draw_text(ImVec2(x, at.y), ImVec2(x + look.px(20), end.y), row.folder ? look.accent : look.ink_quiet, icon_of(row));
  draw_text(ImVec2(x + look.px(24), at.y), ImVec2(columns.name - look.px(6), end.y), look.ink, row.name);
  if (!row.folder && columns.size - columns.name > 2)
    draw_text(ImVec2(columns.name, at.y), ImVec2(columns.size - look.px(8), end.y), look.ink_quiet,
              format_bytes(row.bytes), 1);
  if (columns.date - columns.size > 2)
    draw_text(ImVec2(columns.size, at.y), ImVec2(columns.date - look.px(8), end.y), look.ink_quiet,
              format_time(row.time), 1);
  ImGui::SetCursorScreenPos(ImVec2(at.x, end.y));
  if (twice) {
    browser.click(index);
    browser.accept(context.sink);
  } else if (clicked && !chosen) {
    browser.click(index);
    browser.reveal = false;
  }
}

void draw_list(FileBrowser& browser, ImVec2 size, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y), look.sunken,
                                            look.px(4));
  ImGui::BeginChild("##list", size);
  const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x - look.px(4));
  draw_header(browser, width, context);
  const float row = look.px(kFileRow), left = ImGui::GetWindowHeight() - look.px(24);
  ImGui::BeginChild("##rows", ImVec2(0, std::max(1.0F, left)));
  const float inner = std::max(1.0F, ImGui::GetContentRegionAvail().x - look.px(4));
  const auto count = static_cast<int>(browser.rows().size());
  if (std::exchange(browser.reveal, false) && browser.chosen() >= 0) {
    const float at = row * static_cast<float>(browser.chosen()), view = ImGui::GetWindowHeight();
    if (at < ImGui::GetScrollY()) ImGui::SetScrollY(at);
    if (at + row > ImGui::GetScrollY() + view) ImGui::SetScrollY(at + row - view);
  }
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const int first = std::max(0, static_cast<int>(ImGui::GetScrollY() / row) - 1);
  const int last = std::min(count, first + static_cast<int>(ImGui::GetWindowHeight() / row) + 3);
  for (int i = first; i < last && i < static_cast<int>(browser.rows().size()); ++i) {
    ImGui::SetCursorScreenPos(ImVec2(top.x, top.y + row * static_cast<float>(i)));
    draw_file(browser, i, inner, context);
  }
  ImGui::SetCursorScreenPos(ImVec2(top.x, top.y + row * static_cast<float>(count)));
  ImGui::Dummy(ImVec2(1, 1));
  if (count == 0) {
    ImGui::SetCursorScreenPos(ImVec2(top.x + look.px(8), top.y + look.px(6)));
    draw_note(context, browser.reading() ? "Reading…" : "Nothing to show here.");
  }
  ImGui::EndChild();
  ImGui::EndChild();
  register_box(context, "browser.list", corner, ImVec2(corner.x + size.x, corner.y + size.y));
}

void draw_preview(FileBrowser& browser, Pictures& pictures, ImVec2 size, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float picture = std::min(size.x, size.y * 0.6F);
  const FilePreview& preview = browser.preview();
  ImGui::BeginChild("##preview", size);
  ImGui::GetWindowDrawList()->AddRectFilled(at, ImVec2(at.x + size.x, at.y + picture), look.sunken, look.px(4));
  if (preview.picture != nullptr)
    draw_picture_in(pictures, preview.picture, at, ImVec2(at.x + size.x, at.y + picture), context);
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + picture + look.px(8)));
  if (const FileRow* row = browser.chosen_row(); row != nullptr) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(row->name.c_str());
    ImGui::PopTextWrapPos();
    if (!preview.text.empty()) draw_note(context, preview.text);
    if (!row->folder) draw_note(context, format_bytes(row->bytes));
    draw_note(context, format_time(row->time));
  }
  ImGui::EndChild();
}

void draw_name_row(FileBrowser& browser, bool appears, const DrawContext& context) {
  const RowBox row = begin_row(context, "Name");
  ImGui::SetNextItemWidth(row.width());
  if (appears) give_keys_to_next_field(context);
  const bool entered = ImGui::InputText("##name", &browser.name,
                                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  finish_item(context, "browser.name", {"The file's name; its ending is added when there is none.", {}});
  if (entered) browser.accept_name(context.sink);
  end_row(context, row);
  if (browser.request().purpose != For::kExport) return;
  static constexpr std::array kFormats = {
      Option{"png", "PNG", "Without loss, 8 bits a channel."},
      Option{"png16", "PNG 16 bit", "Without loss, 16 bits a channel: for further work."},
      Option{"jpeg", "JPEG", "Smaller, with a little loss, without transparency."},
  };
  const RowBox format = begin_row(context, "Format");
  const int chosen = draw_segments(context, "browser.format", kFormats, static_cast<int>(browser.format()));
  if (chosen >= 0) browser.set_format(static_cast<ExportFormat>(chosen));
  end_row(context, format);
}

void draw_filter_row(FileBrowser& browser, const DrawContext& context) {
  static constexpr std::array kFilters = {
      Option{"all", "All files", "Whatever there is."},
      Option{"pictures", "Pictures", "PNG, JPEG, BMP, TGA, Radiance HDR."},
      Option{"projects", "Projects", "Projects and scripts: .ora, .jsonl."},
  };
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, gap = look.px(24);
  const float hidden = std::min(look.px(130), width * 0.35F);
  const float filters = std::min(look.px(330), width - hidden - gap);
  ImGui::BeginChild("##filters", ImVec2(filters, look.px(24)), false, ImGuiWindowFlags_NoScrollbar);
  const int chosen = draw_segments(context, "browser.filter", kFilters, static_cast<int>(browser.filter()));
  ImGui::EndChild();
  if (chosen >= 0) browser.set_filter(static_cast<FileFilter>(chosen));
  ImGui::SetCursorScreenPos(ImVec2(at.x + filters + gap, at.y));
  ImGui::BeginChild("##hidden", ImVec2(hidden, look.px(24)), false, ImGuiWindowFlags_NoScrollbar);
  if (draw_toggle(context, "browser.hidden", "Hidden files", {"Names that begin with a point.", {}}, browser.hidden()))
    browser.show_hidden(!browser.hidden());
  ImGui::EndChild();
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + look.px(28)));
}

void draw_answers(FileBrowser& browser, const DrawContext& context) {
  if (browser.replaces()) {
    ImGui::TextUnformatted((browser.replaces()->filename().string() + " is there already. Replace it?").c_str());
    AnswerRow answers(context);
    if (answers.draw("browser.keep", "Keep it", {"Nothing is written; another name can be given.", "Esc"}))
      browser.keep_file();
    else if (answers.draw("browser.replace", "Replace", {"What the file holds is lost.", "Enter"}, true))
      browser.replace(context.sink);
    return;
  }
  if (!browser.message.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, context.look.warning);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(browser.message.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }
  AnswerRow answers(context);
  if (answers.draw("browser.accept", verb_of(browser.request().purpose), {"Takes what is chosen or typed.", "Enter"},
                   true, browser.can_confirm()))
    browser.confirm(context.sink);
  if (answers.draw("browser.cancel", "Cancel", {"Back to the pictures.", "Esc"})) browser.cancel(context.sink);
}

} // namespace

void draw_file_browser(FileBrowser& browser, Pictures& pictures, const InputEvents& events,
                       const DrawContext& context) {
  const ThemeLook& look = context.look;
  const bool typing = ImGui::GetIO().WantTextInput;
  const Dialog dialog(context, "dialog.browser", title_of(browser.request().purpose), ImVec2(920, 620));
  if (!dialog.appears()) browser.read_keys(events, typing, context.now_s, context.sink);
  if (!dialog.appears() && !typing && !browser.path_begins && !browser.replaces()) read_path(browser, events);
  draw_path_row(browser, context);
  draw_new_folder(browser, context);

  const float width = ImGui::GetContentRegionAvail().x;
  const bool with_places = width > look.px(440), with_preview = width > look.px(640);
  const float places = with_places ? look.px(kPlaces) : 0;
  const float preview = with_preview ? look.px(kPreview) : 0, gap = look.px(10);
  // In a low window the kinds of files give way to the files.
  const bool low = ImGui::GetIO().DisplaySize.y < look.px(400);
  const bool exports = browser.request().purpose == For::kExport;
  const float below = (browser.saves() ? 28.0F : 0.0F) + (exports ? 28.0F : 0.0F) + (low ? 0.0F : 28.0F) +
                      (browser.replaces() || !browser.message.empty() ? 24.0F : 0.0F) + 64;
  const float height = std::max(look.px(low ? 60 : 120), ImGui::GetContentRegionAvail().y - look.px(below));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (with_places) draw_places(browser, ImVec2(places, height), context);
  ImGui::SetCursorScreenPos(ImVec2(at.x + places, at.y));
  draw_list(browser, ImVec2(width - places - (with_preview ? preview + gap : 0), height), context);
  if (with_preview) {
    ImGui::SetCursorScreenPos(ImVec2(at.x + width - preview, at.y));
    draw_preview(browser, pictures, ImVec2(preview, height), context);
  }
  ImGui::SetCursorScreenPos(ImVec2(at.x, at.y + height + look.px(8)));
  if (browser.saves()) draw_name_row(browser, dialog.appears(), context);
  if (!low) draw_filter_row(browser, context);
  draw_answers(browser, context);
}

} // namespace oversketch
