#include "ui/canvas/canvas_panel.h"

#include "tests/unit/ui/hand.h"

namespace oversketch {
namespace {

using namespace testing;

/// Draws nothing, and remembers what it was asked for.
class NoPictures : public Pictures {
public:
  ImTextureID small(const std::shared_ptr<const Raster<Rgba8>>&) override { return {}; }
  void draw(ImDrawList&, const ShownPicture&, const View&, ImVec2, ImVec2) override { ++drawn; }
  void draw_result(ImDrawList&, const LiveSession&, const View&, ImVec2, ImVec2) override { ++results; }
  void update_result(LiveSession&) override {}
  int drawn = 0;
  int results = 0;
};

/// A window of 800 × 600 without graphics hardware.
class CanvasPanel : public ::testing::Test {
protected:
  CanvasPanel() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 600};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  ~CanvasPanel() override { ImGui::DestroyContext(context_); }

  LiveSession& open(const std::vector<Command>& commands) {
    Tab tab;
    tab.session = std::make_unique<LiveSession>();
    for (const Command& command : commands)
      tab.session->execute(command);
    tab.session->wait_until_idle();
    state.tabs.push_back(std::move(tab));
    return *state.tabs.back().session;
  }

  /// One frame; what it asks for, its SetView carried out.
  std::vector<Action> frame(const InputEvents& events = {}, ImVec2 corner = {0, 0}, ImVec2 end = {800, 600}) {
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = 0.016f;
    for (const InputEvent& event : events)
      io.MousePos = {static_cast<float>(event.position.x), static_cast<float>(event.position.y)};
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
    ActionSink sink;
    reply = {};
    widgets.clear();
    draw_canvases(state, canvases, pictures, events, corner, end, {look, widgets, sink, reply, 0});
    ImGui::End();
    ImGui::Render();
    for (const Action& action : sink.pending())
      if (const auto* set = std::get_if<action::SetView>(&action); set != nullptr && state.tab() != nullptr)
        state.tab()->view.canvas(set->side) = {set->view, false};
    return sink.take();
  }

  EditorState state;
  CanvasesState canvases;
  NoPictures pictures;
  ThemeLook look = make_look(Theme::kDark, 1);
  WidgetMap widgets;
  FrameReply reply;

private:
  ImGuiContext* context_;
};

const std::vector<Command> kOneLayer{new_document(300, 200),
                                     LayerAdd{loaded_ref("source.png", plain_image(200, 160)), std::nullopt},
                                     RegionSet{{}, blob({80, 80}, 40, 0, 64)}};

TEST_F(CanvasPanel, takes_no_harm_from_having_nothing_to_show) {
  EXPECT_TRUE(frame().empty()) << "no tab";
  state.tabs.emplace_back();
  frame();
  state.tabs.clear();
  open({});
  frame({{.kind = InputEvent::Kind::kPress, .position = {100, 100}}});
  EXPECT_EQ(pictures.results, 0) << "no document";
  state.tabs.clear();
  open({new_document(30, 20)});
  frame({{.kind = InputEvent::Kind::kPress, .position = {100, 100}}});
  EXPECT_EQ(pictures.results, 1) << "no layer";
  EXPECT_FALSE(reply.canvases.source);
}

TEST_F(CanvasPanel, takes_no_harm_from_canvases_of_a_pixel) {
  open(kOneLayer);
  for (const ImVec2 end : {ImVec2{10, 10}, ImVec2{11, 11}, ImVec2{5, 5}, ImVec2{18, 12}, ImVec2{800, 11}}) {
    frame({}, {10, 10}, end);
    for (const Overlays& each : {Overlays{}, Overlays{.shown = false}})
      state.overlays = each, frame({{.kind = InputEvent::Kind::kMove, .position = {10, 10}}}, {10, 10}, end);
  }
}

TEST_F(CanvasPanel, fits_the_pictures_when_it_first_sees_them) {
  open(kOneLayer);
  const auto set = all_of<action::SetView>(frame());
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].side, Side::kSource);
  ASSERT_TRUE(reply.canvases.source && reply.canvases.target);
  const auto box = *reply.canvases.target;
  EXPECT_EQ(set[1].view, fitted({300, 200}, {box.w, box.h}));
  EXPECT_TRUE(all_of<action::SetView>(frame()).empty()) << "once";
  EXPECT_EQ(widgets.boxes().at("canvas.target"), box);
  EXPECT_TRUE(widgets.boxes().contains("canvas.source"));
  EXPECT_TRUE(widgets.boxes().contains("canvas.splitter"));
}

TEST_F(CanvasPanel, shows_one_canvas_where_the_target_is_its_own_source) {
  open({new_document(300, 200), LayerAdd{{std::string(kTargetName), std::nullopt}, std::nullopt},
        RegionSet{{}, blob({80, 80}, 40, 0, 64)}});
  frame();
  EXPECT_FALSE(reply.canvases.source);
  EXPECT_TRUE(reply.canvases.target);
}

TEST_F(CanvasPanel, draws_every_overlay) {
  open(kOneLayer);
  frame();
  const auto count = [&] {
    frame();
    return ImGui::GetDrawData()->TotalVtxCount;
  };
  state.overlays = {};
  const int usual = count();
  bool Overlays::*const toggles[] = {&Overlays::curves,       &Overlays::correspondence, &Overlays::handles,
                                     &Overlays::control_mesh, &Overlays::display_mesh,   &Overlays::heat_sigma,
                                     &Overlays::heat_area};
  for (bool Overlays::*const& toggle : toggles) {
    state.overlays = {};
    state.overlays.*toggle = !(state.overlays.*toggle);
    EXPECT_NE(count(), usual) << "overlay " << (&toggle - toggles);
  }
  state.overlays = {};
  state.overlays.shown = false;
  EXPECT_LT(count(), usual);
}

TEST_F(CanvasPanel, a_stroke_on_the_target_becomes_a_command) {
  open(kOneLayer);
  state.tool = Tool::kSketch;
  frame();
  frame();
  const View view = state.tab()->view.target.view;
  const auto box = *reply.canvases.target;
  const auto on_screen = [&](Point p) { return Point{box.x, box.y} + view.to_canvas(p); };
  const Points way = arc({80, 80}, 46, -60, 60);
  InputEvents events{{.kind = InputEvent::Kind::kMove, .position = on_screen(way.front())}};
  frame(events);
  events = {{.kind = InputEvent::Kind::kPress, .position = on_screen(way.front())}};
  for (const Point p : way)
    events.push_back({.kind = InputEvent::Kind::kMove, .position = on_screen(p)});
  events.push_back({.kind = InputEvent::Kind::kRelease, .position = on_screen(way.back())});
  executed<SketchEdit>(frame(events));
  EXPECT_EQ(reply.cursor, CursorShape::kCross);
}

TEST_F(CanvasPanel, shows_what_is_compared) {
  LiveSession& session = open(kOneLayer);
  session.show_compare(LiveSession::Compare::kPaste);
  session.wait_until_idle();
  frame();
  const int before = pictures.drawn;
  frame();
  const int plain = pictures.drawn - before;
  state.tab()->view.compare = LiveSession::Compare::kPaste;
  frame();
  EXPECT_EQ(pictures.drawn - before - plain, plain + 1);
  EXPECT_TRUE(widgets.boxes().contains("canvas.compare"));
}

} // namespace
} // namespace oversketch
