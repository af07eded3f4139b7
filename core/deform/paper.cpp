#include "core/deform/paper.h"

#include "core/base/check.h"
#include "core/deform/match.h"
#include "core/deform/start.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace oversketch {
namespace {

/// Least area of a sketch as a part of the square on a quarter of its perimeter: below, its orientation means nothing.
constexpr double kLeastArea = 1e-3;
/// The paper's step against the gradient.
constexpr double kStep = 0.5;

/// E_d(w(h)) has the Hessian 2ω²(T − T²), 0 ≤ T ≤ 1, which is at most ω²/2: a step of 2/ω² or less never raises the
/// energy, and the paper's is one up to ω = 2.
double choose_step(double handle_weight) {
  return std::min(kStep, 2 / (handle_weight * handle_weight));
}

/// The paper's handles on their way along the sketch, which runs like the outline here.
struct Handles {
  ComplexVector h;
  std::vector<double> s;
  std::vector<bool> held;
};

/// A handle and the arc length on the sketch where it starts or is held.
struct Anchor {
  int handle = 0; // counts on past the loop's end
  double sketch_s = 0;
  int pin = 0;
};

Error pins_too_close(int first, int second) {
  const std::string one = std::to_string(first + 1), other = std::to_string(second + 1);
  return {
      "deform.pins-too-close",
      "pins P" + one + " and P" + other +
          " lie nearer to each other on the outline than two vertices of the mesh: choose a smaller cell, or remove "
          "one of them",
      "pins " + one + " and " + other};
}

Result<void> check_input(const ClosedCurve& sketch, std::span<const PinPair> pins, const PaperOptions& options) {
  if (options.iterations < 0 || options.iterations > kMostPaperIterations) {
    return Error{"deform.iterations", "the number of iterations must be from 0 to 100000", ""};
  }
  const double side = sketch.length() / 4;
  if (!(std::abs(sketch.signed_area()) >= kLeastArea * side * side)) {
    return Error{"sketch.no-area", "the sketch encloses no area to speak of: draw a wider closed line", "sketch"};
  }
  for (std::size_t i = 0; i < pins.size(); ++i) {
    if (is_finite(pins[i].outline) && is_finite(pins[i].sketch)) continue;
    return Error{"deform.pin-not-finite", "a pin has a coordinate that is not a finite number",
                 "pin " + std::to_string(i + 1)};
  }
  return {};
}

/// The same curve from the same point, the other way round.
ClosedCurve reversed(const ClosedCurve& curve) {
  Points points = curve.points();
  std::reverse(points.begin() + 1, points.end());
  return ClosedCurve(std::move(points));
}

/// The pins by handle, in order round the loop.
Result<std::vector<Anchor>> anchor_pins(const PaperSystem& system, const ClosedCurve& sketch,
                                        std::span<const PinPair> pins) {
  const ClosedCurve& outline = system.region().outline();
  const auto places = place_pins(outline, sketch, pins);
  if (!places) return places.error();
  std::vector<Anchor> anchors;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const PinPlace& place = (*places)[i];
    const double at = std::round(system.boundary_map().place_at(place.outline_s));
    anchors.push_back({static_cast<int>(at), place.sketch_s, static_cast<int>(i)});
  }
  std::sort(anchors.begin(), anchors.end(),
            [&](const Anchor& a, const Anchor& b) { return (*places)[a.pin].outline_s < (*places)[b.pin].outline_s; });
  // A pin given twice is one pin; two pins at one vertex are not.
  const int loop = system.boundary_map().loop_size();
  std::vector<Anchor> kept;
  for (const Anchor& anchor : anchors) {
    const Anchor* rival = nullptr;
    if (!kept.empty() && kept.back().handle == anchor.handle) rival = &kept.back();
    if (!kept.empty() && kept.front().handle + loop == anchor.handle) rival = &kept.front();
    if (!rival) {
      kept.push_back(anchor);
    } else if (rival->sketch_s != anchor.sketch_s) {
      return pins_too_close(std::min(rival->pin, anchor.pin), std::max(rival->pin, anchor.pin));
    }
  }
  return kept;
}

/// By arc length from each anchor to the next one round the loop; a lone one fixes the shift alone.
Handles spread(const ClosedCurve& sketch, const std::vector<Anchor>& anchors, int count) {
  Handles out{ComplexVector(count), std::vector<double>(count), std::vector<bool>(count)};
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    const Anchor& from = anchors[k];
    const bool last = k + 1 == anchors.size();
    const Anchor& to = anchors[last ? 0 : k + 1];
    const int steps = to.handle - from.handle + (last ? count : 0);
    const double along = anchors.size() == 1 ? sketch.length() : sketch.forward(from.sketch_s, to.sketch_s);
    for (int i = 0; i < steps; ++i) {
      const int handle = (((from.handle + i) % count) + count) % count;
      out.s[handle] = sketch.wrap(from.sketch_s + along * i / steps);
      out.h[handle] = to_complex(sketch.at(out.s[handle]));
    }
  }
  return out;
}

Points deformed_loop(const PaperSystem& system, const Points& positions) {
  Points loop;
  for (const int vertex : system.region().boundary())
    loop.push_back(positions[vertex]);
  return loop;
}

/// Boundary edges are all one cell long, so that places of the loop are arc length.
Anchor choose_anchor(const PaperSystem& system, const ClosedCurve& sketch, const PaperOptions& options,
                     bool sketch_reversed) {
  if (!options.start) {
    const ClosedCurve loop(deformed_loop(system, system.region().mesh().vertices));
    return {0, choose_start(loop, sketch), -1};
  }
  const double along = sketch_reversed ? -options.start->sketch_s : options.start->sketch_s;
  const double place = system.boundary_map().place_at(options.start->outline_s);
  const int handle = static_cast<int>(std::floor(place));
  return {handle, sketch.wrap(along - (place - handle) * sketch.length() / system.boundary_map().loop_size()), -1};
}

Result<Handles> start_handles(const PaperSystem& system, const ClosedCurve& sketch, std::span<const PinPair> pins,
                              const PaperOptions& options, bool sketch_reversed) {
  const int count = system.handles().handle_count();
  if (pins.empty()) return spread(sketch, {choose_anchor(system, sketch, options, sketch_reversed)}, count);
  const auto anchors = anchor_pins(system, sketch, pins);
  if (!anchors) return anchors.error();
  Handles out = spread(sketch, *anchors, count);
  for (const Anchor& anchor : *anchors)
    out.held[((anchor.handle % count) + count) % count] = true;
  return out;
}

void descend(Handles& handles, double step, const ComplexVector& gradient, const ClosedCurve& sketch) {
  for (std::size_t i = 0; i < handles.s.size(); ++i) {
    if (handles.held[i]) continue;
    const CurvePosition nearest = sketch.nearest(to_point(handles.h[i] - step * gradient[i]));
    handles.h[i] = to_complex(nearest.point);
    handles.s[i] = nearest.s;
  }
}

Points to_points(const ComplexVector& z) {
  Points out(static_cast<std::size_t>(z.size()));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = to_point(z[i]);
  return out;
}

/// From `a` to `b` the short way round, px.
double way(const ClosedCurve& curve, double a, double b) {
  const double forward = curve.forward(a, b);
  return forward <= curve.length() / 2 ? forward : forward - curve.length();
}

void describe_outline(const PaperSystem& system, const ClosedCurve& sketch, const Handles& handles,
                      PaperSolution& out) {
  const RegionMesh& region = system.region();
  const int count = static_cast<int>(handles.s.size());
  for (int i = 0; i < count; ++i) {
    if (!(way(sketch, handles.s[i], handles.s[(i + 1) % count]) > 0)) ++out.order_violations;
  }
  for (int i = 0; i < region.outline().size(); ++i) {
    const double s = region.outline().s_at(i);
    out.outline.push_back(locate(region.mesh(), out.positions, region.locate_outline(s)));
    const double place = system.boundary_map().place_at(s), below = std::floor(place);
    const int from = ((static_cast<int>(below) % count) + count) % count, to = (from + 1) % count;
    const double along = handles.s[from] + (place - below) * way(sketch, handles.s[from], handles.s[to]);
    out.correspondence.push_back(sketch.wrap(out.sketch_reversed ? -along : along) / sketch.length());
  }
}

} // namespace

PaperSystem::PaperSystem(std::shared_ptr<const RegionMesh> region, std::shared_ptr<const BoundaryMap> map,
                         HandleSystem handles)
    : region_(std::move(region)), map_(std::move(map)), handles_(std::move(handles)) {}

Result<PaperSystem> PaperSystem::make(std::shared_ptr<const RegionMesh> region, double handle_weight,
                                      const Watch& watch) {
  CHECK(region, "a region to deform");
  auto handles = HandleSystem::make(region->mesh(), region->boundary(), handle_weight, watch);
  if (!handles) return handles.error();
  const StageTimer timer(watch.times, "matrix");
  auto map = std::make_shared<const BoundaryMap>(*region);
  return PaperSystem(std::move(region), std::move(map), *std::move(handles));
}

Result<PaperSystem> PaperSystem::with_handle_weight(double handle_weight, const Watch& watch) const {
  auto handles = handles_.with_handle_weight(handle_weight, watch);
  if (!handles) return handles.error();
  return PaperSystem(region_, map_, *std::move(handles));
}

Result<PaperSolution> solve_paper(const PaperSystem& system, const ClosedCurve& sketch, std::span<const PinPair> pins,
                                  const PaperOptions& options, const Watch& watch) {
  if (const auto fine = check_input(sketch, pins, options); !fine) return fine.error();
  PaperSolution out;
  out.sketch_reversed = (sketch.signed_area() > 0) != (system.region().outline().signed_area() > 0);
  const ClosedCurve gamma = out.sketch_reversed ? reversed(sketch) : sketch;
  StageTimer start_timer(watch.times, "start");
  Result<Handles> started = start_handles(system, gamma, pins, options, out.sketch_reversed);
  start_timer.stop();
  if (!started) return started.error();
  Handles handles = *std::move(started);

  const StageTimer timer(watch.times, "iterations");
  const double step = choose_step(system.handles().handle_weight());
  for (int iteration = 0;; ++iteration) {
    if (watch.stopped()) return cancelled();
    watch.report(static_cast<double>(iteration) / (options.iterations + 1), "iterations");
    const HandleSystem::Slope now = system.handles().slope(handles.h);
    out.energies.push_back(now.energy);
    const bool last = iteration == options.iterations;
    if (last || options.keep_iterates) out.positions = to_points(system.handles().place(handles.h));
    if (options.keep_iterates) {
      out.iterates.push_back({out.positions, to_points(handles.h), to_points(now.gradient), now.energy});
    }
    if (last) {
      out.gradients = to_points(now.gradient);
      break;
    }
    descend(handles, step, now.gradient, gamma);
  }
  out.handles = to_points(handles.h);
  describe_outline(system, gamma, handles, out);
  for (const double s : handles.s)
    out.handle_s.push_back(sketch.wrap(out.sketch_reversed ? -s : s));
  out.boundary = deformed_loop(system, out.positions);
  return out;
}

} // namespace oversketch
