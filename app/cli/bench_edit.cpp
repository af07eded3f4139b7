// What an edit of a solved region costs.  The edits are made up at random, the same ones in every run.

#include "app/cli/bench_cases.h"

#include "core/geometry/oversketch.h"
#include "core/session/session.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace oversketch::cli {
namespace {

constexpr int kStrokes = 4, kFrames = 8, kPins = 3;
/// Random edits that the curves refuse (a stroke that would cross the sketch) are drawn again, this often at most.
constexpr int kMostTries = 50;

std::string item_name(const BenchCase& c, int edit) {
  return c.given.name + "/" + std::to_string(edit);
}

DeformOptions drawn_options(const BenchCase& c) {
  DeformOptions options;
  options.cell_px = cell_for(c.given.outline, kDrawnVertices);
  return options;
}

Result<Deformation> edit(const BenchCase& c, const Points& sketch, std::span<const PinPair> pins,
                         const DeformOptions& options, const Deformation& warm, const Watch& watch) {
  DeformCounts counts;
  return c.drawn.deform(sketch, pins, options, &warm, counts, watch);
}

Error no_edit(const BenchCase& c) {
  return {"bench.no-edit", "the sketch takes none of the strokes that are tried", c.given.name};
}

/// A stroke that the sketch takes.
std::optional<Points> find_stroke(const BenchCase& c, const OversketchOptions& options, BenchRandom& random) {
  for (int i = 0; i < kMostTries; ++i) {
    Points stroke = draw_stroke(c.sketch, random);
    if (oversketch(c.sketch, stroke, options)) return stroke;
  }
  return std::nullopt;
}

/// Repeats an edit on the record, and takes down whether it matched the curves anew.
template <class Edit>
Result<void> repeat_edit(BenchRecord& record, const std::string& row, const std::string& item, int runs, Edit work) {
  bool matched = false;
  auto done = record.repeat(row, item, runs, [&]() -> Result<Deformation> {
    auto edited = work();
    matched = edited && edited->flipfree->matches > 0;
    return edited;
  });
  if (done) record.add_value(row + ".matches", item, matched ? 1 : 0);
  return done;
}

Result<void> run_oversketch(const BenchInput& input, BenchRecord& record) {
  std::uint32_t seed = 1;
  for (const BenchCase& c : input.cases) {
    BenchRandom random(seed++);
    OversketchOptions options;
    options.tolerance_px = 0.01 * c.sketch.length();
    for (int i = 0; i < kStrokes; ++i) {
      const auto stroke = find_stroke(c, options, random);
      if (!stroke) return no_edit(c);
      const auto done =
          repeat_edit(record, "deform.oversketch", item_name(c, i), input.runs, [&]() -> Result<Deformation> {
            const auto redrawn = oversketch(c.sketch, *stroke, options);
            if (!redrawn) return redrawn.error();
            return edit(c, redrawn->curve, {}, drawn_options(c), c.solved, input.watch);
          });
      if (!done) return done.error();
    }
  }
  return {};
}

/// The sketch while one of its points is dragged, frame by frame, without a crossing in any.
std::optional<std::vector<Points>> find_drag(const BenchCase& c, BenchRandom& random) {
  for (int i = 0; i < kMostTries; ++i) {
    const double s = random.between(0, c.sketch.length()), turn = random.between(0, 2 * std::numbers::pi);
    const Point way = 0.06 * c.sketch.length() * Point{std::cos(turn), std::sin(turn)};
    std::vector<Points> frames;
    for (int k = 1; k <= kFrames; ++k) {
      frames.push_back(drag_point(c.sketch, s, static_cast<double>(k) / kFrames * way));
      if (find_self_crossing(frames.back(), true)) break;
      if (k == kFrames) return frames;
    }
  }
  return std::nullopt;
}

Result<void> run_drag(const BenchInput& input, BenchRecord& record) {
  std::uint32_t seed = 1001;
  for (const BenchCase& c : input.cases) {
    BenchRandom random(seed++);
    const auto frames = find_drag(c, random);
    if (!frames) return no_edit(c);
    FlipfreeOptions options;
    options.most_steps = 2;
    for (int run = -1; run < input.runs; ++run) {
      FlipfreeSolution last = *c.solved.flipfree;
      for (std::size_t k = 0; k < frames->size(); ++k) {
        const Stopwatch stopwatch;
        auto next = solve_flipfree(c.flipfree, (*frames)[k], {}, options, &last, input.watch);
        if (!next) return at(c.given.name, next.error());
        const Points drawn = prolong(c.flipfree.region().mesh(), next->positions, c.display);
        const Spent spent = stopwatch.spent();
        const std::string item = item_name(c, static_cast<int>(k));
        if (run >= 0) record.add("deform.drag_frame", item, spent);
        if (run == 0) record.add_value("deform.drag_frame.matches", item, next->matches > 0 ? 1 : 0);
        last = std::move(*next);
      }
    }
  }
  return {};
}

/// A pin near where its point is already, and where it is moved then: 1…4 % of the sketch's length either way.
std::array<PinPair, 2> find_pin(const BenchCase& c, BenchRandom& random) {
  const auto count = static_cast<double>(c.given.outline.size());
  const auto i = static_cast<std::size_t>(random.between(0, count));
  const double s = c.sketch.nearest(c.solved.outline[i]).s;
  const double shift = random.sign() * random.between(0.01, 0.04) * c.sketch.length();
  return {PinPair{c.given.outline[i], c.sketch.at(s + shift)}, PinPair{c.given.outline[i], c.sketch.at(s)}};
}

Result<void> run_pin(const BenchInput& input, BenchRecord& record) {
  std::uint32_t seed = 2001;
  for (const BenchCase& c : input.cases) {
    BenchRandom random(seed++);
    for (int i = 0; i < kPins; ++i) {
      const auto pin = find_pin(c, random);
      const auto add = [&] {
        return edit(c, c.sketch.points(), std::span(&pin[0], 1), drawn_options(c), c.solved, input.watch);
      };
      auto done = repeat_edit(record, "deform.pin.add", item_name(c, i), input.runs, add);
      if (!done) return done.error();
      const auto added = add();
      if (!added) return at(c.given.name, added.error());
      done = repeat_edit(record, "deform.pin.move", item_name(c, i), input.runs, [&] {
        return edit(c, c.sketch.points(), std::span(&pin[1], 1), drawn_options(c), *added, input.watch);
      });
      if (!done) return done.error();
    }
  }
  return {};
}

/// A slider that is moved up, and down.
Result<void> run_weight(const BenchInput& input, BenchRecord& record, const std::string& row,
                        double DeformOptions::*weight, double factor) {
  for (const BenchCase& c : input.cases)
    for (const double by : {factor, 1 / factor}) {
      DeformOptions options = drawn_options(c);
      options.*weight *= by;
      const auto done = repeat_edit(record, row, item_name(c, by > 1 ? 1 : 0), input.runs,
                                    [&] { return edit(c, c.sketch.points(), {}, options, c.solved, input.watch); });
      if (!done) return done.error();
    }
  return {};
}

Result<void> run_follow(const BenchInput& input, BenchRecord& record) {
  return run_weight(input, record, "deform.follow", &DeformOptions::follow, 3);
}

Result<void> run_stiffness(const BenchInput& input, BenchRecord& record) {
  return run_weight(input, record, "deform.stiffness", &DeformOptions::stiffness, 3);
}

/// A document with the case as its layer; the outline is brought into its picture first.
Result<void> open_case(Session& session, const BenchCase& c, const Watch& watch) {
  const Box box = bounds(c.given.outline);
  const int width = static_cast<int>(std::ceil(box.size().x)) + 2,
            height = static_cast<int>(std::ceil(box.size().y)) + 2;
  const Similarity shift{1.0, to_complex(Point{1, 1} - box.low)};
  DocumentNew document;
  document.width = 2 * width;
  document.height = 2 * height;
  const ImageRef source{"bench", Image(Raster<Rgba>(width, height))};
  const std::vector<Command> commands = {document, LayerAdd{source, {}},
                                         RegionSet{{}, transformed(c.given.outline, shift)},
                                         SketchSet{{}, transformed(c.sketch.points(), shift)}};
  for (const Command& command : commands)
    if (auto done = session.execute(command, watch); !done) return done.error();
  return {};
}

std::int64_t count_work(const DeformCounts& counts) {
  return counts.meshings + counts.symbolic_factorizations + counts.numeric_factorizations + counts.matches;
}

Result<void> run_similar(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    Session session;
    if (auto opened = open_case(session, c, input.watch); !opened) return at(c.given.name, opened.error());
    const LayerId layer = session.document().layers.back().id;
    if (const auto first = session.deformation(layer, input.watch); !first) return at(c.given.name, first.error());
    const std::int64_t before = count_work(session.counters().deform);
    for (const Command& command :
         std::vector<Command>{LayerMove{{}, {1, -1}}, LayerTransform{{}, 1, 1, {}}, LayerTransform{{}, 0, 1.01, {}}}) {
      const int kind = static_cast<int>(command.index());
      const auto done = record.repeat("deform.similar", item_name(c, kind), input.runs,
                                      [&]() -> Result<std::shared_ptr<const Deformation>> {
                                        if (auto moved = session.execute(command, input.watch); !moved)
                                          return moved.error();
                                        return session.deformation(layer, input.watch);
                                      });
      if (!done) return done.error();
    }
    const auto work = static_cast<double>(count_work(session.counters().deform) - before);
    record.add_value("deform.similar.work", c.given.name, work);
  }
  return {};
}

} // namespace

std::vector<BenchGroup> edit_benches() {
  const auto worst = [](double most) { return BenchGoal{most, BenchStatistic::kWorst}; };
  const auto matches = [&](std::string_view name) {
    return BenchRow{std::string(name), "count", "  matched anew", worst(0), {}};
  };
  return {
      {{{"deform.oversketch", "ms", "a part of the sketch redrawn: merge and warm solve", {}, 5.5},
        matches("deform.oversketch.matches")},
       true,
       run_oversketch},
      {{{"deform.drag_frame", "ms", "a frame while a point of the sketch is dragged: two steps", worst(5), 5.2},
        matches("deform.drag_frame.matches")},
       true,
       run_drag},
      {{{"deform.pin.add", "ms", "a pin added near where its point was", worst(8), 8.3},
        matches("deform.pin.add.matches"),
        {"deform.pin.move", "ms", "a pin moved by 1 to 4 % of the sketch", worst(8), 8.3},
        matches("deform.pin.move.matches")},
       true,
       run_pin},
      {{{"deform.follow", "ms", "\"follow the sketch\" times or by 3", worst(8), 12.0},
        matches("deform.follow.matches")},
       true,
       run_follow},
      {{{"deform.stiffness", "ms", "stiffness times or by 3", worst(8), 12.0}, matches("deform.stiffness.matches")},
       true,
       run_stiffness},
      {{{"deform.similar", "ms", "a layer moved, turned, scaled", {}, 0.0},
        {"deform.similar.work", "count", "  meshings, matches and factorizations", worst(0), 0.0}},
       true,
       run_similar},
  };
}

} // namespace oversketch::cli
