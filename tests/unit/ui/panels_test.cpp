#include "tests/unit/ui/headless.h"
#include "ui/panels/blend_panel.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/tool_panel.h"

#include <algorithm>

namespace oversketch {
namespace {

using testing::Headless;

/// A document of three layers, the middle one selected and outlined, on a small target.
Snapshot make_snapshot() {
  Snapshot snapshot;
  Document& document = snapshot.document;
  document.target = {"pictures/sea.jpg", Image(Raster<Rgba>(60, 40))};
  for (int i = 1; i <= 3; ++i) {
    Layer layer;
    layer.id = {i};
    layer.name = "fish " + std::to_string(i);
    document.layers.push_back(layer);
  }
  document.layers[1].outline = {{1, 1}, {9, 1}, {5, 9}};
  document.selected = LayerId{2};
  snapshot.target.pixels = std::make_shared<const Raster<Rgba8>>(60, 40);
  LayerSnapshot derived;
  derived.id = {2};
  auto deformation = std::make_shared<Deformation>();
  deformation->energies = {100, 10, 5, 4};
  deformation->vertices = 980;
  deformation->times.add("match", 8);
  deformation->times.add("iterations", 12.5);
  derived.deformation = deformation;
  derived.metrics = Metrics();
  derived.metrics->distortion.sigma_ratio_mean = 1.064;
  derived.blend_ms = 0.64;
  snapshot.layers.push_back(derived);
  snapshot.history = {"Open sea.jpg", "Outline", "Move 40, 12", "Pin"};
  snapshot.cursor = 2;
  return snapshot;
}

class Panels : public Headless {
protected:
  void show_layers() {
    show([this](const DrawContext& context) {
      draw_layers_panel(make_layers_model(snapshot), layers, entries, pictures, context);
    });
  }
  Snapshot snapshot = make_snapshot();
  EditorState state;
  WindowFlags flags;
  EntryContext entries{state, &snapshot, flags, sink_};
  LayersPanelState layers;
  DeformPanelState deform;
  HistoryPanelState history;
};

TEST(LayersModel, HasTheHighestFirstAndSaysWhatIsMissing) {
  const LayersModel model = make_layers_model(make_snapshot());
  ASSERT_EQ(model.rows.size(), 3U);
  EXPECT_EQ(model.rows[0].id, LayerId{3});
  EXPECT_EQ(model.rows[0].index, 2);
  EXPECT_FALSE(model.rows[0].note.empty());
  EXPECT_TRUE(model.rows[1].selected);
  EXPECT_TRUE(model.rows[1].note.empty());
  EXPECT_EQ(model.target_name, "sea.jpg");
  EXPECT_EQ(model.opacity, 1);
}

TEST(LayersModel, DroppedRowsLandWhereTheLineWas) {
  const LayersModel model = make_layers_model(make_snapshot());
  // Every drop, held against really moving an element of the stack.
  for (int dragged = 0; dragged < 3; ++dragged)
    for (int place = 0; place <= 3; ++place) {
      std::vector<int> after;
      for (int row = 0; row <= 3; ++row) {
        if (row == place) after.push_back(dragged);
        if (row < 3 && 2 - row != dragged) after.push_back(2 - row);
      }
      const auto stood = std::ranges::find(after, dragged) - after.begin();
      EXPECT_EQ(order_after_drop(model, dragged, place), 2 - static_cast<int>(stood)) << dragged << " to " << place;
    }
}

TEST_F(Panels, LayersAreSelectedHiddenAndRemoved) {
  show_layers();
  expect_tips();
  click("layer.L3");
  EXPECT_EQ(take_command<LayerSelect>().layer, LayerId{3});
  wait();
  click("layer.L2");
  EXPECT_TRUE(take().empty()) << "it is selected already";
  wait();
  click("layer.L2.visible");
  const auto set = take_command<LayerSet>();
  EXPECT_EQ(set.layer, LayerId{2});
  EXPECT_EQ(set.visible, false);
  click("layer.remove");
  take_command<LayerRemove>();
  click("layer.lower");
  EXPECT_EQ(take_command<LayerOrder>().to, 0);
  click("layer.add");
  EXPECT_TRUE(take_one<action::AddSource>().path.empty());
  click("layer.add_target");
  EXPECT_EQ(take_one<action::AddSource>().path, "@target");
}

TEST_F(Panels, LayersAreReorderedByDragging) {
  show_layers();
  move_to(at("layer.L3"));
  set_button(true);
  move_to(at("layer.L2"));
  move_to(at("layer.L1", 0.5F, 0.9F));
  set_button(false);
  frame();
  const auto order = take_command<LayerOrder>();
  EXPECT_EQ(order.layer, LayerId{3});
  EXPECT_EQ(order.to, 0);
}

TEST_F(Panels, LayersAreRenamedByDoubleClick) {
  show_layers();
  double_click("layer.L2");
  frame();
  frame();
  ASSERT_TRUE(has("layer.L2.name"));
  take();
  type("puffer");
  press(ImGuiKey_Enter);
  const auto rename = take_command<LayerRename>();
  EXPECT_EQ(rename.layer, LayerId{2});
  EXPECT_EQ(rename.name, "puffer");
  frame();
  EXPECT_FALSE(has("layer.L2.name"));
}

TEST_F(Panels, RenamingIsGivenUpByEscape) {
  show_layers();
  double_click("layer.L2");
  frame();
  frame();
  take();
  type("puffer");
  press(ImGuiKey_Escape);
  frame();
  EXPECT_TRUE(take().empty());
  EXPECT_FALSE(has("layer.L2.name"));
}

TEST_F(Panels, OpacityIsOneGesture) {
  show_layers();
  drag("layer.opacity", 0.9F, 0.5F);
  wait();
  const auto actions = take();
  ASSERT_GE(actions.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<action::Commit>(actions.back()));
  const auto& preview = std::get<action::Preview>(actions[actions.size() - 2]);
  EXPECT_NEAR(*std::get<LayerSet>(preview.command).opacity, 0.5, 0.02);
}

TEST(SettingSliders, KeepToTheCommandsRangesAndStarts) {
  const LayerSettings start;
  for (const auto& [field, initial] :
       std::vector<std::pair<std::string, double>>{{"follow", start.follow},
                                                   {"stiffness", start.stiffness},
                                                   {"cell_px", start.cell_px},
                                                   {"handle_weight", start.handle_weight},
                                                   {"iterations", start.iterations},
                                                   {"strength", start.strength},
                                                   {"opacity", start.opacity},
                                                   {"feather_px", start.feather_px},
                                                   {"screening", start.screening}}) {
    const SliderSpec spec = setting_slider(field);
    EXPECT_EQ(spec.initial, initial) << field;
    EXPECT_GE(spec.low, spec.least) << field;
    EXPECT_LE(spec.high, spec.most) << field;
    EXPECT_GE(initial, spec.low) << field;
    EXPECT_LE(initial, spec.high) << field;
  }
}

TEST(DeformModel, TellsTheSelectedLayersNumbers) {
  const DeformModel model = make_deform_model(make_snapshot());
  EXPECT_TRUE(model.has_region);
  EXPECT_EQ(model.energies.size(), 4U);
  EXPECT_EQ(model.summary, "0 folded · σ 1.06 · 20 ms") << "20.5 to the even neighbour";
  Snapshot none = make_snapshot();
  none.document.selected.reset();
  EXPECT_FALSE(make_deform_model(none).settings.has_value());
}

TEST_F(Panels, DeformationSetsMethodAndNumbers) {
  show([this](const DrawContext& context) {
    draw_deform_panel(make_deform_model(snapshot), deform, this, pictures, context);
  });
  expect_tips();
  for (const char* id : {"deform.energy", "deform.numbers.flipped", "deform.numbers.sigma", "deform.numbers.worst",
                         "deform.numbers.distance", "deform.numbers.time"})
    EXPECT_TRUE(has(id)) << id;
  EXPECT_TRUE(take_one<action::WantAlternatives>().wanted);
  const float below = at("deform.numbers.farthest", 0, 1).y;
  auto measured = std::exchange(snapshot.layers[0].metrics, std::nullopt);
  frame();
  EXPECT_EQ(at("deform.numbers.farthest", 0, 1).y, below) << "nothing moves while it is measured anew";
  snapshot.layers[0].metrics = std::move(measured);
  click("deform.method.paper");
  EXPECT_EQ(take_command<LayerSet>().method, DeformMethod::kPaper);
  drag("deform.follow", 0.2F, 0.8F);
  wait();
  const auto previews = take_all<action::Preview>();
  ASSERT_FALSE(previews.empty());
  EXPECT_TRUE(std::get<LayerSet>(previews.back().command).follow.has_value());
  click("deform.cell", 0.5F);
  wait();
  EXPECT_TRUE(take_command<LayerSet>().cell_px.has_value());
}

TEST_F(Panels, DeformationShowsWhatTheMethodTakes) {
  show([this](const DrawContext& context) {
    draw_deform_panel(make_deform_model(snapshot), deform, this, pictures, context);
  });
  EXPECT_TRUE(has("deform.stiffness"));
  EXPECT_FALSE(has("deform.weight"));
  snapshot.document.layers[1].settings.method = DeformMethod::kPaper;
  frame();
  EXPECT_FALSE(has("deform.stiffness"));
  EXPECT_TRUE(has("deform.weight"));
  EXPECT_TRUE(has("deform.iterations"));
  snapshot.document.layers[1].settings.method = DeformMethod::kInitial;
  frame();
  EXPECT_TRUE(has("deform.weight"));
  EXPECT_FALSE(has("deform.iterations"));
}

TEST_F(Panels, AlternativesAreAskedForWhileTheyAreSeen) {
  show([this](const DrawContext& context) {
    draw_deform_panel(make_deform_model(snapshot), deform, this, pictures, context);
  });
  EXPECT_TRUE(take_one<action::WantAlternatives>().wanted);
  frame();
  EXPECT_TRUE(take().empty()) << "asked once";
  click("panel.deformation.title");
  frame();
  EXPECT_FALSE(take_one<action::WantAlternatives>().wanted);
}

TEST_F(Panels, AlternativesAreClicked) {
  for (int i = 0; i < 3; ++i)
    snapshot.alternatives.push_back(
        {PinAdd{{}, {1.0 * i, 2}, {3, 4}}, i == 0, 1.0 + i, std::make_shared<const Raster<Rgba8>>(8, 8)});
  show([this](const DrawContext& context) {
    draw_deform_panel(make_deform_model(snapshot), deform, this, pictures, context);
  });
  take();
  click("deform.alternative.0");
  EXPECT_TRUE(take().empty()) << "it is taken already";
  click("deform.alternative.2");
  EXPECT_EQ(take_command<PinAdd>().outline, (Point{2, 2})) << "the pin that holds it";
  snapshot.alternatives.clear();
  frame();
  EXPECT_FALSE(has("deform.alternative.0"));
}

TEST_F(Panels, BlendingSetsModeStrengthFeatherAndDomain) {
  show([this](const DrawContext& context) { draw_blend_panel(make_blend_model(snapshot), context); });
  EXPECT_EQ(make_blend_model(snapshot).summary, "0.6 ms a move");
  expect_tips();
  click("blend.mode");
  frame();
  expect_tips();
  click("blend.mode.mixed");
  EXPECT_EQ(take_command<LayerSet>().mode, CloneMode::kMixed);
  frame();
  EXPECT_FALSE(has("blend.domain")) << "what is seldom needed is folded away";
  click("blend.more");
  frame();
  click("blend.domain");
  frame();
  click("blend.domain.log");
  EXPECT_EQ(take_command<LayerSet>().domain, CloneDomain::kLog);
  frame();
  click("blend.strength", 0.5F);
  wait();
  EXPECT_NEAR(*take_command<LayerSet>().strength, 0.5, 0.02);
  click("blend.feather", 0.5F);
  wait();
  EXPECT_NEAR(*take_command<LayerSet>().feather_px, 30, 1);
  click("blend.screening", 0.5F);
  wait();
  EXPECT_NEAR(*take_command<LayerSet>().screening, 100, 2);
  click("blend.sampling");
  frame();
  click("blend.sampling.bicubic");
  EXPECT_EQ(take_command<LayerSet>().sampling, WarpSampling::kBicubic);
}

TEST_F(Panels, WithoutALayerThePanelsSaySo) {
  snapshot.document.selected.reset();
  show([this](const DrawContext& context) {
    draw_deform_panel(make_deform_model(snapshot), deform, this, pictures, context);
    draw_blend_panel(make_blend_model(snapshot), context);
  });
  EXPECT_TRUE(has("panel.deformation"));
  EXPECT_FALSE(has("deform.follow"));
  EXPECT_FALSE(has("blend.mode"));
}

TEST_F(Panels, HistoryJumps) {
  show([this](const DrawContext& context) { draw_history_panel(make_history_model(snapshot), history, context); });
  expect_tips();
  click("history.0");
  EXPECT_EQ(take_one<action::Jump>().entry, 0U);
  click("history.3");
  EXPECT_EQ(take_one<action::Jump>().entry, 3U);
  click("history.2");
  EXPECT_TRUE(take().empty()) << "it is there already";
}

TEST_F(Panels, LongHistoriesShowWhereTheyStand) {
  snapshot.history.assign(500, "Move 1, 0");
  snapshot.cursor = 499;
  show([this](const DrawContext& context) { draw_history_panel(make_history_model(snapshot), history, context); });
  frame();
  EXPECT_TRUE(has("history.499"));
  EXPECT_FALSE(has("history.0"));
  snapshot.cursor = 0;
  frame();
  frame();
  EXPECT_TRUE(has("history.0"));
}

TEST_F(Panels, ToolOptionsFollowTheTool) {
  show([this](const DrawContext& context) { draw_tool_panel(make_tool_model(state, snapshot), entries, context); });
  state.tool = Tool::kSketch;
  frame();
  expect_tips();
  click("tool.smoothing.stabiliser");
  EXPECT_EQ(take_one<action::SetPreferences>().preferences.smoothing, Smoothing::kStabiliser);
  click("tool.tolerance", 0.999F);
  wait();
  EXPECT_EQ(take_one<action::SetPreferences>().preferences.tolerance_px, 40);
  click("tool.reset_sketch");
  take_command<SketchReset>();
  state.tool = Tool::kPin;
  frame();
  EXPECT_FALSE(has("tool.smoothing.none"));
  EXPECT_TRUE(has("tool.remove_pin"));
  for (const Tool tool : {Tool::kOutline, Tool::kMove, Tool::kPan}) {
    state.tool = tool;
    frame();
    EXPECT_FALSE(make_tool_model(state, snapshot).keys.empty());
  }
}

} // namespace
} // namespace oversketch
