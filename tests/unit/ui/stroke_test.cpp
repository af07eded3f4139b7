#include "ui/canvas/stroke.h"

#include "core/geometry/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace oversketch {
namespace {

/// An arc of 340°, radius 100, drawn with a trembling hand.
Points trembling_arc(double tremble, int count = 700, double scale = 1) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 5.9 * i / (count - 1), r = 100 + tremble * noise(random);
    points.push_back(scale * r * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

Points smoothed(const Points& points, Smoothing smoothing, double zoom = 1) {
  Stroke stroke(smoothing, zoom);
  double time_s = 0;
  for (const Point p : points)
    stroke.add(p, time_s += 0.005);
  return stroke.smoothed();
}

/// All turning along the way, radians: what makes a line look rough.
double roughness(const Points& line) {
  double turning = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Point a = line[i] - line[i - 1], b = line[i + 1] - line[i];
    turning += std::abs(std::atan2(cross(a, b), dot(a, b)));
  }
  return turning;
}

TEST(Stroke, takes_no_harm_from_nonsense) {
  EXPECT_TRUE(smoothed({}, Smoothing::kBasic).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(smoothed({{1, 2}, {nan, 2}, {infinity, 0}, {3, 4}}, Smoothing::kStabiliser), (Points{{1, 2}, {3, 4}}));
  EXPECT_EQ(smoothed({{1, 2}, {1, 2}, {1, 2}}, Smoothing::kBasic), (Points{{1, 2}}));
  // Zoomed far out in the middle of a stroke that began zoomed far in.
  EXPECT_LT(smoothed({{0, 0}, {1, 1}, {1e6, 1e6}, {0, 2e6}}, Smoothing::kBasic, 256).size(), 30'000U);
}

TEST(Stroke, keeps_every_point_with_its_time) {
  Stroke stroke(Smoothing::kStabiliser, 1);
  for (int i = 0; i < 200; ++i)
    stroke.add({static_cast<double>(i), 0}, 0.001 * i);
  ASSERT_EQ(stroke.samples().size(), 200U);
  EXPECT_EQ(stroke.samples()[17].time_s, 0.001 * 17);
}

TEST(Stroke, without_smoothing_is_what_was_drawn) {
  const Points drawn = trembling_arc(2);
  EXPECT_EQ(smoothed(drawn, Smoothing::kNone), drawn);
}

TEST(Stroke, smoothing_takes_the_tremble_and_keeps_shape_and_ends) {
  const Points drawn = trembling_arc(0.7);
  const double before = roughness(drawn);
  double last = before;
  for (const Smoothing smoothing : {Smoothing::kBasic, Smoothing::kStabiliser}) {
    const Points line = smoothed(drawn, smoothing);
    EXPECT_LT(roughness(line), last / 2);
    last = roughness(line);
    EXPECT_EQ(line.front(), drawn.front());
    EXPECT_EQ(line.back(), drawn.back()) << "the line has caught up with the pen";
  }
}

TEST(Stroke, smoothing_hardly_shrinks_an_arc) {
  const Points line = smoothed(trembling_arc(0), Smoothing::kStabiliser);
  // Where both averages have their full width: 3 σ each, a point a pixel.
  const std::size_t ends = 100;
  for (std::size_t i = ends; i + ends < line.size(); ++i)
    EXPECT_NEAR(length(line[i]), 100, 0.1);
}

TEST(Stroke, neither_speed_nor_event_rate_matter) {
  const Points often = smoothed(trembling_arc(0, 2000), Smoothing::kBasic);
  const ClosedCurve seldom(smoothed(trembling_arc(0, 150), Smoothing::kBasic));
  for (const Point p : often)
    EXPECT_LT(seldom.nearest(p).distance, 0.2);
}

TEST(Stroke, what_is_smoothed_are_screen_pixels) {
  const Points screen = smoothed(trembling_arc(1.5), Smoothing::kBasic, 1);
  const Points zoomed_in = smoothed(trembling_arc(1.5, 700, 0.125), Smoothing::kBasic, 8);
  ASSERT_EQ(screen.size(), zoomed_in.size());
  for (std::size_t i = 0; i < screen.size(); ++i)
    EXPECT_LT(distance(screen[i], 8 * zoomed_in[i]), 1e-9);
}

} // namespace
} // namespace oversketch
