#include "core/session/live_session.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace oversketch {
namespace {

using namespace testing;

/// The commands that lead to a document with one sketched layer.
std::vector<Command> sketched() {
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(160, 120, 0));
  return {begin, LayerAdd{loaded_ref("source.png", wavy_image(140, 130, 2)), "fish"}, RegionSet{{}, blob({60, 60}, 35)},
          SketchSet{{}, blob({80, 55}, 32, 0.3, 60, 0.5)}};
}

Session plain_session(const std::vector<Command>& commands) {
  Session session;
  for (const Command& command : commands) {
    const auto done = session.execute(command);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : to_string(done.error()));
  }
  return session;
}

void execute_all(LiveSession& live, const std::vector<Command>& commands) {
  for (const Command& command : commands)
    live.execute(command);
  live.wait_until_idle();
}

/// The shown picture, put together from everything that was handed out.
class Screen {
public:
  const Raster<Rgba8>& take(LiveSession& live) {
    PictureUpdate update = live.take_picture_update();
    if (update.whole) pixels_ = Raster<Rgba8>(update.width, update.height);
    for (const PicturePatch& patch : update.patches)
      for (int y = 0; y < patch.pixels.height(); ++y)
        for (int x = 0; x < patch.pixels.width(); ++x)
          pixels_.at(patch.x + x, patch.y + y) = patch.pixels.at(x, y);
    return pixels_;
  }

private:
  Raster<Rgba8> pixels_;
};

int greatest_difference(const Raster<Rgba8>& a, const Raster<Rgba8>& b) {
  if (a.rect() != b.rect()) return 256;
  int most = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const Rgba8 p = a.values()[i], q = b.values()[i];
    for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a})
      most = std::max(most, std::abs(d));
  }
  return most;
}

void expect_picture_of(Screen& screen, LiveSession& live, Session& session) {
  const auto composite = session.composite();
  ASSERT_TRUE(composite.ok());
  EXPECT_LE(greatest_difference(screen.take(live), to_display(*composite)), 1);
}

TEST(LiveSession, refusals_become_a_numbered_problem_and_change_nothing) {
  LiveSession live;
  live.execute(LayerSelect{LayerId{4}});
  live.undo();
  live.execute(TargetSet{{"no/such/picture.png", {}}});
  live.wait_until_idle();
  const auto snapshot = live.snapshot();
  EXPECT_EQ(snapshot->problem_number, 3u);
  ASSERT_TRUE(snapshot->problem);
  EXPECT_EQ(snapshot->problem->code, "image.missing");
  EXPECT_TRUE(snapshot->document.empty());
  EXPECT_TRUE(snapshot->history.empty());
}

TEST(LiveSession, shows_what_a_session_on_the_same_thread_does) {
  LiveSession live;
  execute_all(live, sketched());
  Session session = plain_session(sketched());
  const auto snapshot = live.snapshot();
  EXPECT_FALSE(snapshot->problem) << to_string(*snapshot->problem);
  EXPECT_EQ(snapshot->document, session.document());
  EXPECT_EQ(snapshot->history.size(), 4u);
  EXPECT_EQ(snapshot->cursor, 3u);
  const LayerSnapshot* layer = snapshot->find(LayerId{1});
  ASSERT_NE(layer, nullptr);
  ASSERT_NE(layer->deformation, nullptr);
  EXPECT_EQ(layer->deformation->positions, (*session.deformation(LayerId{1}))->positions);
  ASSERT_TRUE(layer->metrics);
  EXPECT_EQ(layer->metrics->distortion.flipped_cells, 0);
  EXPECT_EQ(layer->source.pixels->width(), 140);
  ASSERT_NE(layer->thumbnail, nullptr);
  EXPECT_LE(std::max(layer->thumbnail->width(), layer->thumbnail->height()), 96);
  Screen screen;
  expect_picture_of(screen, live, session);
}

TEST(LiveSession, previews_are_shown_and_only_the_commit_is_a_step) {
  LiveSession live;
  Screen screen;
  execute_all(live, sketched());
  for (int i = 1; i <= 40; ++i)
    live.preview(LayerMove{{}, {i, -i / 2}});
  live.wait_until_idle();
  EXPECT_TRUE(live.snapshot()->in_gesture);
  EXPECT_EQ(live.snapshot()->history.size(), 4u);
  Session session = plain_session(sketched());
  ASSERT_TRUE(session.execute(LayerMove{{}, {40, -20}}).ok());
  EXPECT_EQ(live.snapshot()->document, session.document());
  expect_picture_of(screen, live, session);

  live.commit();
  live.wait_until_idle();
  EXPECT_FALSE(live.snapshot()->in_gesture);
  EXPECT_EQ(live.snapshot()->history.size(), 5u);
  EXPECT_EQ(live.snapshot()->document, session.document());
  EXPECT_FALSE(live.snapshot()->problem);

  live.undo();
  live.wait_until_idle();
  ASSERT_TRUE(session.undo().ok());
  EXPECT_EQ(live.snapshot()->document, session.document());
  expect_picture_of(screen, live, session);
}

TEST(LiveSession, an_abandoned_gesture_leaves_no_trace) {
  LiveSession live;
  Screen screen;
  execute_all(live, sketched());
  const auto before = live.snapshot();
  const Raster<Rgba8> seen = screen.take(live);
  live.preview(SketchSet{{}, blob({90, 60}, 25)});
  live.wait_until_idle();
  EXPECT_NE(live.snapshot()->document, before->document);
  live.abandon();
  live.commit();
  live.wait_until_idle();
  EXPECT_EQ(live.snapshot()->document, before->document);
  EXPECT_EQ(live.snapshot()->history, before->history);
  EXPECT_FALSE(live.snapshot()->modified != before->modified);
  EXPECT_EQ(screen.take(live), seen);
}

TEST(LiveSession, a_commit_whose_last_preview_was_refused_changes_nothing) {
  LiveSession live;
  execute_all(live, sketched());
  const Document before = live.snapshot()->document;
  live.preview(SketchSet{{}, blob({90, 60}, 25)});
  live.wait_until_idle();
  live.preview(SketchSet{{}, {{10, 10}, {60, 60}, {60, 10}, {10, 60}}});
  live.commit();
  live.wait_until_idle();
  EXPECT_EQ(live.snapshot()->document, before);
  EXPECT_EQ(live.snapshot()->history.size(), 4u);
  ASSERT_TRUE(live.snapshot()->problem);
}

TEST(LiveSession, jobs_run_on_the_session_and_their_errors_are_told) {
  LiveSession live;
  execute_all(live, sketched());
  std::atomic<int> steps = 0, refused = 0;
  live.run("Counting", [&](Session& session, const Watch&) -> Result<void> {
    steps = static_cast<int>(session.history().entries().size());
    return {};
  });
  live.run(
      "Failing", [](Session&, const Watch&) -> Result<void> { throw std::bad_alloc(); },
      [&](const Result<void>& outcome) { refused = !outcome.ok(); });
  live.wait_until_idle();
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(refused, 1);
  EXPECT_EQ(live.snapshot()->problem->code, "memory.exhausted");
  EXPECT_EQ(live.snapshot()->history.size(), 4u);
}

TEST(LiveSession, long_work_can_be_cancelled) {
  LiveSession live;
  std::atomic<bool> begun = false;
  live.run("Waiting", [&](Session&, const Watch& watch) -> Result<void> {
    begun = true;
    while (!watch.stopped())
      std::this_thread::yield();
    return cancelled();
  });
  while (!begun)
    std::this_thread::yield();
  EXPECT_TRUE(live.activity().busy);
  live.cancel();
  live.wait_until_idle();
  EXPECT_FALSE(live.activity().busy);
  EXPECT_EQ(live.snapshot()->problem->code, cancelled().code);
}

TEST(LiveSession, tells_its_owner_of_every_request_that_was_served) {
  std::vector<std::size_t> logs;
  LiveSession live({}, [&](const Session& session) { logs.push_back(session.log().size()); });
  const std::vector<Command> commands = sketched();
  for (const Command& command : commands)
    live.execute(command);
  live.preview(LayerMove{{}, {3, 4}});
  live.undo();
  live.wait_until_idle();
  EXPECT_EQ(logs, (std::vector<std::size_t>{1, 2, 3, 4, 5})) << "a preview is no step";
}

TEST(LiveSession, the_history_limit_outlives_what_is_opened) {
  LiveSession live;
  live.limit_history({.least_steps = 1, .bytes = std::size_t{1} << 30, .most_steps = 3});
  live.run("opening", [](Session& session, const Watch&) {
    session.adopt(plain_session(sketched()));
    return Result<void>();
  });
  for (int i = 0; i < 6; ++i)
    live.execute(LayerMove{{}, {1, 0}});
  live.wait_until_idle();
  EXPECT_EQ(live.snapshot()->history.size(), 4u);
}

/// How far a point is from the nearest of the others.
double gap(Point at, const Points& others) {
  double nearest = INFINITY;
  for (const Point other : others)
    nearest = std::min(nearest, distance(at, other));
  return nearest;
}

TEST(LiveSession, forecasts_bleeding_along_the_boundary_where_the_layer_stands) {
  LiveSession live;
  execute_all(live, sketched());
  live.execute(LayerMove{{}, {11, -7}});
  live.wait_until_idle();
  const auto shown = live.snapshot();
  const LayerSnapshot& layer = shown->layers.at(0);
  ASSERT_NE(layer.bleed, nullptr);
  const Points boundary =
      transformed(layer.deformation->boundary, shown->document.find(layer.id)->placement.to_target());
  ASSERT_GT(layer.bleed->samples.size(), 50u);
  for (const BleedSample& sample : layer.bleed->samples)
    EXPECT_LT(gap(sample.at, boundary), 6);
  for (const Point corner : boundary) {
    Points samples;
    for (const BleedSample& sample : layer.bleed->samples)
      samples.push_back(sample.at);
    EXPECT_LT(gap(corner, samples), 1.5);
  }
  EXPECT_GT(layer.bleed->largest_norm, 1);
  live.execute(LayerRemove{});
  live.wait_until_idle();
  EXPECT_TRUE(live.snapshot()->layers.empty());
}

TEST(LiveSession, ends_while_it_is_busy) {
  for (int i = 0; i < 5; ++i) {
    LiveSession live;
    for (const Command& command : sketched())
      live.execute(command);
    live.preview(LayerMove{{}, {i, 0}});
  }
}

TEST(LiveSession, takes_requests_from_several_threads) {
  LiveSession live;
  execute_all(live, sketched());
  std::vector<std::thread> hands;
  for (int hand = 0; hand < 3; ++hand)
    hands.emplace_back([&live] {
      for (int i = 0; i < 20; ++i) {
        live.execute(LayerMove{{}, {1, 0}});
        (void)live.snapshot();
        (void)live.take_picture_update();
      }
    });
  for (std::thread& hand : hands)
    hand.join();
  live.wait_until_idle();
  EXPECT_EQ(live.snapshot()->document.find(LayerId{1})->placement.dx, 60);
  EXPECT_EQ(live.snapshot()->history.size(), 64u);
}

TEST(LiveSession, every_match_can_be_taken_and_taken_back_in_one_step) {
  const Points curve = testing::bar({60, 60}, 40, 18);
  LiveSession live;
  live.want_alternatives(true);
  std::vector<Command> commands = sketched();
  commands[2] = RegionSet{{}, curve};
  commands[3] = SketchSet{{}, curve};
  execute_all(live, commands);
  const auto chosen = [&] {
    std::vector<bool> all;
    for (const AlternativeSnapshot& each : live.snapshot()->alternatives)
      all.push_back(each.chosen);
    return all;
  };
  const auto take = [&](std::size_t index) {
    live.execute(live.snapshot()->alternatives.at(index).take);
    live.wait_until_idle();
  };
  const auto places = [&] { return live.snapshot()->layers.at(0).deformation->outline; };
  ASSERT_EQ(chosen(), (std::vector{true, false})) << "a bar and its half turn";
  const Points first = places();
  const std::size_t steps = live.snapshot()->history.size();
  take(1);
  EXPECT_EQ(chosen(), (std::vector{false, true})) << "all stay there to be taken";
  EXPECT_GT(distance(places()[0], first[0]), 40);
  live.execute(LayerMove{{}, {7, 5}});
  live.wait_until_idle();
  take(0);
  EXPECT_EQ(chosen(), (std::vector{true, false}));
  EXPECT_LT(distance(places()[0], first[0]), 1);
  const auto snapshot = live.snapshot();
  ASSERT_EQ(snapshot->history.size(), steps + 3);
  EXPECT_EQ(snapshot->history[steps], "Other match");
  EXPECT_EQ(snapshot->history[steps + 2], "Other match");
  live.undo();
  live.wait_until_idle();
  EXPECT_EQ(chosen(), (std::vector{false, true}));
  live.undo(2);
  live.wait_until_idle();
  EXPECT_EQ(chosen(), (std::vector{true, false}));
  EXPECT_TRUE(live.snapshot()->document.layers[0].pins.empty());
  live.execute(PinAdd{{}, curve[5], curve[9]});
  live.wait_until_idle();
  EXPECT_TRUE(chosen().empty()) << "another pin decides";
}

} // namespace
} // namespace oversketch
