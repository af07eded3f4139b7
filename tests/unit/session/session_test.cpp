#include "core/session/session.h"

#include "core/image/compare.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace oversketch {
namespace {

using namespace testing;

void run(Session& session, const Command& command) {
  const auto done = session.execute(command);
  ASSERT_TRUE(done.ok()) << to_string(done.error());
}

Image picture(Session& session) {
  const auto composite = session.composite();
  EXPECT_TRUE(composite.ok()) << (composite.ok() ? "" : to_string(composite.error()));
  return composite.ok() ? *composite : Image();
}

Session with_sketch(DeformMethod method = DeformMethod::kFlipfree) {
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(160, 120, 0));
  run(session, begin);
  run(session, LayerAdd{loaded_ref("source.png", wavy_image(140, 130, 2)), std::nullopt});
  LayerSet set;
  set.method = method;
  run(session, set);
  run(session, RegionSet{{}, blob({60, 60}, 35)});
  run(session, SketchSet{{}, blob({80, 55}, 32, 0.3, 60, 0.5)});
  return session;
}

LayerSet setting(auto change) {
  LayerSet set;
  change(set);
  return set;
}

TEST(Session, refuses_what_has_no_answer) {
  Session session;
  EXPECT_EQ(session.composite().error().code, "document.none");
  EXPECT_EQ(session.deformation(LayerId{1}).error().code, "layer.unknown");
  EXPECT_EQ(session.layer_picture(LayerId{1}).error().code, "layer.unknown");
  run(session, new_document(50, 50));
  run(session, LayerAdd{{std::string(kTargetName), {}}, "a"});
  EXPECT_EQ(session.deformation(LayerId{1}).error().code, "layer.no-region");
}

TEST(Session, refuses_a_region_that_cannot_be_meshed_and_stays_as_it_was) {
  Session session;
  run(session, new_document(100, 100));
  run(session, LayerAdd{loaded_ref("s.png", wavy_image(100, 100, 1)), {}});
  const Document before = session.document();
  EXPECT_EQ(session.execute(RegionSet{{}, blob({50, 50}, 4)}).error().code, "mesh.cell-too-large");
  EXPECT_EQ(session.execute(RegionSet{{}, blob({50, 50}, 4)}).error().where, "layer L1: cell size");
  EXPECT_EQ(session.document(), before);
  run(session, RegionSet{{}, blob({50, 50}, 40)});
  EXPECT_EQ(session.execute(setting([](LayerSet& s) { s.cell_px = 400; })).error().code, "mesh.cell-too-large");

  Session large;
  run(large, new_document(100, 100));
  run(large, LayerAdd{loaded_ref("s.png", wavy_image(1000, 1000, 1)), {}});
  run(large, RegionSet{{}, blob({500, 500}, 400)});
  EXPECT_EQ(large.execute(setting([](LayerSet& s) { s.cell_px = 0.2; })).error().code, "mesh.too-many-vertices");
  EXPECT_EQ(large.document().layers[0].settings.cell_px, 10);
}

TEST(Session, a_layer_takes_no_more_memory_than_it_may) {
  Session session;
  run(session, new_document(100, 100));
  run(session, LayerAdd{loaded_ref("s.png", wavy_image(100, 100, 1)), {}});
  run(session, RegionSet{{}, blob({50, 50}, 40)});
  const auto box = session.layer_pixels(LayerId{1}).value().rect;
  const std::size_t pixels = static_cast<std::size_t>(box.width + 2) * static_cast<std::size_t>(box.height + 2);
  session.limit_memory(pixels * Session::kLayerPixelBytes);
  EXPECT_TRUE(session.composite().ok());
  run(session, LayerTransform{{}, 0, 1.1, {}});
  EXPECT_EQ(session.composite().error().code, "warp.too-large");
  EXPECT_EQ(session.composite().error().where, "layer L1");
  session.limit_memory(2 * pixels * Session::kLayerPixelBytes);
  EXPECT_TRUE(session.composite().ok());
}

/// What an edit redoes, held by the counters.
struct Work {
  std::int64_t meshings, symbolic, numeric, matches, masks, solves;
  bool operator==(const Work&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Work& w) {
  return out << "meshings " << w.meshings << " symbolic " << w.symbolic << " numeric " << w.numeric << " matches "
             << w.matches << " masks " << w.masks << " solves " << w.solves;
}

Work work_of(Session& session, const auto& edit) {
  const Counters before = session.counters();
  edit();
  picture(session);
  const Counters& after = session.counters();
  return {after.deform.meshings - before.deform.meshings,
          after.deform.symbolic_factorizations - before.deform.symbolic_factorizations,
          after.deform.numeric_factorizations - before.deform.numeric_factorizations,
          after.deform.matches - before.deform.matches,
          after.mask_setups - before.mask_setups,
          after.clone_solves - before.clone_solves};
}

TEST(Session, redoes_only_what_an_edit_touches_with_the_papers_method) {
  Session session = with_sketch(DeformMethod::kPaper);
  const auto after = [&](const Command& command) { return work_of(session, [&] { run(session, command); }); };
  EXPECT_EQ(work_of(session, [] {}), (Work{0, 0, 0, 0, 1, 1})) << "the region was deformed when its sketch was set";
  EXPECT_EQ(work_of(session, [] {}), (Work{0, 0, 0, 0, 0, 0})) << "asked again";
  EXPECT_EQ(after(LayerMove{{}, {7, -4}}), (Work{0, 0, 0, 0, 0, 1})) << "move: right-hand side, solve, paint";
  EXPECT_EQ(after(SketchSet{{}, blob({85, 50}, 30, 0.2, 50)}), (Work{0, 0, 0, 1, 1, 1})) << "sketch: no factorization";
  EXPECT_EQ(after(setting([](LayerSet& s) { s.iterations = 20; })), (Work{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.handle_weight = 0.5; })), (Work{0, 0, 1, 1, 1, 1}))
      << "ω: numeric factor alone";
  EXPECT_EQ(after(setting([](LayerSet& s) { s.stiffness = 2; })), (Work{0, 0, 0, 0, 0, 0})) << "not this method's";
  EXPECT_EQ(after(setting([](LayerSet& s) { s.mode = CloneMode::kMixed; })), (Work{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.strength = 0.5; })), (Work{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.cell_px = 8; })), (Work{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(after(PinAdd{{}, {95, 60}, {115, 55}}), (Work{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(after(LayerTransform{{}, 10, 1.1, {}}), (Work{0, 0, 0, 0, 1, 1})) << "the same deformation, another mask";
  EXPECT_EQ(after(LayerRename{{}, "fish"}), (Work{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(after(TargetSet{loaded_ref("other.png", wavy_image(160, 120, 5))}), (Work{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(after(RegionSet{{}, blob({62, 60}, 33)}), (Work{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.visible = false; })), (Work{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(work_of(session, [&] { (void)session.undo(2).ok(); }), (Work{0, 0, 0, 0, 0, 0}))
      << "undo finds what was there";
}

TEST(Session, redoes_only_what_an_edit_touches_with_the_flipfree_method) {
  Session session = with_sketch();
  // Newton factors its Hessian at each step: how often is its own affair, but not always whether.
  const auto after = [&](const Command& command) {
    Work work = work_of(session, [&] { run(session, command); });
    work.numeric = work.numeric > 0 ? 1 : 0;
    return work;
  };
  EXPECT_EQ(work_of(session, [] {}), (Work{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(after(LayerMove{{}, {7, -4}}), (Work{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(after(SketchSet{{}, blob({85, 50}, 30, 0.2, 50)}), (Work{0, 0, 1, 1, 1, 1}))
      << "mesh and symbolic factor stay";
  const Points arc = {{113, 40}, {120, 50}, {113, 60}};
  EXPECT_EQ(after(SketchEdit{{}, arc}), (Work{0, 0, 1, 0, 1, 1})) << "oversketch: no new match";
  EXPECT_EQ(after(PinAdd{{}, {25, 60}, {57, 50}}), (Work{0, 0, 1, 0, 1, 1})) << "pin: no new match";
  EXPECT_EQ(after(PinMove{{}, {1}, {}, Point{57, 52}}), (Work{0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.follow = 10; })), (Work{0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.stiffness = 2; })), (Work{0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(after(setting([](LayerSet& s) { s.cell_px = 5; })), (Work{0, 0, 0, 0, 1, 1}))
      << "drawn mesh: the solution stays";
  EXPECT_EQ(after(setting([](LayerSet& s) { s.handle_weight = 0.5; })), (Work{0, 0, 0, 0, 0, 0}))
      << "not this method's";
  EXPECT_EQ(after(LayerTransform{{}, 10, 1.1, {}}), (Work{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(after(RegionSet{{}, blob({62, 60}, 33)}), (Work{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(work_of(session, [&] { (void)session.undo(3).ok(); }), (Work{0, 0, 0, 0, 0, 0}));
}

TEST(Session, a_layer_whose_sketch_is_its_outline_shows_its_picture) {
  for (const CloneMode mode : {CloneMode::kImport, CloneMode::kMixed, CloneMode::kAverage, CloneMode::kNone}) {
    Session session;
    DocumentNew begin;
    begin.target = loaded_ref("target.png", wavy_image(160, 120, 0));
    run(session, begin);
    run(session, LayerAdd{{std::string(kTargetName), {}}, "copy"});
    run(session, RegionSet{{}, blob({70, 60}, 40, 0.25, 70)});
    run(session, setting([&](LayerSet& s) { s.mode = mode; }));
    EXPECT_LE(compare(picture(session), session.document().target.image)->max_levels, 1) << static_cast<int>(mode);
  }
}

TEST(Session, the_distance_from_the_sketch_is_that_of_what_is_shown) {
  // A square of four points that bulges: what is shown follows the bulge, the four points lie far from it.
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("target.png", wavy_image(300, 300, 0));
  run(session, begin);
  run(session, LayerAdd{loaded_ref("source.png", wavy_image(220, 220, 1)), std::nullopt});
  run(session, RegionSet{{}, {{20, 20}, {200, 20}, {200, 200}, {20, 200}}});
  Points bulging = {{60, 60}, {240, 60}, {240, 240}, {60, 240}};
  for (int i = 1; i < 20; ++i) {
    const double along = i / 20.0;
    bulging.push_back({60 - 40 * std::sin(std::numbers::pi * along), 240 - 180 * along});
  }
  run(session, SketchSet{{}, bulging});
  const auto metrics = session.metrics({1});
  ASSERT_TRUE(metrics.ok());
  EXPECT_LT(metrics->sketch_distance.max, 6);
  EXPECT_LT(metrics->sketch_distance.mean, 1);
}

TEST(Session, bicubic_sampling_shows_another_picture_and_can_be_undone) {
  Session session = with_sketch();
  const Image before = picture(session);
  run(session, setting([](LayerSet& s) { s.sampling = WarpSampling::kBicubic; }));
  const Image after = picture(session);
  const auto difference = compare(before, after);
  ASSERT_TRUE(difference.ok());
  EXPECT_GT(difference->max_levels, 0);
  EXPECT_LT(difference->max_levels, 8);
  ASSERT_TRUE(session.undo().ok());
  EXPECT_EQ(picture(session), before);
}

TEST(Session, a_layer_above_or_below_is_left_alone) {
  Session session = with_sketch();
  run(session, LayerAdd{loaded_ref("second.png", wavy_image(90, 90, 3)), {}});
  run(session, RegionSet{{}, blob({45, 45}, 25)});
  picture(session);
  const auto moved_upper = work_of(session, [&] { run(session, LayerMove{LayerId{2}, {3, 0}}); });
  EXPECT_EQ(moved_upper, (Work{0, 0, 0, 0, 0, 1}));
  const auto moved_lower = work_of(session, [&] { run(session, LayerMove{LayerId{1}, {3, 0}}); });
  EXPECT_EQ(moved_lower, (Work{0, 0, 0, 0, 0, 2})) << "what stands above blends onto what changed";
}

TEST(Session, what_is_kept_equals_what_is_made_anew) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    RandomCommands random(seed);
    Session session, fresh;
    run(session, new_document(90, 80));
    run(fresh, new_document(90, 80));
    for (int i = 0; i < 40; ++i) {
      const Command command = random.next();
      if (!session.execute(command)) continue;
      const auto kept = session.composite();
      if (!kept) continue;
      if (i % 8 == 0) (void)session.undo().ok(), (void)session.composite().ok(), (void)session.redo().ok();
    }
    for (const History::Entry& entry : session.history().entries())
      if (!std::holds_alternative<DocumentNew>(entry.command)) run(fresh, entry.command);
    const auto kept = session.composite(), anew = fresh.composite();
    ASSERT_EQ(kept.ok(), anew.ok()) << "seed " << seed;
    if (kept) {
      EXPECT_EQ(*kept, *anew) << "seed " << seed;
    }
  }
}

TEST(Session, pixels_outside_the_region_keep_their_bits) {
  Session session = with_sketch();
  const Image shown = picture(session), alone = *session.layer_picture(LayerId{1});
  const Image& target = session.document().target.image;
  std::int64_t inside = 0;
  for (int y = 0; y < target.height(); ++y)
    for (int x = 0; x < target.width(); ++x) {
      if (alone.at(x, y).a == 0) {
        ASSERT_EQ(shown.at(x, y), target.at(x, y)) << x << ", " << y;
      } else {
        ASSERT_EQ(alone.at(x, y), shown.at(x, y)) << x << ", " << y;
        ++inside;
      }
    }
  EXPECT_NEAR(static_cast<double>(inside), 3200, 1200);
}

TEST(Session, a_hidden_or_transparent_layer_shows_the_target) {
  Session session = with_sketch();
  run(session, setting([](LayerSet& s) { s.visible = false; }));
  EXPECT_EQ(picture(session), session.document().target.image);
  run(session, setting([](LayerSet& s) { s.visible = true, s.opacity = 0; }));
  EXPECT_EQ(picture(session), session.document().target.image);
}

TEST(Session, a_region_moved_outside_the_picture_changes_nothing) {
  Session session = with_sketch();
  run(session, LayerMove{{}, {5000, 5000}});
  EXPECT_EQ(picture(session), session.document().target.image);
}

TEST(Session, a_stop_is_heard_and_harms_nothing) {
  Session session = with_sketch();
  std::stop_source source;
  source.request_stop();
  Watch watch;
  watch.stop = source.get_token();
  EXPECT_EQ(session.composite(watch).error().code, "cancelled");
  EXPECT_TRUE(session.composite().ok());
}

TEST(Session, its_log_replays_to_the_same_document_and_history) {
  for (unsigned seed = 50; seed < 60; ++seed) {
    RandomCommands random(seed);
    Session session, replay;
    run(session, new_document(90, 80));
    for (int i = 0; i < 60; ++i) {
      if (random.below(5) == 0)
        (void)session.undo(static_cast<std::size_t>(random.below(4))).ok();
      else if (random.below(6) == 0)
        (void)session.redo().ok();
      else
        (void)session.execute(random.next()).ok();
    }
    for (const Step& step : session.log()) {
      if (const auto* command = std::get_if<Command>(&step)) {
        run(replay, *command);
      } else if (const auto* undo = std::get_if<UndoStep>(&step)) {
        ASSERT_TRUE(replay.undo(static_cast<std::size_t>(undo->steps)).ok());
      } else {
        ASSERT_TRUE(replay.redo(static_cast<std::size_t>(std::get<RedoStep>(step).steps)).ok());
      }
    }
    EXPECT_EQ(replay.document(), session.document()) << "seed " << seed;
    EXPECT_EQ(replay.history().cursor(), session.history().cursor());
    ASSERT_EQ(replay.history().entries().size(), session.history().entries().size());
    for (std::size_t i = 0; i < replay.history().entries().size(); ++i)
      EXPECT_EQ(replay.history().entries()[i].label, session.history().entries()[i].label);
  }
}

} // namespace
} // namespace oversketch
