#include "ui/panels/menu_bar.h"

#include "ui/widgets/item.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

struct MenuTitle {
  Menu menu;
  const char* id;
  const char* label;
  const char* tip;
};
constexpr std::array kMenus = {
    MenuTitle{Menu::kFile, "menu.file", "File", "Opening, saving and exporting."},
    MenuTitle{Menu::kEdit, "menu.edit", "Edit", "Undo, redo and preferences."},
    MenuTitle{Menu::kLayer, "menu.layer", "Layer", "Pasted parts: add, order, remove."},
    MenuTitle{Menu::kView, "menu.view", "View", "Zoom, overlays and comparison."},
    MenuTitle{Menu::kHelp, "menu.help", "Help", "Keys, and about this program."},
};

void draw_entry(const Entry& entry, const EntryContext& entries, const DrawContext& context) {
  if (entry.begins_group) ImGui::Separator();
  const std::string label = label_of(entry, entries), keys = to_string(entry.chord);
  const bool checked = entry.checked != nullptr && entry.checked(entries);
  const IdScope scope(entry.id);
  if (ImGui::MenuItem(label.c_str(), keys.c_str(), checked, is_enabled(entry, entries))) entry.act(entries);
  finish_item(context, "menu." + std::string(entry.id), {std::string(entry.help), keys_of(entry)});
}

/// Whether the arrow to the right belongs to the submenu that has just begun, or is open.
bool takes_right(bool open) {
  return open || ImGui::IsItemFocused();
}

/// @returns takes_right().
bool draw_recent(const EntryContext& entries, const DrawContext& context) {
  const auto& recent = entries.state.preferences.recent_files;
  const bool open = ImGui::BeginMenu("Recent", !recent.empty());
  finish_item(context, "menu.file.recent", {"What was opened before, the newest first."});
  if (!open) return takes_right(open);
  for (std::size_t i = 0; i < recent.size() && i < 12; ++i) {
    const IdScope scope(std::to_string(i));
    if (ImGui::MenuItem(recent[i].filename().string().c_str())) entries.sink.emit(action::Open{recent[i]});
    finish_item(context, "menu.file.recent." + std::to_string(i), {recent[i].string()});
  }
  ImGui::EndMenu();
  return true;
}

/// @returns takes_right().
bool draw_submenu(const char* label, const char* id, const char* tip, const EntryContext& entries,
                  const DrawContext& context, void (*draw)(const EntryContext&, std::string_view, const DrawContext&)) {
  const bool open = ImGui::BeginMenu(label);
  finish_item(context, id, {tip});
  if (!open) return takes_right(open);
  draw(entries, id, context);
  ImGui::EndMenu();
  return true;
}

/// The arrows to the left and right go to the next menu.
void go_to_neighbour(const MenuTitle& title, bool right_taken, const EntryContext& entries,
                     const DrawContext& context) {
  const bool right = compat::wants_key_move(ImGuiDir_Right) && !right_taken;
  const bool left = compat::wants_key_move(ImGuiDir_Left) && ImGui::IsWindowFocused();
  if (left == right) return;
  const auto own = static_cast<std::size_t>(&title - kMenus.data());
  entries.flags.menu_wanted = kMenus[(own + (right ? 1 : kMenus.size() - 1)) % kMenus.size()].menu;
  compat::drop_key_move();
  ImGui::CloseCurrentPopup();
  context.reply.ask_frame_at(context.now_s);
}

/// @param padding  of entries; the bar's own, within which this is called, is that of its height.
/// @param bottom   of the bar: a menu that is too high scrolls below it.  Over the bar it would lie under the pointer
///   that opens it, and letting go would choose from it.
/// @param wanted   it is to be opened.
void draw_menu(const MenuTitle& title, bool wanted, ImVec2 padding, float bottom, const EntryContext& entries,
               const DrawContext& context) {
  if (wanted) {
    ImGui::OpenPopup(title.label);
    compat::show_keyboard_cursor();
  }
  const ImVec2 whole = ImGui::GetIO().DisplaySize, margin = ImGui::GetStyle().DisplaySafeAreaPadding;
  ImGui::SetNextWindowSizeConstraints(ImVec2(1, 1), ImVec2(whole.x, std::max(1.0F, whole.y - bottom - 2 * margin.y)));
  const bool open = ImGui::BeginMenu(title.label);
  finish_item(context, title.id, {title.tip});
  if (!open) return;
  close_popup_on_escape();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  bool right_taken = false;
  for (const Entry& entry : oversketch::entries()) {
    if (entry.menu != title.menu) continue;
    draw_entry(entry, entries, context);
    if (entry.id == "file.sample") right_taken |= draw_recent(entries, context);
    if (entry.id != "view.overlays") continue;
    right_taken |= draw_submenu("Overlays", "menu.view.overlay", "Which of them are drawn.", entries, context,
                                draw_overlay_entries);
    right_taken |= draw_submenu("Compare with", "menu.view.compare", "Another result over a part of the picture.",
                                entries, context, draw_compare_entries);
  }
  go_to_neighbour(title, right_taken, entries, context);
  ImGui::PopStyleVar();
  ImGui::EndMenu();
}

} // namespace

std::string document_title(const EditorState& state, const Snapshot* snapshot) {
  const Tab* tab = state.tab();
  if (tab == nullptr) return {};
  const std::string name = tab->path.empty() ? tab->name : tab->path.filename().string();
  return name + (snapshot != nullptr && snapshot->modified ? " *" : "");
}

void draw_overlay_entries(const EntryContext& entries, std::string_view prefix, const DrawContext& context) {
  Overlays overlays = entries.state.overlays;
  bool changed = false;
  // Rarely one alone is thrown.
  compat::begin_switches();
  for (const OverlayRow& row : overlay_rows()) {
    bool& on = overlays.*row.on;
    // A switch that is thrown while all are hidden shows them again: otherwise nothing would be seen of it.
    if (ImGui::MenuItem(std::string(row.label).c_str(), nullptr, on && overlays.shown)) {
      on = !(on && entries.state.overlays.shown);
      overlays.shown = true;
      changed = true;
    }
    finish_item(context, std::string(prefix) + "." + std::string(row.id), {std::string(row.help)});
  }
  compat::end_switches();
  if (changed) entries.sink.emit(action::SetOverlays{overlays});
}

void draw_compare_entries(const EntryContext& entries, std::string_view prefix, const DrawContext& context) {
  const Tab* tab = entries.state.tab();
  const DocumentView view = tab == nullptr ? DocumentView() : tab->view;
  for (const CompareRow& row : compare_rows()) {
    const bool enabled = tab != nullptr;
    if (ImGui::MenuItem(std::string(row.label).c_str(), nullptr, view.compare == row.compare, enabled))
      entries.sink.emit(action::SetCompare{row.compare, view.compare_split});
    finish_item(context, std::string(prefix) + "." + std::string(row.id), {std::string(row.help)});
  }
}

void draw_menu_bar(const EntryContext& entries, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  // The bar puts its text where a frame's padding says.
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const float middle = std::max(0.0F, std::floor((area.height() - ImGui::GetFontSize()) / 2));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(padding.x, middle));
  if (!ImGui::BeginMenuBar()) return ImGui::PopStyleVar();
  const bool narrow = area.width() < look.px(520);
  ImGui::SetCursorPosX(look.px(narrow ? 2 : 10));
  if (!narrow) {
    const FontScope bold(look.bold);
    ImGui::TextUnformatted("Oversketch");
    ImGui::SameLine(0, look.px(12));
  }
  // What one menu wants is opened in the next frame, when that one is gone.
  const std::optional<Menu> wanted = std::exchange(entries.flags.menu_wanted, std::nullopt);
  for (const MenuTitle& title : kMenus)
    draw_menu(title, title.menu == wanted, padding, area.high.y, entries, context);
  const float used = ImGui::GetCursorScreenPos().x + look.px(16);
  draw_text(ImVec2(used, area.low.y), ImVec2(area.high.x - look.px(11), area.high.y), look.ink_quiet,
            document_title(entries.state, entries.snapshot), 1);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
  ImGui::EndMenuBar();
  ImGui::PopStyleVar();
}

} // namespace oversketch
