#include "core/session/live_picture.h"

#include "core/session/live_snapshot.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace oversketch {
namespace {

using namespace testing;
using live::Picture;
using live::Quality;

void execute(Session& session, const Command& command) {
  const auto done = session.execute(command);
  ASSERT_TRUE(done.ok()) << to_string(done.error());
}

/// Four layers in a row that overlap each other in part, each with its own way of blending.
Session four_layers() {
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(200, 140, 0));
  execute(session, begin);
  for (int i = 0; i < 4; ++i) {
    execute(session, LayerAdd{loaded_ref("source.png", wavy_image(120, 110, 1 + i)), std::nullopt});
    execute(session, RegionSet{{}, blob({60, 55}, 30)});
    execute(session, SketchSet{{}, blob({40 + 38.0 * i, 65 + 6.0 * (i % 2)}, 24, 0.2, 50, i)});
    LayerSet set;
    set.mode = std::array{CloneMode::kImport, CloneMode::kMixed, CloneMode::kNone, CloneMode::kAverage}.at(
        static_cast<std::size_t>(i));
    if (i == 3) set.opacity = 0.7;
    execute(session, set);
  }
  return session;
}

/// A picture and the screen that follows it by its patches alone.
struct Follower {
  live::SnapshotMaker images;
  Picture picture;
  Raster<Rgba8> screen;

  void paint(Session& session, Quality quality) {
    const auto layers = session.drawn_layers();
    ASSERT_TRUE(layers.ok()) << to_string(layers.error());
    PictureUpdate update;
    const auto target = images.show(session.shown().target.image).pixels;
    const auto done = picture.paint(target, *layers, quality, {}, update);
    ASSERT_TRUE(done.ok()) << to_string(done.error());
    if (update.whole) screen = Raster<Rgba8>(update.width, update.height);
    for (const PicturePatch& patch : update.patches)
      for (int y = 0; y < patch.pixels.height(); ++y)
        for (int x = 0; x < patch.pixels.width(); ++x)
          screen.at(patch.x + x, patch.y + y) = patch.pixels.at(x, y);
  }
};

int worst_difference(const Raster<Rgba8>& a, const Raster<Rgba8>& b) {
  if (a.rect() != b.rect()) return 256;
  int most = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const Rgba8 p = a.values()[i], q = b.values()[i];
    for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a})
      most = std::max(most, std::abs(d));
  }
  return most;
}

TEST(LivePicture, shows_nothing_without_a_target) {
  Picture picture;
  PictureUpdate update;
  ASSERT_TRUE(picture.paint(nullptr, {}, Quality::kRest, {}, update).ok());
  EXPECT_TRUE(picture.pixels().empty());
  EXPECT_TRUE(update.patches.empty());
}

// Each layer is rounded to 8 bits before the next one is blended onto it.
TEST(LivePicture, is_the_composite_to_a_level_for_each_layer_at_rest) {
  Session session = four_layers();
  Follower follower;
  follower.paint(session, Quality::kRest);
  const auto composite = session.composite();
  ASSERT_TRUE(composite.ok());
  EXPECT_LE(worst_difference(follower.screen, to_display(*composite)), 4);
}

/// Level `outside`, and `inside` in a disc in the middle.
Image disc_image(int size, float outside, float inside, double radius) {
  Raster<Rgba> pixels(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float v = std::hypot(x - size / 2.0, y - size / 2.0) < radius ? inside : outside;
      pixels.at(x, y) = {v, v, v, 1};
    }
  return Image(std::move(pixels));
}

// What a lower layer has beyond black and white is not seen, and an upper one is not blended onto it.
TEST(LivePicture, is_the_composite_where_a_lower_layer_is_beyond_black_and_white) {
  for (const bool dark : {true, false})
    for (const CloneMode mode : {CloneMode::kImport, CloneMode::kMixed, CloneMode::kAverage, CloneMode::kMonochrome}) {
      const auto level = [&](float v) { return dark ? v : 1 - v; };
      Session session;
      DocumentNew begin;
      begin.target = loaded_ref("target.png", disc_image(160, level(0.1F), level(0.15F), 60));
      execute(session, begin);
      // Where the source is 0.9 the target is 0.1: the disc of 0.2 becomes −0.6.
      execute(session, LayerAdd{loaded_ref("lower.png", disc_image(120, level(0.9F), level(0.2F), 34)), std::nullopt});
      execute(session, RegionSet{{}, blob({60, 60}, 42)});
      execute(session, SketchSet{{}, blob({70, 75}, 42)});
      execute(session, LayerAdd{loaded_ref("upper.png", wavy_image(120, 110, 3)), std::nullopt});
      execute(session, RegionSet{{}, blob({60, 55}, 30)});
      execute(session, SketchSet{{}, blob({90, 80}, 26)});
      LayerSet set;
      set.mode = mode;
      execute(session, set);
      Follower follower;
      follower.paint(session, Quality::kRest);
      const auto composite = session.composite();
      ASSERT_TRUE(composite.ok());
      EXPECT_LE(worst_difference(follower.screen, to_display(*composite)), 3) << dark;
    }
}

// Above white everything is meant where the target goes there.
TEST(LivePicture, a_target_beyond_white_is_blended_onto_as_it_is) {
  const auto picture = [](float most) {
    Session session;
    DocumentNew begin;
    begin.target = loaded_ref("target.hdr", disc_image(160, most, 0.5F, 20));
    execute(session, begin);
    for (const Point at : {Point{60, 75}, Point{90, 80}}) {
      execute(session, LayerAdd{loaded_ref("source.png", disc_image(120, 0.5F, 0.4F, 20)), std::nullopt});
      execute(session, RegionSet{{}, blob({60, 60}, 30)});
      execute(session, SketchSet{{}, blob(at, 30)});
    }
    return session.composite().value();
  };
  // Twice as bright: the source's differences stay, all else is higher by what the target is.
  const Image bright = picture(3), brighter = picture(4);
  EXPECT_NEAR(brighter.at(85, 85).r - bright.at(85, 85).r, 1, 0.2);
  EXPECT_GT(bright.at(85, 85).r, 2);
}

TEST(LivePicture, painting_what_has_changed_equals_painting_all) {
  Session session = four_layers();
  Follower follower;
  std::mt19937 random(7);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  for (int step = 0; step < 60; ++step) {
    const LayerId layer{number(1, 4)};
    switch (number(0, 5)) {
    case 0:
      execute(session, LayerOrder{layer, number(0, 3)});
      break;
    case 1: {
      LayerSet set;
      set.layer = layer;
      set.visible = number(0, 1) == 1;
      execute(session, set);
      break;
    }
    case 2: {
      LayerSet set;
      set.layer = layer;
      set.opacity = 0.25 * number(1, 4);
      execute(session, set);
      break;
    }
    default:
      execute(session, LayerMove{layer, {number(-12, 12), number(-12, 12)}});
    }
    if (number(0, 2) == 0) follower.paint(session, Quality::kFirst);
    follower.paint(session, Quality::kRest);
    Follower anew;
    anew.paint(session, Quality::kRest);
    ASSERT_EQ(follower.screen, anew.screen) << "after step " << step;
    ASSERT_EQ(follower.picture.pixels(), anew.screen);
  }
}

TEST(LivePicture, a_move_changes_only_what_overlaps) {
  Session session = four_layers();
  Follower follower;
  follower.paint(session, Quality::kRest);
  const Raster<Rgba8> before = follower.screen;
  LayerSet hide;
  hide.layer = LayerId{2};
  hide.visible = false;
  execute(session, hide);
  follower.paint(session, Quality::kRest);
  // Nothing joins the first layer with the others any more.
  const Raster<Rgba8> apart = follower.screen;
  execute(session, LayerMove{LayerId{4}, {5, 0}});
  const auto layers = session.drawn_layers();
  ASSERT_TRUE(layers.ok());
  PictureUpdate update;
  ASSERT_TRUE(follower.picture
                  .paint(follower.images.show(session.shown().target.image).pixels, *layers, Quality::kRest, {}, update)
                  .ok());
  ASSERT_EQ(update.patches.size(), 1u);
  EXPECT_GT(update.patches[0].x, 70) << "the first layer has been painted again";
}

TEST(LivePicture, a_cancelled_painting_is_made_up_for) {
  Session session = four_layers();
  Follower follower;
  follower.paint(session, Quality::kRest);
  execute(session, LayerMove{LayerId{2}, {9, 4}});
  const auto layers = session.drawn_layers();
  ASSERT_TRUE(layers.ok());
  std::stop_source stop;
  stop.request_stop();
  Watch watch;
  watch.stop = stop.get_token();
  PictureUpdate update;
  const auto target = follower.images.show(session.shown().target.image).pixels;
  EXPECT_EQ(follower.picture.paint(target, *layers, Quality::kRest, watch, update).error(), cancelled());
  EXPECT_TRUE(update.patches.empty());
  follower.paint(session, Quality::kRest);
  Follower anew;
  anew.paint(session, Quality::kRest);
  EXPECT_EQ(follower.screen, anew.screen);
}

} // namespace
} // namespace oversketch
