#include "ui/panels/recovery_bar.h"

#include "ui/theme/icons.h"
#include "ui/widgets/buttons.h"

#include <algorithm>
#include <vector>

namespace oversketch {
namespace {

constexpr std::size_t kNoticeLines = 5;

struct NoticeLine {
  std::string shown;
  /// What is cut short in it, or left out for it.
  std::string whole;
};

/// The last one stands for all that have no place.
std::vector<NoticeLine> lines_of_notice(const std::string& notice) {
  std::vector<NoticeLine> lines;
  for (std::size_t begin = 0; begin <= notice.size();) {
    const auto more =
        static_cast<std::size_t>(std::count(notice.begin() + static_cast<std::ptrdiff_t>(begin), notice.end(), '\n'));
    if (lines.size() + 1 == kNoticeLines && more > 0) {
      lines.push_back({"and " + std::to_string(more + 1) + " more", notice.substr(begin)});
      break;
    }
    const std::size_t end = std::min(notice.find('\n', begin), notice.size());
    const std::string line = notice.substr(begin, end - begin);
    lines.push_back({line, line});
    begin = end + 1;
  }
  return lines;
}

} // namespace

RecoveryBarModel make_recovery_bar_model(const EditorState& state, bool beside_work) {
  RecoveryBarModel model;
  if (!beside_work || state.recovered_left || state.recovered.empty()) return model;
  model.documents = state.recovered.size();
  model.text = "Not saved when the program last ended: ";
  for (std::size_t i = 0; i < state.recovered.size(); ++i)
    model.text += (i == 0 ? "" : ", ") + state.recovered[i].name + " (" + state.recovered[i].when + ")";
  return model;
}

void draw_recovery_bar(const RecoveryBarModel& model, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(area.low, area.high, mixed(look.panel, look.accent, 0.18F));
  list->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
  register_box(context, "panel.recovery", area.low, area.high);
  const float height = look.px(24), top = area.low.y + (area.height() - height) / 2;
  float right = area.high.x - look.px(8);
  const auto button = [&](const char* id, const char* label, const Tip& tip, float width, bool on) {
    right -= look.px(width);
    ImGui::SetCursorScreenPos(ImVec2(right, top));
    const bool clicked = draw_button(context, id, label, tip, {.on = on, .width = width, .height = 24});
    right -= look.px(6);
    return clicked;
  };
  if (button("recovery.later", "Later", {"Kept for a week, and offered again at the next start.", {}}, 60, false))
    context.sink.emit(action::LeaveRecovered{});
  if (button("recovery.take", "Continue",
             {"Opens it in a tab, as it was before the program ended: pictures and history.", {}}, 80, true))
    for (std::size_t i = 0; i < model.documents; ++i)
      context.sink.emit(action::Recover{0});
  draw_text(ImVec2(area.low.x + look.px(14), area.low.y), ImVec2(right - look.px(8), area.high.y), look.ink,
            model.text);
}

float notice_height(const std::string& notice) {
  return notice.empty() ? 0 : 16 + 20 * static_cast<float>(lines_of_notice(notice).size());
}

void draw_notice_bar(const std::string& notice, const Area& area, const DrawContext& context) {
  const ThemeLook& look = context.look;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(area.low, area.high, mixed(look.panel, look.warning, 0.18F));
  list->AddRectFilled(ImVec2(area.low.x, area.high.y - look.px(1)), area.high, look.line);
  register_box(context, "panel.notice", area.low, area.high);
  const float right = area.high.x - look.px(68);
  ImGui::SetCursorScreenPos(ImVec2(right, area.low.y + look.px(6)));
  if (draw_button(context, "notice.close", "Close", {"Takes this message away.", {}}, {.width = 60, .height = 24}))
    context.sink.emit(action::DismissNotice{});
  float top = area.low.y + look.px(8);
  int number = 0;
  for (const NoticeLine& line : lines_of_notice(notice)) {
    const ImVec2 corner(area.low.x + look.px(14), top), low(right - look.px(8), top + look.px(20));
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(ImVec2(std::max(1.0F, low.x - corner.x), look.px(20)));
    finish_item(context, "notice." + std::to_string(number++), {line.whole, {}});
    draw_text(corner, low, look.ink, line.shown);
    top += look.px(20);
  }
}

} // namespace oversketch
