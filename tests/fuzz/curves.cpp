// Two closed curves, pins and options into the matcher and the solvers.

#include "core/deform/deformation.h"

#include "tests/fuzz/fuzz.h"

#include <cmath>
#include <numbers>

namespace oversketch::fuzz {
namespace {

/// Side of the square that outlines lie in, px.
constexpr double kSize = 200;

/// A closed curve of 3 to 66 points in one of three ways: round a centre, step by step, or anywhere.
Points read_curve(Input& in, double size) {
  const int kind = in.below(3), count = 3 + in.below(64);
  Points points;
  Point pen{size / 2, size / 2};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    if (kind == 0)
      points.push_back(Point{size / 2, size / 2} + in.real(0.05, 0.5) * size * Point{std::cos(angle), std::sin(angle)});
    else if (kind == 1)
      points.push_back(pen += size / 16 * Point{in.real(-1, 1), in.real(-1, 1)});
    else
      points.push_back({in.fine(0, size), in.fine(0, size)});
  }
  return points;
}

bool is_finite_all(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](Point p) { return is_finite(p); });
}

/// Increasing but for one wrap: at most one step down.
bool goes_round(const std::vector<double>& s) {
  int drops = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    drops += s[(i + 1) % s.size()] < s[i] ? 1 : 0;
  return drops <= 1;
}

void check(const Deformation& d, const Points& outline, const Points& sketch, Method method) {
  MUST_HOLD(is_finite_all(d.positions) && is_finite_all(d.boundary), "positions are numbers");
  MUST_HOLD(d.positions.size() == d.mesh->vertices.size(), "a place for each vertex");
  MUST_HOLD(d.outline.size() == outline.size() && d.correspondence.size() == outline.size(), "one for each point");
  for (const double s : d.correspondence)
    MUST_HOLD(s >= 0 && s < 1, "a part of the sketch's length");
  if (method != Method::kFlipfree) return;
  MUST_HOLD(goes_round(d.correspondence), "the correspondence goes round once");
  MUST_HOLD(d.order_violations == 0, "handles stay in order");
  MUST_HOLD(d.flipped_control_cells == 0, "no control cell flips");
  MUST_HOLD(measure(d, ClosedCurve(sketch), {}).distortion.flipped_cells == 0, "no drawn cell flips");
}

std::vector<PinPair> read_pins(Input& in, double size) {
  std::vector<PinPair> pins;
  for (int i = in.below(8); i < 3; ++i)
    pins.push_back({{in.real(0, size), in.real(0, size)}, {in.real(0, size), in.real(0, size)}});
  return pins;
}

/// The flip-free solver on a mesh of few cells, from nothing and then from what it found.
void solve_coarse(Input& in, const Points& given) {
  const ClosedCurve outline(given);
  const auto mesh = make_region_mesh(outline, in.real(2, 5) * choose_control_cell(outline), MeshKind::kCovering);
  if (!mesh) return;
  const auto system = FlipfreeSystem::make(outline, *mesh);
  if (!system) return;
  FlipfreeOptions options;
  options.stiffness = std::pow(10, in.real(-3, 3));
  options.follow = std::pow(10, in.real(-2, 4));
  std::optional<FlipfreeSolution> last;
  for (int round = 0; round < 2; ++round) {
    const Points sketch = read_curve(in, kSize * in.real(0.3, 2));
    const auto pins = read_pins(in, kSize);
    auto solved = solve_flipfree(*system, sketch, pins, options, last ? &*last : nullptr);
    if (!solved) continue;
    MUST_HOLD(is_finite_all(solved->positions) && is_finite_all(solved->outline), "positions are numbers");
    MUST_HOLD(solved->flipped == 0, "no control cell flips");
    MUST_HOLD(solved->order_violations == 0 && goes_round(solved->correspondence), "handles stay in order");
    for (std::size_t i = 1; i < solved->handle_sketch_s.size(); ++i)
      MUST_HOLD(solved->handle_sketch_s[i] > solved->handle_sketch_s[i - 1], "handles increase strictly");
    last = std::move(*solved);
  }
}

/// Any method, with the mesh that is drawn.
void solve_drawn(Input& in, const Points& outline) {
  DeformOptions options;
  const int method = in.below(4);
  options.method = method == 0 ? Method::kPaper : method == 1 ? Method::kInitial : Method::kFlipfree;
  options.cell_px = in.real(12, 40);
  options.stiffness = std::pow(10, in.real(-3, 3));
  options.follow = std::pow(10, in.real(-2, 4));
  options.handle_weight = std::pow(10, in.real(-2, 2));
  options.iterations = in.below(6);
  DeformCounts counts;
  const auto system = DeformSystem::make(outline, options, nullptr, counts, {});
  if (!system) return;
  const Points sketch = read_curve(in, kSize * in.real(0.3, 2));
  const auto deformed = system->deform(sketch, read_pins(in, kSize), options, nullptr, counts, {});
  if (deformed) check(*deformed, outline, sketch, options.method);
}

void run(Input in) {
  const bool drawn = in.below(8) == 0;
  const auto outline = check_closed_curve(read_curve(in, kSize), "outline");
  if (!outline) return;
  if (drawn)
    solve_drawn(in, *outline);
  else
    solve_coarse(in, *outline);
}

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  oversketch::fuzz::run({data, size});
  return 0;
}
