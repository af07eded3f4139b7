#include "ui/widgets/dialog.h"

#include "ui/widgets/buttons.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

constexpr float kPad = 18;

} // namespace

Dialog::Dialog(const DrawContext& context, std::string_view id, std::string_view title, ImVec2 size)
    : context_(context), id_(id), auto_height_(size.y <= 0), pad_(context.look.px(kPad)) {
  const ThemeLook& look = context.look;
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(whole);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(0, 0, 0, look.theme == Theme::kDark ? 130 : 80));
  ImGui::Begin(("##" + id_).c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav);
  appears_ = ImGui::IsWindowAppearing();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();

  // The height that the content had in the frame before.
  const float remembered = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("##height"), look.px(160));
  const float margin = look.px(8);
  const float w = std::min(look.px(size.x), whole.x - 2 * margin);
  const float h = std::min(auto_height_ ? remembered : look.px(size.y), whole.y - 2 * margin);
  const ImVec2 at(std::floor((whole.x - w) / 2), std::floor((whole.y - h) / 2));
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, ImVec2(at.x + w, at.y + h), look.panel, look.px(8));
  list->AddRect(at, ImVec2(at.x + w, at.y + h), look.line, look.px(8));
  register_box(context, id, at, ImVec2(at.x + w, at.y + h));

  ImGui::SetCursorScreenPos(ImVec2(at.x + pad_, at.y + look.px(2)));
  ImGui::SetNextWindowContentSize(ImVec2(std::max(1.0F, w - 2 * pad_), 0));
  ImGui::BeginChild("##content", ImVec2(w - pad_, std::max(1.0F, h - look.px(4))));
  ImGui::Dummy(ImVec2(1, look.px(8)));
  {
    const FontScope bold(look.bold);
    ImGui::TextUnformatted(title.data(), title.data() + title.size());
  }
  ImGui::Dummy(ImVec2(1, look.px(2)));
}

Dialog::~Dialog() {
  ImGui::Dummy(ImVec2(1, context_.look.px(6)));
  const float height = ImGui::GetCursorPosY() + context_.look.px(4);
  ImGui::EndChild();
  if (auto_height_) {
    float& remembered = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("##height"), 0);
    if (std::abs(remembered - height) > 0.5F) context_.reply.ask_frame_at(context_.now_s);
    remembered = height;
  }
  ImGui::End();
}

bool is_pressed(const InputEvents& events, Key key) {
  return std::ranges::any_of(
      events, [&](const InputEvent& event) { return event.kind == InputEvent::Kind::kKeyDown && event.key == key; });
}

AnswerRow::AnswerRow(const DrawContext& context) : context_(context) {
  ImGui::Dummy(ImVec2(1, context.look.px(6)));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  left_ = at.x;
  top_ = at.y;
  right_ = at.x + ImGui::GetContentRegionAvail().x;
}

bool AnswerRow::draw(std::string_view id, std::string_view label, const Tip& tip, bool preferred, bool enabled) {
  const ThemeLook& look = context_.look;
  const float needed = ImGui::CalcTextSize(label.data(), label.data() + label.size()).x + look.px(28);
  const float width = std::max(needed, look.px(84));
  // What does not fit beside the others goes to the next line.
  if (right_ - width < left_) {
    right_ = left_ + ImGui::GetContentRegionAvail().x;
    top_ += look.px(34);
  }
  ImGui::SetCursorScreenPos(ImVec2(std::max(left_, right_ - width), top_));
  const bool clicked = draw_button(context_, id, label, tip,
                                   {.on = preferred, .enabled = enabled, .width = width / look.scale, .height = 28});
  right_ -= width + look.px(8);
  ImGui::SetCursorScreenPos(ImVec2(left_, top_ + look.px(28)));
  return clicked;
}

} // namespace oversketch
