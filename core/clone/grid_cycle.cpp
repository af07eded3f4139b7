#include "core/clone/grid_cycle.h"

#include <algorithm>

namespace oversketch {
namespace {

constexpr std::size_t kC = kGridChannels;
/// Slots are read as four floats: what follows the last one is nobody else's, for another thread may be writing there.
constexpr std::size_t kBeyond = 1;

/// Of a last grid that is too large for a factor.  Then one of every four nodes in a square is missing, all over, and a
/// sweep halves the error.
constexpr int kLastSweeps = 4;

/// How much further than to its neighbours' mean a colour goes between two cycles.  Halves the worst error at no cost
/// (Yavneh 1996, On red-black SOR smoothing in multigrid; 1.1 to 1.5 were tried).
constexpr float kFurther = 1.4F;

std::size_t size_of(const GridLevel& level) {
  return kC * static_cast<std::size_t>(level.count()) + kBeyond;
}

RowStage relaxing(int lag, int colour) {
  return {lag, [colour](GridRows& rows, int row) { rows.relax(row, colour); }};
}

RowStage relaxing_from_zero(int lag, int colour) {
  return {lag, [colour](GridRows& rows, int row) { rows.relax_from_zero(row, colour); }};
}

/// Hands the residual down, by GridRows::restrict_to or one of its kind.
template <class Restrict>
RowStage restriction(int lag, const GridLevel& fine, const GridLevel& coarse, float* coarse_b, Restrict restrict_row) {
  return {lag, [&fine, &coarse, coarse_b, restrict_row](GridRows& rows, int row) {
            const int y = fine.y_of(row) - fine.coarse_y;
            const int coarse_row = (y & 1) == 0 ? coarse.find_row(y >> 1) : -1;
            if (coarse_row >= 0) (rows.*restrict_row)(coarse, coarse_row, coarse_b);
          }};
}

} // namespace

GridCycle::GridCycle(const GridStack& grids) : grids_(grids) {
  std::size_t total = 0;
  for (const GridLevel& level : grids_.levels)
    total += 2 * size_of(level);
  memory_.resize(total);
  float* at = memory_.data();
  for (const GridLevel& level : grids_.levels) {
    const std::size_t size = size_of(level);
    values_.push_back({at, at + size, false});
    at += 2 * size;
  }
}

void GridCycle::run(std::size_t l, const RowPass& pass) {
  run_pass(level(l), values_[l], kernels_, grids_.zeros, pass, threads);
}

RowPass GridCycle::down(std::size_t l, From from) {
  const int colour = level(l).coarse_colour();
  RowPass pass;
  const auto add_restriction = [&](int lag, auto restrict_row) {
    pass.stages.push_back(restriction(lag, level(l), level(l + 1), values_[l + 1].b, restrict_row));
  };
  switch (from) {
  case From::kSide:
    add_restriction(2, &GridRows::restrict_side_to);
    pass.needed.u = false;
    return pass;
  case From::kHalf:
    pass.stages.push_back(relaxing_from_zero(0, 1 - colour));
    add_restriction(2, &GridRows::restrict_half_to);
    return pass;
  default:
    pass.stages.push_back(from == From::kZero ? relaxing_from_zero(0, colour) : relaxing(0, colour));
    pass.stages.push_back(relaxing(1, 1 - colour));
    add_restriction(3, &GridRows::restrict_to);
    return pass;
  }
}

RowPass GridCycle::up(std::size_t l, From from, To to, float factor) {
  const GridLevel& coarse = level(l + 1);
  const float* const u = values_[l + 1].u;
  const int colour = level(l).coarse_colour(), other = 1 - colour;
  RowPass pass;
  std::vector<RowStage>& stages = pass.stages;
  stages.push_back({0, [&coarse, u, factor](GridRows& rows, int row) { rows.inject(row, coarse, u, factor); }});
  if (from == From::kSide)
    stages.push_back({1, [](GridRows& rows, int row) { rows.correct_from_side(row); }});
  else
    stages.push_back({1, [](GridRows& rows, int row) { rows.correct(row); }});
  stages.push_back(relaxing(2, colour));
  if (to == To::kHalfSweep) {
    pass.needed.all_b = from == From::kSide;
    return pass;
  }
  if (to == To::kNext && !is_tricky())
    stages.push_back({3, [other](GridRows& rows, int row) { rows.overrelax(row, other, kFurther); }});
  else
    stages.push_back(relaxing(3, other));
  if (to == To::kSweep) return pass;
  stages.push_back(relaxing(4, colour));
  stages.push_back(relaxing(5, other));
  stages.push_back(restriction(7, level(l), coarse, values_[l + 1].b, &GridRows::restrict_to));
  return pass;
}

void GridCycle::solve_last(bool from_zero) {
  const std::size_t l = grids_.last();
  if (grids_.coarsest) return grids_.coarsest->solve(values_[l].b, values_[l].u);
  const int colour = level(l).coarse_colour();
  for (int sweep = 0; sweep < kLastSweeps; ++sweep) {
    RowPass pass;
    pass.stages.push_back(from_zero && sweep == 0 ? relaxing_from_zero(0, colour) : relaxing(0, colour));
    pass.stages.push_back(relaxing(1, 1 - colour));
    run(l, pass);
  }
}

void GridCycle::visit(std::size_t l, bool twice) {
  if (l == grids_.last()) return solve_last(true);
  const bool again = twice || is_slow || grids_.is_tricky[l + 1] != 0;
  // The second cycle makes up for what half a sweep leaves.
  const From from = twice ? From::kHalf : From::kZero;
  run(l, down(l, from));
  visit(l + 1);
  run(l, up(l, from, again ? To::kNext : To::kSweep));
  if (!again) return;
  visit(l + 1);
  run(l, up(l, From::kValues, To::kSweep));
}

double GridCycle::largest_correction() const {
  return kernels_.largest(values_[1].u, kC * static_cast<std::size_t>(level(1).count()));
}

double GridCycle::largest_residual() const {
  GridRows rows(level(0), values_[0], kernels_, grids_.zeros);
  float largest = 0;
  for (int row = 0; row < level(0).rows(); ++row)
    largest = std::max(largest, rows.largest_residual(row));
  return largest;
}

std::int64_t GridCycle::bytes() const {
  return static_cast<std::int64_t>(memory_.size() * sizeof(float));
}

} // namespace oversketch
