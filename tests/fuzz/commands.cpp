// Sequences of commands, undo and redo, as a person's hand makes them, on small pictures.

#include "core/document/command_table.h"

#include "tests/fuzz/documents.h"

#include <array>
#include <numbers>
#include <string>

namespace oversketch::fuzz {
namespace {

constexpr int kWidth = 64, kHeight = 48;

Point read_point(Input& in) {
  return {in.real(-8, kWidth + 8), in.real(-8, kHeight + 8)};
}

/// Closed round a middle, or a stroke along a part of such a curve, or points anywhere.
Points read_curve(Input& in, double sweep) {
  const int kind = in.below(4), count = 3 + in.below(20);
  Points points;
  if (kind == 0) {
    for (int i = 0; i < count; ++i)
      points.push_back(read_point(in));
    return points;
  }
  const Point middle{in.real(20, kWidth - 20), in.real(16, kHeight - 16)};
  const double from = in.real(0, 6.3), radius = in.real(3, 24), uneven = kind == 1 ? 0 : in.real(0, 0.5);
  for (int i = 0; i < count; ++i) {
    const double angle = from + sweep * i / count;
    points.push_back(middle + radius * (1 - uneven * in.real(0, 1)) * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

/// Up to three letters of one to four bytes each, and what JSON has to escape.
std::string read_name(Input& in) {
  std::string name;
  for (int i = in.below(4); i > 0; --i)
    name += std::array{
        "a", "\"", "\\", "\n", "\x7f", "\u00f6", "\u2260", "\U0001f41f"}[static_cast<std::size_t>(in.below(8))];
  return name;
}

LayerRef read_layer(Input& in) {
  const int number = in.below(6);
  return number < 3 ? LayerRef() : LayerRef(LayerId{number - 2});
}

ImageRef read_picture(Input& in) {
  const int kind = in.below(5);
  if (kind == 4) return {std::string(kTargetName), std::nullopt};
  return {"picture" + std::to_string(kind), striped_image(kWidth - 9 * kind, kHeight + 5 * kind, kind)};
}

LayerSet read_settings(Input& in) {
  LayerSet set;
  set.layer = read_layer(in);
  const int which = in.byte();
  if (which & 1) set.method = static_cast<DeformMethod>(in.below(3));
  if (which & 2) set.cell_px = in.real(0, 30);
  if (which & 4) set.stiffness = in.real(0, 3), set.follow = in.real(0, 60);
  if (which & 8) set.handle_weight = in.real(0, 4), set.iterations = in.below(6);
  if (which & 16) set.mode = static_cast<CloneMode>(in.below(5)), set.domain = static_cast<CloneDomain>(in.below(3));
  if (which & 32) set.strength = in.real(-0.1, 1), set.opacity = in.real(0, 1);
  if (which & 64) set.feather_px = in.real(0, 20), set.screening = in.real(0, 40);
  if (which & 128) set.visible = in.chance(), set.sampling = static_cast<WarpSampling>(in.below(2));
  return set;
}

template <class Edit>
Edit read_edit(Input& in) {
  Edit edit;
  edit.layer = read_layer(in);
  edit.stroke = read_curve(in, in.real(0.2, 5));
  edit.side = in.chance() ? StrokeSide::kOther : StrokeSide::kAuto;
  edit.tolerance_px = in.real(0, 30);
  edit.sharp = in.chance();
  return edit;
}

Command read_command(Input& in) {
  constexpr double kRound = 2 * std::numbers::pi;
  switch (in.below(20)) {
  case 0:
    return TargetSet{read_picture(in)};
  case 1:
  case 2:
    return LayerAdd{read_picture(in), in.chance() ? std::optional(read_name(in)) : std::nullopt};
  case 3:
    return LayerRemove{read_layer(in)};
  case 4:
    return LayerSelect{read_layer(in)};
  case 5:
    return LayerRename{read_layer(in), read_name(in)};
  case 6:
    return LayerOrder{read_layer(in), in.below(5)};
  case 7:
  case 8:
    return RegionSet{read_layer(in), read_curve(in, kRound)};
  case 9:
    return SketchSet{read_layer(in), read_curve(in, in.chance() ? kRound : -kRound)};
  case 10:
    return SketchReset{read_layer(in)};
  case 11:
    return PinAdd{read_layer(in), read_point(in), read_point(in)};
  case 12:
    return PinMove{read_layer(in),
                   {1 + in.below(5)},
                   in.chance() ? std::optional(read_point(in)) : std::nullopt,
                   in.chance() ? std::optional(read_point(in)) : std::nullopt};
  case 13:
    return PinRemove{read_layer(in), {1 + in.below(5)}};
  case 14:
    return LayerMove{read_layer(in), {in.below(101) - 50, in.below(101) - 50}};
  case 15:
    return LayerTransform{read_layer(in), in.real(-180, 180), in.real(0.05, 3),
                          in.chance() ? std::optional(read_point(in)) : std::nullopt};
  case 16:
    return read_edit<RegionEdit>(in);
  case 17:
  case 18:
    return read_edit<SketchEdit>(in);
  default:
    return read_settings(in);
  }
}

void check_printing(const Command& command) {
  const std::string line = print_command(command);
  const auto read = parse_command(line);
  MUST_HOLD(read.ok(), "what is printed can be read: " + line);
  MUST_HOLD(*read == command, "what is read is what was printed: " + line);
}

/// One step; documents, not solves, when `fast`.
void step(Input& in, Session& session, History& fast, bool is_fast) {
  const int kind = in.below(16);
  if (kind < 2) {
    const auto steps = static_cast<std::size_t>(1 + in.below(3));
    (void)(is_fast ? fast.undo(steps) : session.undo(steps)).ok();
  } else if (kind == 2) {
    (void)(is_fast ? fast.redo() : session.redo()).ok();
  } else {
    const Command command = read_command(in);
    check_printing(command);
    (void)(is_fast ? fast.execute(command) : session.execute(command)).ok();
  }
}

void run(Input in) {
  Session session;
  // Layers can be scaled without bounds.
  session.limit_memory(std::size_t{256} << 20);
  History history;
  // Every fourth input is solved and painted as well, which costs a hundred times as much.
  const bool fast = in.below(4) != 0;
  DocumentNew begin;
  begin.target = ImageRef{"target", striped_image(kWidth, kHeight, 3)};
  MUST_HOLD(fast ? history.execute(begin).ok() : session.execute(begin).ok(), "a document begins");
  for (int i = 0; i < (fast ? 40 : 12) && !in.empty(); ++i)
    step(in, session, history, fast);
  for (const History::Entry& entry : history.entries())
    check_document(entry.document);
  if (fast) return;
  check_session(session);
  for (const Layer& layer : session.document().layers) {
    const auto metrics = session.metrics(layer.id);
    MUST_HOLD(!metrics || layer.settings.method != DeformMethod::kFlipfree || metrics->distortion.flipped_cells == 0,
              "no cell flips");
  }
  const auto picture = session.composite();
  MUST_HOLD(!picture || picture->rect() == session.document().target.image.rect(), "as large as the target");
}

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  oversketch::fuzz::run({data, size});
  return 0;
}
