#include "core/deform/flipfree_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oversketch {
namespace {

/// Weight of a handle's distance along the curve beside that across it: over random bends 0.02 leaves 1 % more distance
/// from the truth, 0.05 little less but more distortion and more steps.
constexpr double kAlongWeight = 0.04;
/// Longest slide at a time, cells.
constexpr double kLongestSlide = 0.7;
constexpr int kSlides = 3;
/// What a slide may cost, part of the energy.
constexpr double kSlideRise = 0.02;
/// Untangling ends when every D is above this.
constexpr double kUntangled = 1e-3;
/// Steps after which untangling is given up: the safe way from a similarity is then the shorter one.
constexpr int kTangledSteps = 8;
constexpr double kArmijo = 1e-4;
constexpr int kHalvings = 30;
/// ε beside the worst D while untangling, and its least value.
constexpr double kEpsilonPart = 0.2;
constexpr double kLeastEpsilon = 0.02;

class Stepper {
public:
  Stepper(const SlideProblem& problem, const SlideStage& stage, SlideState& state, SlideReport& report,
          BlockCholesky& hessian)
      : problem_(problem), stage_(stage), state_(state), report_(report), hessian_(hessian) {}

  void begin() {
    place_handles(problem_.curve, 1.0, state_.places);
    set_epsilon();
    energy_ = value(state_.positions, state_.places);
  }

  double energy() const { return energy_; }
  bool tangled() const { return weights_.epsilon > 0; }
  double floor() const { return (2 + 2 * problem_.stiffness) * problem_.distortion.total_weight(); }

  /// One Newton step and its slide; false when no step lowers the energy.
  bool step() {
    set_epsilon();
    if (tangled()) energy_ = value(state_.positions, state_.places);
    const Points direction = find_direction();
    if (direction.empty() || !move_along(direction)) return false;
    slide();
    ++report_.steps;
    report_.energies.push_back(energy_);
    return true;
  }

private:
  void set_epsilon() {
    weights_.stiffness = problem_.stiffness;
    const double least = problem_.distortion.least_determinant(state_.positions);
    state_.untangled = least > kUntangled || (least > 0 && state_.untangled);
    weights_.epsilon = state_.untangled ? 0.0 : std::max(kLeastEpsilon, kEpsilonPart * std::abs(least));
  }

  Point handle_position(const Points& x, std::size_t i) const {
    const MeshTie& tie = problem_.handles[i].tie;
    const auto& c = problem_.distortion.cell(tie.cell);
    Point sum;
    for (std::size_t k = 0; k < 4; ++k)
      sum += tie.weights[k] * x[c[k]];
    return sum;
  }

  /// Weights across and along the curve.
  std::pair<double, double> handle_weights(std::size_t i) const {
    const double across = stage_.follow * problem_.handles[i].span;
    if (problem_.handles[i].pinned) return {stage_.pin_factor * across, stage_.pin_factor * across};
    return {across, kAlongWeight * across + problem_.handles[i].span * problem_.holds[i]};
  }

  double value(const Points& x, const HandlePlaces& places) const {
    double sum = problem_.distortion.value(x, weights_);
    for (std::size_t i = 0; i < problem_.handles.size(); ++i) {
      const auto [across, along] = handle_weights(i);
      const Point d = handle_position(x, i) - places.points[i], t = places.tangents[i];
      const double n_d = cross(t, d), t_d = dot(t, d);
      const double strayed = places.s[i] - problem_.anchors[i];
      sum += across * n_d * n_d + along * t_d * t_d + problem_.handles[i].span * problem_.holds[i] * strayed * strayed;
    }
    return sum;
  }

  void add_handles(Points& gradient) {
    for (std::size_t i = 0; i < problem_.handles.size(); ++i) {
      const auto [across, along] = handle_weights(i);
      const Point t = state_.places.tangents[i], d = handle_position(state_.positions, i) - state_.places.points[i];
      const std::array<double, 3> q{2 * (across * t.y * t.y + along * t.x * t.x), 2 * (along - across) * t.x * t.y,
                                    2 * (across * t.x * t.x + along * t.y * t.y)};
      const Point force{q[0] * d.x + q[1] * d.y, q[1] * d.x + q[2] * d.y};
      const MeshTie& tie = problem_.handles[i].tie;
      const auto& c = problem_.distortion.cell(tie.cell);
      for (std::size_t k = 0; k < 4; ++k)
        gradient[c[k]] += tie.weights[k] * force;
      problem_.distortion.add_to_cell(tie.cell, tie.weights, q, hessian_);
    }
  }

  /// −H⁻¹ g; `slope_` becomes its product with the gradient.  Empty where the matrix is not positive definite.
  Points find_direction() {
    Points gradient(state_.positions.size());
    hessian_.clear();
    problem_.distortion.add_derivatives(state_.positions, weights_, gradient, hessian_);
    add_handles(gradient);
    ++report_.factorizations;
    if (!hessian_.factor()) return {};
    Points direction = gradient;
    hessian_.solve(direction);
    slope_ = 0;
    for (std::size_t i = 0; i < direction.size(); ++i) {
      direction[i] = -direction[i];
      slope_ += dot(direction[i], gradient[i]);
    }
    return direction;
  }

  bool move_along(const Points& direction) {
    if (!(slope_ < 0)) return false;
    double t = tangled() ? 1.0 : problem_.distortion.longest_step(state_.positions, direction);
    Points x(direction.size());
    for (int k = 0; k < kHalvings; ++k, t *= 0.5) {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = state_.positions[i] + t * direction[i];
      const double e = value(x, state_.places);
      if (!(e <= energy_ + kArmijo * t * slope_)) continue;
      energy_ = e;
      state_.positions = std::move(x);
      return true;
    }
    return false;
  }

  void slide() {
    HandlePlaces moved = state_.places;
    for (int k = 0; k < kSlides; ++k) {
      for (std::size_t i = 0; i < moved.s.size(); ++i) {
        if (problem_.handles[i].pinned) continue;
        const Point d = handle_position(state_.positions, i) - moved.points[i];
        const auto [across, along] = handle_weights(i);
        const double hold = problem_.handles[i].span * problem_.holds[i];
        const double wish = along * dot(moved.tangents[i], d) + hold * (problem_.anchors[i] - moved.s[i]);
        moved.s[i] += std::clamp(wish / (along + hold), -kLongestSlide, kLongestSlide);
      }
      order_handles(moved.s, problem_.handles, problem_.curve.length());
      place_handles(problem_.curve, 1.0, moved);
    }
    const double e = value(state_.positions, moved);
    if (!(e <= (1 + kSlideRise) * energy_)) return;
    energy_ = e;
    state_.places = std::move(moved);
  }

  const SlideProblem& problem_;
  const SlideStage& stage_;
  SlideState& state_;
  SlideReport& report_;
  BlockCholesky& hessian_;
  DistortionEnergy::Weights weights_;
  double energy_ = 0;
  double slope_ = 0;
};

} // namespace

bool run_stage(const SlideProblem& problem, const SlideStage& stage, SlideState& state, SlideReport& report,
               BlockCholesky& hessian, const Watch& watch) {
  Stepper stepper(problem, stage, state, report, hessian);
  stepper.begin();
  int tangled_steps = 0;
  for (int k = 0; k < stage.most_steps; ++k) {
    if (watch.stopped()) return false;
    const double before = stepper.energy();
    const bool was_tangled = stepper.tangled();
    if (!stepper.step()) break;
    if (was_tangled && ++tangled_steps > kTangledSteps) break;
    if (was_tangled) continue;
    const double gained = before - stepper.energy(), floor = stepper.floor();
    if (gained < stage.gain * (stepper.energy() - floor) + stage.floor_gain * floor) break;
  }
  return true;
}

} // namespace oversketch
