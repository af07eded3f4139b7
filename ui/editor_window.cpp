#include "ui/editor_window.h"

#include "ui/panels/dialog_host.h"
#include "ui/panels/empty_state.h"
#include "ui/panels/menu_bar.h"
#include "ui/panels/recovery_bar.h"
#include "ui/panels/side_panel.h"
#include "ui/panels/status_bar.h"
#include "ui/panels/tab_bar.h"
#include "ui/panels/tool_strip.h"
#include "ui/panels/window_layout.h"
#include "ui/panels/window_parts.h"
#include "ui/widgets/item.h"

#include <algorithm>
#include <utility>

namespace oversketch {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// What every part of the window draws from, for one frame.
struct Frame {
  const EditorState& state;
  std::shared_ptr<const Snapshot> snapshot;
  WindowState::Parts& parts;
  Pictures& pictures;
  /// Those that are for the canvases.
  const InputEvents& canvas_events;
  const DrawContext& context;
  RecoveryBarModel recovery;
  WindowLayout layout;
  EntryContext entries;
};

/// A document that holds nothing yet, and is not being opened, offers the same as no document.
bool shows_empty_state(const EditorState& state, const Snapshot* snapshot) {
  const Tab* tab = state.tab();
  return tab == nullptr || (snapshot->document.empty() && !tab->session->activity().busy);
}

/// A part of the window as a child with its own clipping.
template <class Draw>
void draw_area(const char* name, const Area& area, ImGuiWindowFlags flags, const Draw& draw) {
  if (area.width() < 1 || area.height() < 1) return;
  ImGui::SetCursorScreenPos(area.low);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::BeginChild(name, ImVec2(area.width(), area.height()), false, flags | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  draw();
  ImGui::EndChild();
}

WindowLayout lay_out(const EditorState& state, const WindowState::Parts& parts, const RecoveryBarModel& recovery,
                     const DrawContext& context) {
  const float offer = recovery.documents > 0 ? 36.0F : 0.0F;
  return lay_out_window({.size = ImGui::GetIO().DisplaySize,
                         .scale = context.look.scale,
                         .side_width = parts.side_width,
                         .side = parts.flags.side_panel && !state.tabs.empty(),
                         .side_over = parts.flags.side_over && !state.tabs.empty(),
                         .tabs = !state.tabs.empty(),
                         .offer = state.notice.empty() ? offer : notice_height(state.notice)});
}

std::optional<PointerPlace> find_pointer(const EditorState& state, const DrawContext& context) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (state.tab() == nullptr) return std::nullopt;
  for (const Side side : {Side::kSource, Side::kTarget}) {
    const auto& box = context.reply.canvases.at(side);
    if (!box || mouse.x < box->x || mouse.y < box->y || mouse.x >= box->x + box->w || mouse.y >= box->y + box->h)
      continue;
    const Point inside{static_cast<double>(mouse.x - box->x), static_cast<double>(mouse.y - box->y)};
    return PointerPlace{side, state.tab()->view.canvas(side).view.to_picture(inside)};
  }
  return std::nullopt;
}

/// The side panel's left edge can be dragged.  In a child of its own, over canvases and panel, which would take the
/// pointer otherwise.
void draw_side_edge(Frame& frame) {
  if (frame.layout.narrow || frame.layout.side.empty()) return;
  const Area& side = frame.layout.side;
  const float reach = frame.context.look.px(3);
  const Area edge{ImVec2(side.low.x - reach, side.low.y), ImVec2(side.low.x + reach, side.high.y)};
  draw_area("##edge", edge, ImGuiWindowFlags_NoBackground, [&] {
    ImGui::InvisibleButton("##drag", ImVec2(edge.width(), edge.height()));
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) {
      const float width = (side.high.x - ImGui::GetIO().MousePos.x) / frame.context.look.scale;
      frame.parts.side_width = std::clamp(width, kLeastSide, kMostSide);
    }
    finish_item(frame.context, "panel.side.edge", {"Drag to make the side panel wider or narrower.", {}});
  });
}

void draw_middle(Frame& frame) {
  const ThemeLook& look = frame.context.look;
  const Area& area = frame.layout.canvases;
  const bool empty = shows_empty_state(frame.state, frame.snapshot.get());
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high, empty ? look.panel : look.canvas);
  if (empty)
    draw_area("##empty", area, 0, [&] { draw_empty_state(make_empty_state_model(frame.state), area, frame.context); });
  else
    draw_canvases(frame.state, frame.parts.canvases, frame.pictures, frame.canvas_events, area.low, area.high,
                  frame.context);
}

void draw_strip(Frame& frame) {
  const Area& area = frame.layout.strip;
  const ThemeLook& look = frame.context.look;
  ImGui::GetWindowDrawList()->AddRectFilled(area.low, area.high, look.panel);
  draw_area("##strip", area, ImGuiWindowFlags_NoScrollbar,
            [&] { draw_tool_strip(frame.entries, area, frame.layout.strip_columns, frame.context); });
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(area.high.x - look.px(1), area.low.y), area.high, look.line);
  register_box(frame.context, "panel.tools", area.low, area.high);
}

/// A dialog takes what happens.  What was in hand when it came is let go: its end would not be seen.  An open menu
/// takes the keys, that which closes it among them.
InputEvents canvas_events(const InputEvents& events, bool dialog, bool dialog_before) {
  if (!dialog && !dialog_before && is_popup_open()) {
    InputEvents others = events;
    std::erase_if(others, [](const InputEvent& event) {
      return event.kind == InputEvent::Kind::kKeyDown || event.kind == InputEvent::Kind::kKeyRepeat;
    });
    return others;
  }
  if (!dialog) return dialog_before ? InputEvents() : events;
  if (dialog_before) return {};
  InputEvent lost;
  lost.kind = InputEvent::Kind::kFocusLost;
  return {lost};
}

/// What there is to do next, or what the tool in hand does.
std::string_view status_hint(const Frame& frame) {
  if (frame.snapshot != nullptr && frame.snapshot->document.layers.empty())
    return "Add the picture that the part comes from: Layer, Add source image, or drop it on this one";
  return tool_summary(frame.state.tool);
}

void draw_status(Frame& frame) {
  const Tab* tab = frame.state.tab();
  const auto pointer = find_pointer(frame.state, frame.context);
  frame.parts.flags.under_pointer = pointer ? std::optional(pointer->side) : std::nullopt;
  const double now = frame.context.now_s;
  const StatusModel model = make_status_model(frame.state, frame.snapshot.get(),
                                              tab != nullptr ? tab->session->activity() : LiveSession::Activity(),
                                              pointer, status_hint(frame), now);
  frame.context.reply.status = model.line;
  if (model.said) frame.context.reply.ask_frame_at(frame.state.said_until);
  draw_area("##status", frame.layout.status, 0, [&] { draw_status_bar(model, frame.layout.status, frame.context); });
}

void draw_parts(Frame& frame) {
  draw_menu_bar(frame.entries, frame.layout.menu, frame.context);
  if (!frame.layout.tabs.empty())
    draw_area("##tabs", frame.layout.tabs, 0, [&] {
      draw_tab_bar(make_tab_bar_model(frame.state), frame.parts.tabs, frame.layout.tabs, frame.context);
    });
  draw_strip(frame);
  if (!frame.layout.offer.empty())
    draw_area("##offer", frame.layout.offer, 0, [&] {
      if (!frame.state.notice.empty()) return draw_notice_bar(frame.state.notice, frame.layout.offer, frame.context);
      draw_recovery_bar(frame.recovery, frame.layout.offer, frame.context);
    });
  draw_middle(frame);
  draw_status(frame);
  if (!frame.layout.side.empty())
    draw_side_panel({frame.state, frame.snapshot.get(), frame.parts, frame.pictures, frame.entries}, frame.layout.side,
                    frame.context);
  draw_side_edge(frame);
}

} // namespace

void draw_editor_window(const EditorState& state, WindowState& window, Pictures& pictures, const InputEvents& events,
                        const DrawContext& context) {
  WindowState::Parts& parts = window.parts();
  const bool dialog = has_dialog(state, parts);
  const auto snapshot = state.tab() == nullptr ? nullptr : state.tab()->session->snapshot();
  const InputEvents for_canvases = canvas_events(events, dialog, parts.dialog_open);
  const RecoveryBarModel recovery = make_recovery_bar_model(state, !shows_empty_state(state, snapshot.get()));
  Frame frame{state,
              snapshot,
              parts,
              pictures,
              for_canvases,
              context,
              recovery,
              lay_out(state, parts, recovery, context),
              {state, snapshot.get(), parts.flags, context.sink}};
  parts.flags.narrow = frame.layout.narrow;
  // Nor is anything undone or saved under a hand that is drawing, or behind an open menu.
  const bool drawing = parts.canvases.input.held();
  read_keys(events, drawing || dialog || parts.dialog_open || is_popup_open() || ImGui::GetIO().WantTextInput,
            frame.entries);

  if (const int tab = state.tab() == nullptr ? 0 : state.tab()->id; std::exchange(parts.tab, tab) != tab) {
    parts.flags.renaming.reset();
    parts.layers.dragged.reset();
  }

  const ThemeLook& look = context.look;
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  const float pad = std::max(0.0F, (frame.layout.menu.height() - ImGui::GetFontSize()) / 2);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(look.px(7), pad));
  ImGui::Begin("##editor", nullptr, kFixed | ImGuiWindowFlags_MenuBar);
  ImGui::PopStyleVar(3);
  draw_parts(frame);
  ImGui::End();
  draw_dialogs(state, parts, pictures, events, context);
  parts.dialog_open = dialog;
  // Between two menus too: an arrow that is held down would else count as pressed anew in the second.
  compat::let_keys_move(is_popup_open() || parts.flags.menu_wanted);
  if (compat::is_menu_coming()) context.reply.ask_frame_at(context.now_s);
}

} // namespace oversketch
