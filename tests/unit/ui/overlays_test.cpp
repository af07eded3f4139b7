#include "ui/canvas/overlays.h"

#include "core/geometry/curve.h"
#include "tests/unit/ui/hand.h"

#include <set>

namespace oversketch {
namespace {

using namespace testing;

/// A deformation that leaves a region where it is.
Deformation standing_still(const Layer& layer) {
  Deformation deformation;
  const ClosedCurve outline(layer.outline);
  deformation.outline = layer.outline;
  for (int i = 0; i < outline.size(); ++i)
    deformation.correspondence.push_back(outline.s_at(i) / outline.length());
  return deformation;
}

TEST(MatchedPlaces, are_none_where_nothing_fits) {
  const Document bare = one_layer(false), document = one_layer();
  EXPECT_TRUE(matched_places(bare.layers.front(), {}, 12).outline.empty());
  Deformation other = standing_still(document.layers.front());
  other.correspondence.pop_back();
  EXPECT_TRUE(matched_places(document.layers.front(), other, 12).outline.empty());
}

TEST(MatchedPlaces, lie_upon_each_other_where_nothing_is_deformed) {
  Document document = applied(one_layer(), LayerMove{{}, {30, -20}});
  const Layer& layer = document.layers.front();
  const MatchedPlaces places = matched_places(layer, standing_still(layer), 48);
  ASSERT_EQ(places.outline.size(), 48U);
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_LT(distance(places.outline[i] + Point{30, -20}, places.sketch[i]), 1e-9);
    EXPECT_NEAR(places.fractions[i], static_cast<double>(i) / 48, 1e-12);
  }
}

TEST(MatchedPlaces, understand_a_sketch_that_runs_the_other_way) {
  Document document = one_layer();
  Layer layer = document.layers.front();
  std::reverse(layer.sketch.begin() + 1, layer.sketch.end());
  const MatchedPlaces places = matched_places(layer, standing_still(layer), 48);
  for (std::size_t i = 0; i < places.outline.size(); ++i)
    EXPECT_LT(distance(places.outline[i], places.sketch[i]), 1e-9);
}

TEST(MeshCache, has_every_edge_once_and_knows_flipped_cells) {
  auto mesh = std::make_shared<QuadMesh>();
  mesh->cell = 1;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      mesh->vertices.push_back({static_cast<double>(x), static_cast<double>(y)});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      mesh->cells.push_back({4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4});
  mesh->coverage.assign(mesh->cells.size(), 1);
  auto positions = std::make_shared<Points>(mesh->vertices);
  (*positions)[0] = {2.5, 2.5};
  MeshCache cache;
  cache.update(mesh, positions);
  EXPECT_EQ(cache.edges.size(), 3U * 3 + 2 * 4);
  EXPECT_EQ(std::set(cache.edges.begin(), cache.edges.end()).size(), cache.edges.size());
  EXPECT_TRUE(cache.cells[0].flipped);
  EXPECT_FALSE(cache.cells[5].flipped);
  EXPECT_EQ(cache.usual_det, 1);
  const auto measured = measure_distortion(*mesh, *positions);
  EXPECT_EQ(measured.flipped_cells, 1);
}

TEST(Legends, stand_for_what_is_coloured_and_shown) {
  Overlays shown;
  EXPECT_TRUE(list_legends(shown, true).empty());
  shown.heat_sigma = shown.bleed = true;
  EXPECT_TRUE(list_legends(shown, false).empty()) << "nothing is coloured yet";
  const auto legends = list_legends(shown, true);
  ASSERT_EQ(legends.size(), 2u);
  EXPECT_EQ(legends[0].low, "1");
  EXPECT_EQ(legends[1].title, "Colour mismatch");
  shown.shown = false;
  EXPECT_TRUE(list_legends(shown, true).empty());
}

TEST(Colors, go_round_and_fade) {
  EXPECT_EQ(fraction_color(0.25), fraction_color(1.25));
  EXPECT_NE(fraction_color(0.25), fraction_color(0.75));
  EXPECT_NE(heat_color(0), heat_color(1));
  EXPECT_EQ(heat_color(7), heat_color(1));
  EXPECT_EQ(faded(IM_COL32(1, 2, 3, 200), 0.5f), IM_COL32(1, 2, 3, 100));
  EXPECT_EQ(faded(IM_COL32(1, 2, 3, 200), 9), IM_COL32(1, 2, 3, 200));
}

} // namespace
} // namespace oversketch
