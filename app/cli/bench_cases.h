#pragma once

#include "app/cli/bench_record.h"

#include "core/base/watch.h"
#include "core/deform/deformation.h"
#include "core/mesh/display_mesh.h"
#include "core/session/case_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace oversketch::cli {

/// A curve pair, made ready and solved once: what edits start from.
struct BenchCase {
  DeformCase given;
  /// The sketch cleaned, with points at most 1 % of its length apart, as a pen leaves them.
  ClosedCurve sketch;
  FlipfreeSystem flipfree;
  /// Of `drawn`.
  DisplayMesh display;
  /// Draws about kDrawnVertices vertices.
  DeformSystem drawn;
  /// To `sketch`, without pins.
  Deformation solved;
};

/// Vertices of the mesh that edits are drawn with, at least; at most twice as many.
inline constexpr double kDrawnVertices = 20'000;

/// The display cell that gives a region about that many vertices, px.
double cell_for(const Points& outline, double vertices);

struct BenchInput {
  std::vector<BenchCase> cases;
  /// Of each piece of work, after one to warm up.
  int runs = 5;
  Watch watch;
};

/// Rows that are measured together.
struct BenchGroup {
  std::vector<BenchRow> rows;
  /// Whether it reads BenchInput::cases.
  bool uses_cases = true;
  std::function<Result<void>(const BenchInput&, BenchRecord&)> run;
};

// One file each.
std::vector<BenchGroup> deform_benches();
std::vector<BenchGroup> edit_benches();
std::vector<BenchGroup> quality_benches();
std::vector<BenchGroup> paper_benches();
std::vector<BenchGroup> picture_benches();
std::vector<BenchGroup> membrane_benches();
std::vector<BenchGroup> warp_benches();
std::vector<BenchGroup> mixed_benches();
std::vector<BenchGroup> project_benches();

/// All *.json of a folder, by name, made ready.
/// @errors bench.no-cases; file.unreadable; those of read_case() and of the solver, with the file as the place.
Result<std::vector<BenchCase>> prepare_cases(const std::filesystem::path& folder, const Watch& watch);

/// The same numbers on every machine for the same seed.
class BenchRandom {
public:
  explicit BenchRandom(std::uint32_t seed) : engine_(seed) {}
  /// Evenly in [low, high).
  double between(double low, double high);
  /// −1 or 1.
  double sign();

private:
  std::mt19937 engine_;
};

/// An open stroke, as a hand draws it, that begins and ends on the curve and bulges from 10…35 % of it to one side.
Points draw_stroke(const ClosedCurve& curve, BenchRandom& random);

/// The curve with the points near one of them drawn along with it.
/// @param s      arc length of the point that is dragged; 6 % of the length on either side goes with it, less and less.
/// @param shift  where it is dragged, px.  All other points stay, to the bit.
Points drag_point(const ClosedCurve& curve, double s, Point shift);

} // namespace oversketch::cli
