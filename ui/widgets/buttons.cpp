#include "ui/widgets/buttons.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

PackedColor ground_of(const ThemeLook& look, const ButtonLook& button, bool hovered, bool held) {
  if (button.on) return hovered ? mixed(look.accent, look.accent_ink, 0.12F) : look.accent;
  const PackedColor still = button.quiet ? faded(look.raised, 0) : look.raised;
  if (held) return mixed(look.raised, look.ink, 0.14F);
  return hovered ? look.hovered : still;
}

/// The button's item and ground; true when it was clicked.
bool draw_ground(const DrawContext& context, ImVec2 size, const ButtonLook& button) {
  const DisabledScope disabled(!button.enabled);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("##button", size);
  const PackedColor ground = ground_of(context.look, button, ImGui::IsItemHovered(), ImGui::IsItemActive());
  const float alpha = ImGui::GetStyle().Alpha;
  const float rounding = context.look.px(button.large ? 7 : 4);
  ImGui::GetWindowDrawList()->AddRectFilled(at, ImVec2(at.x + size.x, at.y + size.y), faded(ground, alpha), rounding);
  return clicked;
}

PackedColor ink_of(const ThemeLook& look, const ButtonLook& button) {
  const PackedColor ink = button.on ? look.accent_ink : button.quiet ? mixed(look.ink, look.ink_quiet, 0.4F) : look.ink;
  return button.enabled ? ink : faded(ink, 0.4F);
}

} // namespace

bool draw_button(const DrawContext& context, std::string_view id, std::string_view text, const Tip& tip,
                 const ButtonLook& button) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const float needed = ImGui::CalcTextSize(text.data(), text.data() + text.size()).x + look.px(24);
  const ImVec2 size(button.width > 0 ? look.px(button.width) : std::ceil(needed),
                    look.px(button.height > 0 ? button.height : 26));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = draw_ground(context, size, button);
  draw_text(ImVec2(at.x + look.px(4), at.y), ImVec2(at.x + size.x - look.px(4), at.y + size.y), ink_of(look, button),
            text, 0.5F);
  finish_item(context, id, tip);
  return clicked;
}

bool draw_icon_button(const DrawContext& context, std::string_view id, std::string_view icon, const Tip& tip,
                      const ButtonLook& button) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const ImVec2 size(look.px(button.width > 0 ? button.width : 24), look.px(button.height > 0 ? button.height : 24));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = draw_ground(context, size, button);
  {
    const FontScope font(button.large ? look.icons_large : nullptr);
    const ImVec2 needed = ImGui::CalcTextSize(icon.data(), icon.data() + icon.size());
    const ImVec2 corner(std::round(at.x + (size.x - needed.x) / 2), std::round(at.y + (size.y - needed.y) / 2));
    ImGui::GetWindowDrawList()->AddText(corner, ink_of(look, button), icon.data(), icon.data() + icon.size());
  }
  finish_item(context, id, tip);
  return clicked;
}

bool draw_toggle(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip, bool on) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x), look.px(24));
  const bool clicked = ImGui::InvisibleButton("##toggle", size);
  const bool hovered = ImGui::IsItemHovered();
  finish_item(context, id, tip);

  const float alpha = ImGui::GetStyle().Alpha, w = look.px(28), h = look.px(16);
  const ImVec2 corner(at.x + size.x - w, std::floor(at.y + (size.y - h) / 2));
  const PackedColor ground = on ? look.accent : mixed(look.raised, look.ink, hovered ? 0.2F : 0.1F);
  const ImVec2 middle(corner.x + (on ? w - h / 2 : h / 2), corner.y + h / 2);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, ImVec2(corner.x + w, corner.y + h), faded(ground, alpha), h / 2);
  list->AddCircleFilled(middle, h / 2 - look.px(3), faded(on ? look.accent_ink : look.ink_quiet, alpha));
  draw_text(at, ImVec2(corner.x - look.px(8), at.y + size.y),
            hovered ? look.ink : mixed(look.ink, look.ink_quiet, 0.5F), label);
  end_row(context, {at, ImVec2(at.x + size.x, at.y + size.y), at.x});
  return clicked;
}

int draw_segments(const DrawContext& context, std::string_view id, std::span<const Option> options, int chosen) {
  const ThemeLook& look = context.look;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + std::max(1.0F, ImGui::GetContentRegionAvail().x), at.y + look.px(24));
  // What the labels leave is shared out evenly between them.
  const auto label_width = [](const Option& option) {
    return ImGui::CalcTextSize(option.label.data(), option.label.data() + option.label.size()).x;
  };
  float spare = end.x - at.x;
  for (const Option& option : options)
    spare -= label_width(option);
  spare /= static_cast<float>(options.size());
  const float alpha = ImGui::GetStyle().Alpha;
  float x = at.x;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, end, faded(look.raised, alpha), look.px(4));
  int clicked = -1;
  for (int i = 0; i < static_cast<int>(options.size()); ++i) {
    const Option& option = options[static_cast<std::size_t>(i)];
    const IdScope scope(option.id);
    const ImVec2 corner(x, at.y), last(corner.x + std::max(1.0F, label_width(option) + spare), end.y);
    x = last.x;
    ImGui::SetCursorScreenPos(corner);
    if (ImGui::InvisibleButton("##segment", ImVec2(last.x - corner.x, end.y - at.y))) clicked = i;
    const bool hovered = ImGui::IsItemHovered();
    finish_item(context, std::string(id) + "." + std::string(option.id), {std::string(option.tip)});
    if (i == chosen || hovered)
      list->AddRectFilled(corner, last, faded(i == chosen ? look.accent : look.hovered, alpha), look.px(4));
    draw_text(corner, last, i == chosen ? look.accent_ink : hovered ? look.ink : look.ink_quiet, option.label, 0.5F);
  }
  end_row(context, {at, end, at.x});
  return clicked == chosen ? -1 : clicked;
}

int draw_choice(const DrawContext& context, std::string_view id, std::string_view label, const Tip& tip,
                std::span<const Option> options, int chosen) {
  const IdScope scope(id);
  const ThemeLook& look = context.look;
  const RowBox box = begin_row(context, label);
  const std::string now(chosen >= 0 ? options[static_cast<std::size_t>(chosen)].label : std::string_view());
  if (ImGui::InvisibleButton("##choice", ImVec2(box.width(), box.height()))) ImGui::OpenPopup("##options");
  const bool hovered = ImGui::IsItemHovered();
  finish_item(context, id, tip);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(box.corner, box.end, faded(hovered ? look.hovered : look.raised, ImGui::GetStyle().Alpha),
                      look.px(4));
  const float side = look.px(3.5F), x = box.end.x - look.px(13), y = (box.corner.y + box.end.y) / 2 + look.px(0.5F);
  list->AddTriangleFilled(ImVec2(x - side, y - side / 2), ImVec2(x + side, y - side / 2), ImVec2(x, y + side / 2),
                          look.ink_quiet);
  draw_text(ImVec2(box.corner.x + look.px(8), box.corner.y), ImVec2(x - look.px(8), box.end.y), look.ink, now);

  int clicked = -1;
  ImGui::SetNextWindowPos(ImVec2(box.corner.x, box.end.y + look.px(2)));
  ImGui::SetNextWindowSizeConstraints(ImVec2(box.width(), 0), ImVec2(1e4F, 1e4F));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(look.px(8), look.px(6)));
  const bool popped_up = ImGui::BeginPopup("##options");
  ImGui::PopStyleVar();
  if (popped_up) {
    close_popup_on_escape();
    for (int i = 0; i < static_cast<int>(options.size()); ++i) {
      const Option& option = options[static_cast<std::size_t>(i)];
      if (ImGui::Selectable(std::string(option.label).c_str(), i == chosen)) clicked = i;
      finish_item(context, std::string(id) + "." + std::string(option.id), {std::string(option.tip)});
    }
    ImGui::EndPopup();
  }
  end_row(context, box);
  return clicked == chosen ? -1 : clicked;
}

} // namespace oversketch
