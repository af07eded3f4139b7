#include "core/document/command.h"
#include "core/document/command_table.h"

#include "core/geometry/curve.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <limits>

namespace oversketch {
namespace {

using namespace testing;

const double kNan = std::numeric_limits<double>::quiet_NaN();

Document with_layer() {
  Document document = applied({}, new_document(200, 150));
  return applied(document, LayerAdd{loaded_ref("pictures/fish.png", plain_image(100, 80)), std::nullopt});
}

Document with_region() {
  return applied(with_layer(), RegionSet{{}, blob({50, 40}, 25)});
}

TEST(Apply, refuses_what_is_wrong_and_says_what) {
  const Document none, canvas = applied({}, new_document(200, 150)), layer = with_layer(), region = with_region();
  EXPECT_EQ(refusal(none, LayerMove{{}, {1, 2}}), "document.none");
  EXPECT_EQ(refusal(none, DocumentNew{}), "document.size");
  EXPECT_EQ(refusal(none, new_document(0, 10)), "value.range");
  EXPECT_EQ(refusal(none, new_document(60000, 60000)), "document.size");
  DocumentNew itself;
  itself.target = ImageRef{std::string(kTargetName), std::nullopt};
  EXPECT_EQ(refusal(none, itself), "target.itself");
  EXPECT_EQ(refusal(canvas, TargetSet{{std::string(kTargetName), std::nullopt}}), "target.itself");
  EXPECT_EQ(refusal(canvas, LayerMove{{}, {1, 2}}), "layer.none-selected");
  EXPECT_EQ(refusal(layer, LayerMove{LayerId{7}, {1, 2}}), "layer.unknown");
  EXPECT_EQ(refusal(layer, LayerOrder{{}, 1}), "layer.index");
  EXPECT_EQ(refusal(layer, SketchSet{{}, blob({50, 40}, 25)}), "layer.no-region");
  EXPECT_EQ(refusal(layer, PinAdd{{}, {1, 1}, {2, 2}}), "layer.no-region");
  EXPECT_EQ(refusal(layer, LayerTransform{{}, 10, 1, {}}), "layer.no-region");
  EXPECT_EQ(refusal(layer, RegionSet{{}, {{1, 1}, {5, 5}}}), "curve.too-few-points");
  EXPECT_EQ(refusal(layer, RegionSet{{}, {{1, 1}, {5, 5}, {9, 9}}}), "curve.no-area");
  EXPECT_EQ(refusal(layer, RegionSet{{}, {{1, 1}, {50, kNan}, {9, 40}}}), "curve.not-finite");
  EXPECT_EQ(refusal(layer, RegionSet{{}, {{10, 10}, {50, 50}, {50, 10}, {10, 50}}}), "curve.crosses-itself");
  EXPECT_EQ(refusal(layer, RegionSet{{}, blob({90, 40}, 25)}), "region.outside-source");
  EXPECT_EQ(refusal(region, SketchSet{{}, {{10, 10}, {50, 50}, {50, 10}, {10, 50}}}), "curve.crosses-itself");
  EXPECT_EQ(refusal(region, PinMove{{}, {1}, Point{1, 1}, {}}), "pin.unknown");
  EXPECT_EQ(refusal(region, PinRemove{{}, {1}}), "pin.unknown");
  EXPECT_EQ(refusal(region, PinAdd{{}, {kNan, 1}, {2, 2}}), "value.range");
  EXPECT_EQ(refusal(region, LayerTransform{{}, 0, 0, {}}), "value.range");
  EXPECT_EQ(refusal(region, LayerTransform{{}, kNan, 1, {}}), "value.range");
  EXPECT_EQ(refusal(region, LayerSet{}), "command.nothing-to-do");
  LayerSet loud;
  loud.strength = 1.5;
  EXPECT_EQ(refusal(region, loud), "value.range");
  EXPECT_EQ(refusal(region, LayerMove{{}, {1 << 20, 0}}), "accepted");
  EXPECT_EQ(refusal(applied(region, LayerMove{{}, {1 << 20, 0}}), LayerMove{{}, {1, 0}}), "transform.range");
}

TEST(Apply, leaves_the_document_it_was_given_alone) {
  const Document before = with_region();
  const Document copy = before;
  const Document after = applied(before, LayerMove{{}, {3, 4}});
  EXPECT_EQ(before, copy);
  EXPECT_FALSE(before == after);
}

TEST(Apply, draws_ids_in_order_of_creation_and_never_again) {
  Document document = with_layer();
  document = applied(document, LayerAdd{{std::string(kTargetName), {}}, "second"});
  document = applied(document, LayerRemove{LayerId{2}});
  document = applied(document, LayerAdd{{std::string(kTargetName), {}}, "third"});
  ASSERT_EQ(document.layers.size(), 2u);
  EXPECT_EQ(to_string(document.layers[1].id), "L3");
  EXPECT_EQ(document.layers[0].name, "fish");
  EXPECT_EQ(document.selected, LayerId{3});
  EXPECT_TRUE(document.layers[1].source.image == document.target.image);
}

TEST(Apply, removing_the_selected_layer_selects_the_one_below) {
  Document document = with_layer();
  document = applied(document, LayerAdd{{std::string(kTargetName), {}}, "second"});
  EXPECT_EQ(applied(document, LayerRemove{}).selected, LayerId{1});
  EXPECT_EQ(applied(document, LayerRemove{LayerId{1}}).selected, LayerId{2});
  EXPECT_FALSE(applied(with_layer(), LayerRemove{}).selected.has_value());
}

TEST(Apply, reorders_both_ways) {
  Document document = with_layer();
  for (const char* name : {"b", "c"})
    document = applied(document, LayerAdd{{std::string(kTargetName), {}}, name});
  const auto order = [](const Document& d) {
    std::string names;
    for (const Layer& layer : d.layers)
      names += to_string(layer.id);
    return names;
  };
  EXPECT_EQ(order(applied(document, LayerOrder{LayerId{1}, 2})), "L2L3L1");
  EXPECT_EQ(order(applied(document, LayerOrder{LayerId{3}, 0})), "L3L1L2");
  EXPECT_EQ(order(applied(document, LayerOrder{LayerId{2}, 1})), "L1L2L3");
}

TEST(Apply, a_region_first_appears_where_it_lies_or_in_the_middle) {
  const Document inside = with_region();
  EXPECT_EQ(inside.layers[0].placement, Placement{});
  EXPECT_EQ(inside.layers[0].sketch, inside.layers[0].outline);

  Document document = applied({}, new_document(60, 60));
  document = applied(document, LayerAdd{loaded_ref("s.png", plain_image(400, 300)), {}});
  document = applied(document, RegionSet{{}, blob({300, 200}, 20)});
  const Point centre = bounds(document.layers[0].sketch_in_target()).centre();
  EXPECT_NEAR(centre.x, 30, 1);
  EXPECT_NEAR(centre.y, 30, 1);
  EXPECT_EQ(document.layers[0].placement.offset, (Point{0, 0}));
}

TEST(Apply, an_untouched_sketch_follows_the_outline_and_a_drawn_one_stays) {
  Document document = applied(with_region(), RegionSet{{}, blob({45, 40}, 20)});
  EXPECT_EQ(document.layers[0].sketch, document.layers[0].outline);
  document = applied(document, SketchSet{{}, blob({100, 80}, 30)});
  const Points drawn = document.layers[0].sketch;
  document = applied(document, RegionSet{{}, blob({50, 40}, 22)});
  EXPECT_EQ(document.layers[0].sketch, drawn);
  document = applied(document, SketchReset{});
  EXPECT_EQ(document.layers[0].sketch, document.layers[0].outline);
}

TEST(Apply, moving_touches_whole_pixels_only_and_goes_back_exactly) {
  Document document = applied(with_region(), LayerTransform{{}, 33.3, 1.234, {}});
  const Document turned = document;
  for (int i = 0; i < 100; ++i)
    document = applied(document, LayerMove{{}, {7, -3}});
  EXPECT_EQ(document.layers[0].placement.offset, turned.layers[0].placement.offset);
  EXPECT_EQ(document.layers[0].placement.dx, turned.layers[0].placement.dx + 700);
  document = applied(document, LayerMove{{}, {-700, 300}});
  EXPECT_EQ(document, turned);
}

TEST(Apply, a_transform_keeps_its_fixed_point_and_scales_distances) {
  const Document before = with_region();
  const Point about{20, 30};
  const Document after = applied(before, LayerTransform{{}, 90, 2, about});
  const Points a = before.layers[0].sketch_in_target(), b = after.layers[0].sketch_in_target();
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Clockwise on the screen: what was to the right is below.
    const Point expected = about + 2 * turned(a[i] - about);
    EXPECT_NEAR(distance(b[i], expected), 0, 1e-9);
  }
}

TEST(Apply, a_sketch_is_kept_in_the_layers_own_space) {
  const Document turned = applied(with_region(), LayerTransform{{}, 40, 1.5, {}});
  const Points drawn = blob({120, 90}, 30);
  const Document after = applied(turned, SketchSet{{}, drawn});
  const Points shown = after.layers[0].sketch_in_target();
  for (std::size_t i = 0; i < drawn.size(); ++i)
    EXPECT_NEAR(distance(shown[i], drawn[i]), 0, 1e-9);
}

TEST(Apply, pins_snap_to_the_curves) {
  const Document document = applied(with_region(), PinAdd{{}, {90, 40}, {90, 41}});
  ASSERT_EQ(document.layers[0].pins.size(), 1u);
  const Pin& pin = document.layers[0].pins[0];
  EXPECT_EQ(to_string(pin.id), "P1");
  EXPECT_NEAR(ClosedCurve(document.layers[0].outline).nearest(pin.outline).distance, 0, 1e-9);
  EXPECT_NEAR(ClosedCurve(document.layers[0].sketch).nearest(pin.sketch).distance, 0, 1e-9);
}

TEST(Apply, pins_that_cross_are_refused_by_name) {
  Document document = with_region();
  const auto on_outline = [&](double turn) {
    return ClosedCurve(document.layers[0].outline).at(turn * perimeter(document.layers[0].outline));
  };
  for (const double turn : {0.1, 0.4, 0.7})
    document = applied(document, PinAdd{{}, on_outline(turn), on_outline(turn + 0.02)});
  const auto crossed = apply(document, PinMove{{}, {1}, {}, on_outline(0.55)});
  ASSERT_FALSE(crossed.ok());
  EXPECT_EQ(crossed.error().code, "pin.order");
  EXPECT_NE(crossed.error().sentence.find("P1"), std::string::npos);
  EXPECT_EQ(refusal(document, PinAdd{{}, on_outline(0.4), on_outline(0.5)}), "pin.same-place");
  EXPECT_EQ(refusal(document, PinMove{{}, {1}, {}, on_outline(0.3)}), "accepted");
}

TEST(Apply, pins_may_follow_a_sketch_that_runs_the_other_way) {
  Document document = with_region();
  Points reversed = document.layers[0].outline;
  std::reverse(reversed.begin(), reversed.end());
  document = applied(document, SketchSet{{}, reversed});
  const ClosedCurve outline(document.layers[0].outline);
  for (const double turn : {0.1, 0.4, 0.7, 0.9}) {
    const Point p = outline.at(turn * outline.length());
    document = applied(document, PinAdd{{}, p, p});
  }
  EXPECT_EQ(document.layers[0].pins.size(), 4u);
}

TEST(Apply, far_pins_are_dropped_when_a_curve_is_drawn_anew_and_the_label_says_so) {
  Document document = applied(with_region(), PinAdd{{}, {75, 40}, {75, 40}});
  const SketchSet far{{}, blob({150, 100}, 20)};
  const Document after = applied(document, far);
  EXPECT_TRUE(after.layers[0].pins.empty());
  EXPECT_EQ(label_of(far, document, after), "Sketch (1 pin dropped)");
  const Document near = applied(document, SketchSet{{}, blob({50, 40}, 26)});
  ASSERT_EQ(near.layers[0].pins.size(), 1u);
  EXPECT_NEAR(ClosedCurve(near.layers[0].sketch).nearest(near.layers[0].pins[0].sketch).distance, 0, 1e-9);
}

TEST(Label, says_what_was_done) {
  const Document document = with_region();
  const auto label = [&](const Command& c) { return label_of(c, document, applied(document, c)); };
  EXPECT_EQ(label(LayerMove{{}, {40, 12}}), "Move 40, 12");
  EXPECT_EQ(label(LayerTransform{{}, 12.5, 2, {}}), "Transform 12.5° × 2");
  EXPECT_EQ(label(LayerAdd{loaded_ref("a/puffer fish.png", plain_image(9, 9)), {}}), "Add layer puffer fish");
  EXPECT_EQ(label(TargetSet{loaded_ref("a/sea.jpg", plain_image(9, 9))}), "Change target to sea.jpg");
  EXPECT_EQ(label(LayerRemove{}), "Remove layer fish");
  LayerSet set;
  set.mode = CloneMode::kMixed;
  EXPECT_EQ(label(set), "Settings: blend mode");
}

} // namespace
} // namespace oversketch
