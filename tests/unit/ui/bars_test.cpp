#include "tests/support/documents.h"
#include "tests/unit/ui/headless.h"
#include "ui/panels/empty_state.h"
#include "ui/panels/menu_bar.h"
#include "ui/panels/recovery_bar.h"
#include "ui/panels/status_bar.h"
#include "ui/panels/tab_bar.h"
#include "ui/panels/thumbnail.h"
#include "ui/panels/tool_strip.h"

namespace oversketch {
namespace {

using testing::Headless;

class Bars : public Headless {
protected:
  Bars() : Headless(ImVec2(1200, 700)) {
    Tab tab;
    tab.name = "sea";
    state.tabs.push_back(std::move(tab));
    snapshot.target.pixels = std::make_shared<const Raster<Rgba8>>(60, 40);
    snapshot.document.target.image = Image(Raster<Rgba>(60, 40));
    snapshot.history = {"Open", "Move 40, 12"};
    snapshot.cursor = 1;
  }
  EditorState state;
  Snapshot snapshot;
  WindowFlags flags;
  EntryContext entries{state, &snapshot, flags, sink_};
  LiveSession::Activity activity;
};

TEST_F(Bars, StatusTellsWhereThePointerIs) {
  state.tabs[0].view.target.view.zoom = 0.664;
  const auto model =
      make_status_model(state, &snapshot, activity, PointerPlace{Side::kTarget, {12.7, 8.2}}, "Draw.", 5);
  EXPECT_EQ(model.position, "12, 8");
  EXPECT_EQ(model.zoom, "66.4 %");
  EXPECT_EQ(model.size, "60 × 40");
  EXPECT_EQ(model.line, "Draw.");
  EXPECT_FALSE(model.said);
  EXPECT_EQ(make_status_model(state, &snapshot, activity, PointerPlace{Side::kTarget, {60, 8}}, "", 5).position, "")
      << "beside the picture";
  EXPECT_EQ(make_status_model(state, &snapshot, activity, PointerPlace{Side::kTarget, {-0.1, 8}}, "", 5).position, "");
}

TEST_F(Bars, StatusSaysTheLastMessageForItsTime) {
  state.said = "Saved sea.jsonl";
  state.said_until = 8;
  EXPECT_EQ(make_status_model(state, &snapshot, activity, {}, "Draw.", 7.9).line, "Saved sea.jsonl");
  EXPECT_EQ(make_status_model(state, &snapshot, activity, {}, "Draw.", 8).line, "Draw.");
  EXPECT_NE(make_status_model(state, nullptr, activity, {}, "Draw.", 8).line, "") << "an empty window says what to do";
}

TEST_F(Bars, SolveIsDescribedByStage) {
  LayerSnapshot layer;
  EXPECT_EQ(describe_solve(layer), "");
  auto deformation = std::make_shared<Deformation>();
  deformation->vertices = 980;
  deformation->times.add("match", 8.2);
  deformation->times.add("mesh", 6);
  deformation->times.add("iterations", 12.4);
  layer.deformation = deformation;
  layer.blend_ms = 23;
  EXPECT_EQ(describe_solve(layer), "980 vertices · match 8.2 · solve 18 · blend 23 ms");
}

TEST_F(Bars, WorkCanBeCancelled) {
  activity = {true, 0.4, "Exporting"};
  const Area area{ImVec2(0, 676), ImVec2(1200, 700)};
  show([&](const DrawContext& context) {
    draw_status_bar(make_status_model(state, &snapshot, activity, {}, "Draw.", 0), area, context);
  });
  EXPECT_TRUE(has("status.progress"));
  EXPECT_LT(reply_.next_frame_s, now_s_ + 1) << "progress goes on without events";
  click("status.cancel");
  take_one<action::CancelWork>();
  activity.busy = false;
  frame();
  EXPECT_FALSE(has("status.cancel"));
  click("status.zoom");
  take_one<action::Fit>();
  expect_tips();
}

TEST(TabRuns, HoldTheOneInFront) {
  TabBarState state;
  for (std::size_t tabs = 1; tabs < 9; ++tabs)
    for (std::size_t front = 0; front < tabs; ++front)
      for (std::size_t room = 0; room < 10; ++room) {
        const TabRun run = scroll_tabs(state, tabs, front, room, 0);
        EXPECT_LE(run.first, front);
        EXPECT_LT(front, run.first + run.count);
        EXPECT_LE(run.first + run.count, tabs);
        EXPECT_EQ(run.count, std::min(tabs, std::max<std::size_t>(room, 1)));
      }
  EXPECT_EQ(scroll_tabs(state, 0, 0, 4, 0).count, 0U);
}

TEST(TabRuns, StayWhereTheWheelTookThem) {
  TabBarState state;
  EXPECT_EQ(scroll_tabs(state, 11, 10, 5, 0).first, 6U);
  EXPECT_EQ(scroll_tabs(state, 11, 10, 5, 0.5F).first, 6U);
  EXPECT_EQ(scroll_tabs(state, 11, 10, 5, 0.5F).first, 5U) << "parts of a notch add up";
  EXPECT_EQ(scroll_tabs(state, 11, 10, 5, 30).first, 0U);
  EXPECT_EQ(scroll_tabs(state, 11, 10, 5, 0).first, 0U);
  EXPECT_EQ(scroll_tabs(state, 11, 2, 5, 0).first, 0U) << "it is in sight already";
  EXPECT_EQ(scroll_tabs(state, 11, 2, 5, -30).first, 6U);
  EXPECT_EQ(scroll_tabs(state, 10, 2, 5, 0).first, 2U);
}

TEST_F(Bars, TabsThatHaveNoRoomAreScrolledToAndListed) {
  TabBarModel model{{}, 10};
  for (int i = 0; i < 11; ++i)
    model.tabs.push_back({"picture " + std::to_string(i), "picture", false});
  TabBarState tabs;
  const Area area{ImVec2(0, 0), ImVec2(430, 30)};
  show([&](const DrawContext& context) { draw_tab_bar(model, tabs, area, context); });
  EXPECT_TRUE(has("tab.10"));
  EXPECT_FALSE(has("tab.0"));
  move_to(at("tab.10"));
  ImGui::GetIO().MouseWheel = 20;
  frame();
  ASSERT_TRUE(has("tab.0"));
  EXPECT_FALSE(has("tab.10"));
  click("tab.0", 0.2F);
  EXPECT_EQ(take_one<action::SelectTab>().tab, 0U);
  click("tab.list");
  frame();
  ASSERT_TRUE(has("tab.list.10"));
  expect_tips();
  click("tab.list.7");
  EXPECT_EQ(take_one<action::SelectTab>().tab, 7U);
}

TEST_F(Bars, ATabsTipHoldsItsNameAndSaysWhatIsNotSaved) {
  state.tabs[0].name = "a long name";
  state.tabs[0].session = std::make_unique<LiveSession>();
  EXPECT_EQ(make_tab_bar_model(state).tabs[0].tip, "a long name");
  LiveSession& session = *state.tabs[0].session;
  session.execute(testing::new_document(20, 15));
  session.execute(LayerAdd{testing::loaded_ref("fish.png", testing::wavy_image(9, 8, 1)), "fish"});
  session.wait_until_idle();
  EXPECT_EQ(make_tab_bar_model(state).tabs[0].tip, "a long name\nNot saved yet");
  state.tabs[0].path = "/a/sea.ora";
  EXPECT_EQ(make_tab_bar_model(state).tabs[0].tip, "/a/sea.ora");
}

TEST_F(Bars, TabsComeToTheFrontAndClose) {
  TabBarModel model{{{"sea", "sea.jpg", false}, {"giraffe", "Not saved yet", true}, {"three", "x", false}}, 0};
  TabBarState tabs;
  const Area area{ImVec2(0, 0), ImVec2(900, 30)};
  show([&](const DrawContext& context) { draw_tab_bar(model, tabs, area, context); });
  expect_tips();
  click("tab.1", 0.2F);
  EXPECT_EQ(take_one<action::SelectTab>().tab, 1U);
  click("tab.0", 0.2F);
  EXPECT_TRUE(take().empty());
  click("tab.0.close");
  EXPECT_EQ(take_one<action::CloseTab>().tab, 0U);
  click_at(at("tab.2", 0.3F), ImGuiMouseButton_Middle);
  EXPECT_EQ(take_one<action::CloseTab>().tab, 2U);
  click("tab.open");
  EXPECT_TRUE(take_one<action::Open>().path.empty());
}

TEST_F(Bars, MenusCarryOutTheirEntries) {
  const Area area{ImVec2(0, 0), ImVec2(1200, 31)};
  show(
      [&](const DrawContext& context) {
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::Begin("##bar", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_MenuBar);
        draw_menu_bar(entries, area, context);
        ImGui::End();
      },
      true);
  for (const char* menu : {"menu.file", "menu.edit", "menu.layer", "menu.view", "menu.help"}) {
    ASSERT_TRUE(has(menu)) << names();
    click(menu);
    frame();
    expect_tips();
    press(ImGuiKey_Escape);
    EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) << menu;
    move_to(ImVec2(900, 600));
  }
  click("menu.edit");
  frame();
  click("menu.edit.undo");
  take_one<action::Undo>();
  frame();
  click("menu.file");
  frame();
  click("menu.file.export");
  EXPECT_TRUE(take_one<action::Export>().path.empty());
  EXPECT_EQ(document_title(state, &snapshot), "sea");
  snapshot.modified = true;
  EXPECT_EQ(document_title(state, &snapshot), "sea *");
  state.tabs[0].path = "/a/sea.ora";
  EXPECT_EQ(document_title(state, &snapshot), "sea.ora *");
}

TEST_F(Bars, StripPicksToolsAndOpensOverlaysAndComparison) {
  const Area area{ImVec2(0, 31), ImVec2(52, 660)};
  show([&](const DrawContext& context) {
    ImGui::SetCursorScreenPos(area.low);
    draw_tool_strip(entries, area, 1, context);
  });
  expect_tips();
  for (const ToolRow& row : tool_rows()) {
    click("tool." + std::string(row.id));
    EXPECT_EQ(take_one<action::PickTool>().tool, row.tool);
  }
  click("strip.overlays");
  frame();
  expect_tips();
  click("strip.overlays.handles");
  EXPECT_TRUE(take_one<action::SetOverlays>().overlays.handles);
  frame();
  click_at(ImVec2(900, 600));
  frame();
  click("strip.compare");
  frame();
  click("strip.compare.paste");
  EXPECT_EQ(take_one<action::SetCompare>().compare, LiveSession::Compare::kPaste);
}

TEST_F(Bars, SwitchingAnOverlayOnShowsThemAgain) {
  state.overlays.shown = false;
  state.overlays.handles = true;
  const Area area{ImVec2(0, 31), ImVec2(52, 660)};
  show([&](const DrawContext& context) {
    ImGui::SetCursorScreenPos(area.low);
    draw_tool_strip(entries, area, 1, context);
  });
  click("strip.overlays");
  frame();
  click("strip.overlays.handles");
  const Overlays overlays = take_one<action::SetOverlays>().overlays;
  EXPECT_TRUE(overlays.shown);
  EXPECT_TRUE(overlays.handles);
}

TEST_F(Bars, EmptyWindowOffersAWayIn) {
  EmptyStateModel model;
  model.recent = {"/a/sea.jpg", "/b/fish.png"};
  model.recovered.push_back({"/j", {}, "giraffe", "today 14:03", 7});
  show([&](const DrawContext& context) { draw_empty_state(model, {ImVec2(0, 0), ImVec2(1200, 700)}, context); });
  expect_tips();
  click("empty.open");
  EXPECT_TRUE(take_one<action::Open>().path.empty());
  click("empty.sample");
  take_one<action::OpenSample>();
  click("empty.recent.1");
  EXPECT_EQ(take_one<action::Open>().path, "/b/fish.png");
  click("empty.recovered.0.take");
  EXPECT_EQ(take_one<action::Recover>().index, 0U);
  click("empty.recovered.0.discard");
  EXPECT_EQ(take_one<action::DiscardRecovered>().index, 0U);
}

TEST_F(Bars, UnsavedWorkIsOfferedOverOtherWork) {
  for (const char* name : {"giraffe", "puffer"})
    state.recovered.push_back({"/j", {}, name, "today 14:03", 7});
  const RecoveryBarModel model = make_recovery_bar_model(state, true);
  EXPECT_EQ(model.text, "Not saved when the program last ended: giraffe (today 14:03), puffer (today 14:03)");
  show([&](const DrawContext& context) { draw_recovery_bar(model, {ImVec2(0, 0), ImVec2(400, 36)}, context); });
  expect_tips();
  click("recovery.later");
  take_one<action::LeaveRecovered>();
  click("recovery.take");
  const auto actions = sink_.take();
  ASSERT_EQ(actions.size(), 2U);
  for (const Action& action : actions)
    EXPECT_EQ(std::get<action::Recover>(action).index, 0U) << "the next one has moved up";
}

TEST(Thumbnails, KeepShapeAndMeanAndAreNeverLarger) {
  Raster<Rgba8> checks(400, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 400; ++x)
      checks.at(x, y) = (x / 10 + y / 10) % 2 == 0 ? Rgba8{200, 0, 0, 255} : Rgba8{0, 100, 0, 255};
  const auto small = make_thumbnail(checks, 20);
  ASSERT_NE(small, nullptr);
  EXPECT_EQ(small->width(), 20);
  EXPECT_EQ(small->height(), 5);
  EXPECT_EQ(small->at(3, 2), (Rgba8{100, 50, 0, 255})) << "half of each";
  const auto same = make_thumbnail(Raster<Rgba8>(8, 4, {1, 2, 3, 255}), 96);
  EXPECT_EQ(same->width(), 8);
  EXPECT_EQ(same->at(7, 3), (Rgba8{1, 2, 3, 255}));
  EXPECT_EQ(make_thumbnail(Raster<Rgba8>(), 96), nullptr);
  const auto clear = make_thumbnail(Raster<Rgba8>(300, 1, {9, 9, 9, 0}), 10);
  EXPECT_EQ(clear->at(0, 0), (Rgba8{0, 0, 0, 0}));
}

} // namespace
} // namespace oversketch
