#include "tests/unit/ui/editor_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using testing::EditorTest;
using testing::kAssets;
using testing::wavy_image;

TEST_F(EditorTest, what_cannot_be_opened_is_said_and_leaves_no_tab) {
  does(action::Open{folder_ / "missing.png"});
  EXPECT_EQ(code_of_problem(), "image.missing");
  EXPECT_NE(state().said.find("missing.png"), std::string::npos) << state().said;
  folder_.write("text.png", "no picture");
  does(action::Open{folder_ / "text.png"});
  EXPECT_EQ(code_of_problem(), "image.unknown-format");
  folder_.write("bad.jsonl", "{\"oversketch_script\": 1}\n{\"do\": \"layer.add\"}\n");
  does(action::Open{folder_ / "bad.jsonl"});
  EXPECT_NE(state().said.find("bad.jsonl:2"), std::string::npos) << state().said;
  EXPECT_TRUE(state().tabs.empty());
  EXPECT_FALSE(kept_);
  EXPECT_EQ(state().notice.substr(0, 27), "bad.jsonl is not opened: ba") << "until the next is opened";
  editor_.perform_all(
      {action::Open{folder_ / "text.png"}, action::Open{folder_ / "missing.png"}, action::Open{picture("good.png")}});
  settle();
  EXPECT_EQ(state().tabs.size(), 1U);
  EXPECT_EQ(std::ranges::count(state().notice, '\n'), 1) << state().notice;
  does(action::AddSource{folder_ / "text.png"});
  EXPECT_EQ(state().notice.find("text.png is not opened: "), 0U) << state().notice;
  EXPECT_EQ(state().tabs.size(), 1U);
  does(action::DismissNotice{});
  EXPECT_TRUE(state().notice.empty());
}

TEST_F(EditorTest, a_tab_whose_file_failed_to_open_takes_no_other_before_that_is_told) {
  folder_.write("text.png", "no picture");
  editor_.perform_all({action::Open{folder_ / "text.png"}});
  state().tab()->session->wait_until_idle();
  editor_.perform_all({action::Open{folder_ / "missing.png"}});
  settle();
  EXPECT_NE(state().notice.find("text.png is not opened"), std::string::npos) << state().notice;
  EXPECT_NE(state().notice.find("missing.png is not opened"), std::string::npos) << state().notice;
  EXPECT_TRUE(state().tabs.empty());
}

TEST_F(EditorTest, actions_without_a_document_do_nothing) {
  for (const Action& action : std::vector<Action>{
           action::Undo{}, action::Redo{}, action::Commit{}, action::Abandon{}, action::Jump{3}, action::CancelWork{},
           action::Save{}, action::ExportAgain{}, action::CloseTab{2}, action::SelectTab{7}, action::Fit{},
           action::ZoomBy{}, action::SelectPin{PinId{1}}, action::HoldBefore{true}, action::Execute{LayerRemove{}}})
    does(action);
  EXPECT_TRUE(state().tabs.empty());
  EXPECT_FALSE(state().question);
}

TEST_F(EditorTest, new_documents_have_names_of_their_own) {
  for (int i = 0; i < 3; ++i)
    does(action::NewDocument{testing::new_document(30, 20)});
  does(action::CloseTab{1, true, false});
  does(action::NewDocument{testing::new_document(30, 20)});
  std::vector<std::string> names;
  for (const Tab& tab : state().tabs)
    names.push_back(tab.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Untitled", "Untitled 3", "Untitled 2"}));
}

TEST_F(EditorTest, a_picture_becomes_a_document_of_its_own) {
  const fs::path file = picture("sea.png");
  does(action::Open{file});
  ASSERT_EQ(state().tabs.size(), 1u);
  EXPECT_EQ(state().tab()->name, "sea");
  EXPECT_TRUE(state().tab()->path.empty()) << "saving must not write over the picture";
  EXPECT_EQ(snapshot()->document.target.image, wavy_image(60, 40, 0.3).empty() ? Image() : *load_image(file));
  EXPECT_FALSE(snapshot()->modified);
  ASSERT_TRUE(kept_);
  EXPECT_EQ(kept_->recent_files, std::vector<fs::path>{file});
  does(action::Open{picture("other.png")});
  EXPECT_EQ(state().tabs.size(), 2u);
  EXPECT_EQ(state().front, 1u);
  EXPECT_EQ(kept_->recent_files.front(), folder_ / "other.png");
}

TEST_F(EditorTest, pictures_take_no_more_memory_than_the_person_allows) {
  const auto allow = [&](double mib) {
    Preferences preferences = state().preferences;
    preferences.pictures_mib = mib;
    does(action::SetPreferences{preferences});
  };
  // 16 bytes a pixel: 9 MB and 12 MB.
  const fs::path sea = picture("sea.png", 800, 750), fish = picture("fish.png", 1000, 786);
  allow(16);
  does(action::Open{sea});
  does(action::AddSource{fish});
  EXPECT_EQ(code_of_problem(), "image.too-large");
  EXPECT_TRUE(snapshot()->document.layers.empty());
  does(action::SetTarget{fish});
  EXPECT_EQ(code_of_problem(), "none") << "the old target does not stay";
  does(action::SetTarget{sea});
  does(action::AddSource{std::string(kTargetName)});
  EXPECT_EQ(snapshot()->document.layers.size(), 1u) << "the same picture twice takes memory once";
  DocumentNew large;
  large.width = large.height = 1100;
  does(action::NewDocument{large});
  EXPECT_EQ(code_of_problem(), "image.too-large");
  EXPECT_EQ(state().tabs.size(), 1u);
  allow(32);
  does(action::AddSource{fish});
  EXPECT_EQ(snapshot()->document.layers.size(), 2u);
  does(action::NewDocument{large});
  EXPECT_EQ(state().tabs.size(), 2u);
  EXPECT_EQ(code_of_problem(), "none");
}

TEST_F(EditorTest, the_sample_opens_and_writes_nothing) {
  does(action::OpenSample{});
  ASSERT_EQ(state().tabs.size(), 1u);
  EXPECT_EQ(snapshot()->history.size(), 9u);
  EXPECT_FALSE(snapshot()->modified);
  EXPECT_FALSE(fs::exists(kAssets / "samples/puffer.png"));
  EXPECT_FALSE(fs::exists(kAssets / "samples/puffer.json"));
  EXPECT_TRUE(state().preferences.recent_files.empty());
}

TEST_F(EditorTest, a_source_becomes_a_layer_to_be_outlined) {
  does(action::PickTool{Tool::kMove});
  begin_work();
  ASSERT_EQ(snapshot()->document.layers.size(), 1u);
  EXPECT_EQ(snapshot()->document.layers[0].name, "fish");
  EXPECT_EQ(state().tool, Tool::kOutline);
  does(action::AddSource{std::string(kTargetName)});
  ASSERT_EQ(snapshot()->document.layers.size(), 2u);
  EXPECT_EQ(snapshot()->document.layers[1].source.image, snapshot()->document.target.image);
  does(action::AddSource{folder_ / "missing.png"});
  EXPECT_EQ(code_of_problem(), "image.missing");
  EXPECT_EQ(snapshot()->document.layers.size(), 2u);
}

TEST_F(EditorTest, a_source_without_a_document_is_opened) {
  does(action::AddSource{picture("fish.png")});
  ASSERT_EQ(state().tabs.size(), 1u);
  EXPECT_TRUE(snapshot()->document.layers.empty());
}

TEST_F(EditorTest, a_dialog_is_asked_for_where_a_path_is_missing) {
  does(action::Open{});
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().file_request->purpose, FileRequest::For::kOpen);
  does(action::Dismiss{});
  EXPECT_FALSE(state().file_request);
  begin_work();
  does(action::Export{});
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().file_request->proposal, folder_ / "sea.png");
  does(action::Save{});
  ASSERT_TRUE(state().file_request);
  EXPECT_EQ(state().file_request->purpose, FileRequest::For::kSaveAs);
  EXPECT_EQ(state().file_request->proposal, folder_ / (std::string("sea") + kProjectEnding));
}

TEST_F(EditorTest, pictures_are_fitted_until_somebody_looks_elsewhere) {
  canvases_.target = WidgetMap::Box{100, 50, 30, 30};
  does(action::Open{picture("sea.png", 60, 40)});
  const View fit = fitted({60, 40}, {30, 30});
  EXPECT_EQ(state().tab()->view.target.view, fit);
  canvases_.target->w = canvases_.target->h = 44;
  frame();
  EXPECT_EQ(state().tab()->view.target.view, fitted({60, 40}, {44, 44}));
  does(action::ZoomTo{Side::kTarget, 3});
  const View near = state().tab()->view.target.view;
  EXPECT_DOUBLE_EQ(near.zoom, 3);
  canvases_.target->w = 60;
  frame();
  EXPECT_EQ(state().tab()->view.target.view, near);
  does(action::Fit{Side::kTarget});
  EXPECT_EQ(state().tab()->view.target.view, fitted({60, 40}, {60, 44}));
}

TEST_F(EditorTest, what_was_refused_is_said_once) {
  begin_work();
  does(action::Execute{LayerOrder{{}, 99}});
  EXPECT_NE(code_of_problem(), "none");
  const std::string said = state().said;
  EXPECT_FALSE(said.empty());
  does(action::Say{"else"});
  frame();
  EXPECT_EQ(state().said, "else");
  EXPECT_EQ(code_of_problem(), "none");
  EXPECT_GT(state().said_until, now_s_);
}

TEST_F(EditorTest, preferences_are_put_in_range_and_kept) {
  Preferences wild;
  wild.ui_scale = 99;
  wild.theme = Theme::kLight;
  does(action::SetPreferences{wild});
  EXPECT_EQ(state().preferences.ui_scale, 3);
  ASSERT_TRUE(kept_);
  EXPECT_EQ(kept_->theme, Theme::kLight);
}

TEST_F(EditorTest, a_new_document_is_asked_for_first) {
  does(action::NewDocument{});
  EXPECT_TRUE(state().asks_new_document);
  editor_.perform_all({action::NewDocument{testing::new_document(30, 20)}, action::Dismiss{}});
  settle();
  EXPECT_FALSE(state().asks_new_document);
  ASSERT_EQ(state().tabs.size(), 1u);
  EXPECT_EQ(snapshot()->document.target.image.width(), 30);
}

TEST_F(EditorTest, a_pin_that_is_gone_is_not_selected) {
  does(action::OpenSample{});
  const PinId pin = snapshot()->document.layers[0].pins[0].id;
  does(action::SelectPin{pin});
  EXPECT_EQ(state().tab()->view.selected_pin, pin);
  does(action::Execute{PinRemove{{}, pin}});
  EXPECT_FALSE(state().tab()->view.selected_pin);
}

TEST_F(EditorTest, a_pin_is_selected_as_it_is_made) {
  does(action::OpenSample{});
  for (const Pin& pin : std::vector<Pin>(snapshot()->document.layers[0].pins))
    does(action::Execute{PinRemove{{}, pin.id}});
  const auto before = snapshot();
  const Layer& layer = before->document.layers[0];
  const PinId made{before->document.next_pin};
  editor_.perform_all({action::Execute{PinAdd{{}, layer.outline[0], layer.placement.to_target()(layer.sketch[0])}},
                       action::SelectPin{made}});
  // The session may not have come to it yet.
  frame();
  settle();
  ASSERT_EQ(snapshot()->document.layers[0].pins.size(), 1U);
  EXPECT_EQ(state().tab()->view.selected_pin, made);
  does(action::Undo{});
  EXPECT_FALSE(state().tab()->view.selected_pin);
}

TEST_F(EditorTest, a_recorded_session_replays_to_the_same_document) {
  EXPECT_FALSE(editor_.record_front(folder_ / "nothing.jsonl").ok());
  begin_work();
  ASSERT_TRUE(editor_.record_front(folder_ / "recorded.jsonl").ok());
  EXPECT_TRUE(snapshot()->modified);
  const Document recorded = snapshot()->document;
  does(action::Open{folder_ / "recorded.jsonl"});
  ASSERT_EQ(state().tabs.size(), 2u);
  EXPECT_EQ(snapshot()->document, recorded);
}

} // namespace
} // namespace oversketch
