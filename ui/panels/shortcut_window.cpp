#include "ui/panels/dialogs.h"

#include "ui/widgets/dialog.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace oversketch {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return text;
}

bool holds_all_words(const ShortcutRow& row, const std::string& search) {
  const std::string text = lower(row.keys + " " + row.what + " " + row.help);
  std::istringstream words(search);
  for (std::string word; words >> word;)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

void draw_shortcut(const ShortcutRow& row, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = look.px(24);
  const float keys = std::min(look.px(150), width * 0.4F);
  const float cap = std::min(keys - look.px(8), ImGui::CalcTextSize(row.keys.c_str()).x + look.px(12));
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + look.px(2)),
                                            ImVec2(at.x + cap, at.y + height - look.px(2)), look.raised, look.px(3));
  draw_text(at, ImVec2(at.x + cap, at.y + height), look.ink, row.keys, 0.5F);
  const float what = std::min(ImGui::CalcTextSize(row.what.c_str()).x + 1, width - keys);
  draw_text(ImVec2(at.x + keys, at.y), ImVec2(at.x + keys + what, at.y + height), look.ink, row.what);
  draw_text(ImVec2(at.x + keys + what + look.px(14), at.y), ImVec2(at.x + width, at.y + height), look.ink_quiet,
            row.help);
  ImGui::Dummy(ImVec2(width, height));
}

} // namespace

std::vector<ShortcutRow> find_shortcuts(std::string_view search) {
  std::vector<ShortcutRow> rows;
  for (const Entry& entry : entries())
    if (const std::string keys = keys_of(entry); !keys.empty())
      rows.push_back({keys, std::string(entry.label), std::string(entry.help)});
  for (const KeyHelp& help : canvas_keys())
    rows.push_back({std::string(help.keys), std::string(help.what), {}});
  const std::string wanted = lower(std::string(search));
  std::erase_if(rows, [&](const ShortcutRow& row) { return !holds_all_words(row, wanted); });
  return rows;
}

void draw_shortcut_window(std::string& search, const InputEvents& events, const DrawContext& context) {
  const ThemeLook& look = context.look;
  const Dialog dialog(context, "dialog.shortcuts", "Shortcuts", ImVec2(680, 620));
  if (dialog.appears()) {
    search.clear();
    give_keys_to_next_field(context);
  }
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::InputTextWithHint("##search", "Search: a key or what it does", &search);
  finish_item(context, "shortcuts.search", {"A key, or a word of what it does.", {}});
  ImGui::Dummy(ImVec2(1, look.px(2)));
  ImGui::BeginChild("##rows", ImVec2(0, std::max(look.px(40), ImGui::GetContentRegionAvail().y - look.px(58))));
  const auto rows = find_shortcuts(search);
  for (const ShortcutRow& row : rows)
    draw_shortcut(row, context);
  if (rows.empty()) draw_note(context, "No key is called that.");
  ImGui::EndChild();
  AnswerRow answers(context);
  const bool leaves = is_pressed(events, Key::kEscape) || is_pressed(events, Key::kF1);
  if (answers.draw("shortcuts.close", "Close", {"Back to the pictures.", "Esc, F1"}, true) ||
      (leaves && !dialog.appears()))
    context.sink.emit(action::ShowWindow{action::Window::kShortcuts, false});
}

} // namespace oversketch
