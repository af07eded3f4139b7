#include "core/document/command.h"
#include "core/document/history.h"

#include "core/geometry/curve.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oversketch {
namespace {

using namespace testing;

/// A round region of radius 40 at (60, 60) in a picture of 120 × 120, pasted where it lies.
Document with_disc() {
  Document document = applied({}, new_document(160, 140));
  document = applied(document, LayerAdd{loaded_ref("s.png", plain_image(120, 120)), {}});
  return applied(document, RegionSet{{}, blob({60, 60}, 40, 0, 120)});
}

/// A bump over the disc's right side, `half` radians to either side of it, bulging `by` px.
Points bump(Point centre, double radius, double by, double half = 0.5) {
  Points stroke;
  for (int i = 0; i <= 20; ++i) {
    const double angle = half * (i / 10.0 - 1), r = radius + by * std::sin(3.14159265358979 * i / 20);
    stroke.push_back(centre + r * Point{std::cos(angle), std::sin(angle)});
  }
  return stroke;
}

TEST(Redraw, refuses_what_changes_nothing) {
  const Document document = with_disc();
  EXPECT_EQ(refusal(document, SketchEdit{{}, {}}), "oversketch.stroke-too-short");
  EXPECT_EQ(refusal(document, SketchEdit{{}, {{100, 60}}}), "oversketch.stroke-too-short");
  EXPECT_EQ(refusal(document, SketchEdit{{}, {{100, 60}, {100, 60}}}), "oversketch.stroke-too-short");
  EXPECT_EQ(refusal(document, SketchEdit{{}, {{45, 60}, {75, 62}}}), "oversketch.not-near");
  EXPECT_EQ(refusal(document, SketchEdit{{}, {{-50, -60}, {-60, -20}}}), "sketch.outside-target");
  EXPECT_EQ(refusal(document, SketchEdit{{}, {{100, 60}, {100, HUGE_VAL}}}), "oversketch.not-finite");
  EXPECT_EQ(refusal(document, SketchEdit{{}, bump({60, 60}, 40, 8), StrokeSide::kAuto, -1}), "value.range");
  EXPECT_EQ(refusal(document, RegionEdit{{}, bump({60, 60}, 40, 30)}), "region.outside-source");
  Document empty = applied({}, new_document(160, 140));
  empty = applied(empty, LayerAdd{{std::string(kTargetName), {}}, "a"});
  EXPECT_EQ(refusal(empty, SketchEdit{{}, bump({60, 60}, 40, 8)}), "layer.no-region");
  EXPECT_EQ(refusal(empty, RegionEdit{{}, bump({60, 60}, 40, 8)}), "layer.no-region");
}

TEST(Redraw, replaces_a_part_of_the_sketch_and_keeps_the_rest_to_the_bit) {
  const Document before = with_disc();
  const Document after = applied(before, SketchEdit{{}, bump({60, 60}, 40, 9)});
  const Layer& layer = after.layers[0];
  EXPECT_EQ(layer.outline, before.layers[0].outline);
  EXPECT_NEAR(bounds(layer.sketch).high.x, 109, 0.5);
  std::size_t kept = 0;
  for (const Point p : before.layers[0].sketch)
    if (p.x < 75) kept += static_cast<std::size_t>(std::count(layer.sketch.begin(), layer.sketch.end(), p));
  std::size_t left = 0;
  for (const Point p : before.layers[0].sketch)
    left += p.x < 75 ? 1 : 0;
  EXPECT_EQ(kept, left);
  const SketchEdit edit{{}, bump({60, 60}, 40, 9)};
  EXPECT_EQ(label_of(edit, before, after), "Oversketch");
}

TEST(Redraw, speaks_target_pixels_whatever_the_placement) {
  Document moved = applied(with_disc(), LayerMove{{}, {20, 10}});
  moved = applied(moved, LayerTransform{{}, 40, 1.2, Point{80, 70}});
  const Points shown = moved.layers[0].sketch_in_target();
  const Point centre = bounds(shown).centre();
  const Document after = applied(moved, SketchEdit{{}, bump(centre, 48, 9)});
  EXPECT_NEAR(bounds(after.layers[0].sketch_in_target()).high.x, centre.x + 57, 0.6);
  EXPECT_EQ(after.layers[0].placement, moved.layers[0].placement);
}

TEST(Redraw, an_untouched_sketch_follows_a_redrawn_outline) {
  const Document after = applied(with_disc(), RegionEdit{{}, bump({60, 60}, 40, 9)});
  EXPECT_EQ(after.layers[0].sketch, after.layers[0].outline);
  EXPECT_NEAR(bounds(after.layers[0].outline).high.x, 109, 0.5);
  Document drawn = applied(with_disc(), SketchEdit{{}, bump({60, 60}, 40, -9)});
  const Points sketch = drawn.layers[0].sketch;
  drawn = applied(drawn, RegionEdit{{}, bump({60, 60}, 40, 9)});
  EXPECT_EQ(drawn.layers[0].sketch, sketch);
}

TEST(Redraw, pins_on_the_rest_stay_to_the_bit_and_the_others_go_along) {
  Document before = with_disc();
  for (const Point p : {Point{20, 60}, Point{60, 100}, Point{100, 60}})
    before = applied(before, PinAdd{{}, p, p});
  const Document after = applied(before, SketchEdit{{}, bump({60, 60}, 40, 9)});
  ASSERT_EQ(after.layers[0].pins.size(), 3u);
  EXPECT_EQ(after.layers[0].pins[0], before.layers[0].pins[0]);
  EXPECT_EQ(after.layers[0].pins[1], before.layers[0].pins[1]);
  EXPECT_EQ(after.layers[0].pins[2].outline, before.layers[0].pins[2].outline);
  const CurvePosition near = ClosedCurve(after.layers[0].sketch).nearest({100, 60});
  EXPECT_NEAR(distance(after.layers[0].pins[2].sketch, near.point), 0, 1e-9);
  EXPECT_GT(near.distance, 7);
}

TEST(Redraw, pins_that_are_left_far_behind_are_dropped_and_the_label_says_so) {
  Document before = applied(with_disc(), PinAdd{{}, {100, 60}, {100, 60}});
  const SketchEdit edit{{}, bump({60, 60}, 40, 30, 1.2)};
  const Document after = applied(before, edit);
  EXPECT_TRUE(after.layers[0].pins.empty());
  EXPECT_EQ(label_of(edit, before, after), "Oversketch (1 pin dropped)");
}

TEST(Redraw, stroke_over_stroke_over_stroke_leaves_a_sound_curve) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    RandomCommands random(seed);
    History history;
    ASSERT_TRUE(history.execute(new_document(120, 100)).ok());
    ASSERT_TRUE(history.execute(LayerAdd{loaded_ref("s.png", plain_image(100, 90)), {}}).ok());
    ASSERT_TRUE(history.execute(RegionSet{{}, blob({45, 42}, 24, 0.1)}).ok());
    int taken = 0;
    for (int i = 0; i < 40; ++i) {
      const Document before = history.present();
      const SketchEdit edit{{}, random.stroke(), random.side(), random.real(3, 15), random.chance()};
      if (!history.execute(edit)) {
        ASSERT_EQ(history.present(), before);
        continue;
      }
      ++taken;
      const Points& sketch = history.present().layers[0].sketch;
      ASSERT_TRUE(check_closed_curve(sketch, "sketch").ok()) << "seed " << seed << " stroke " << i;
      ASSERT_EQ(signed_area(sketch) > 0, signed_area(before.layers[0].sketch) > 0)
          << "seed " << seed << " stroke " << i;
    }
    EXPECT_GT(taken, 0) << "seed " << seed;
  }
}

} // namespace
} // namespace oversketch
