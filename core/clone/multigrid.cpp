#include "core/clone/multigrid.h"

#include "core/base/bulk_allocator.h"
#include "core/base/check.h"
#include "core/clone/coarsest_grid.h"
#include "core/clone/grid_level.h"
#include "core/clone/grid_pass.h"
#include "core/clone/pixel_planes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {
namespace {

constexpr std::size_t kC = kGridChannels;
/// Slots are read as four floats: what follows the last one is nobody else's, for another thread may be writing there.
constexpr std::size_t kBeyond = 1;

/// Few enough to be factored: a substitution then costs less than a cycle on them.
constexpr int kMostFactored = 600;
/// Of a last grid that is larger.  Then one of every four nodes in a square is missing, all over, and a sweep halves
/// the error.
constexpr int kLastSweeps = 4;

/// Corrections this small, 0.03 levels, may be float's rounding, which does not shrink.
constexpr double kFloor = 1e-4;

/// By how much bounds on errors are greater than what they rest on says.
constexpr double kMargin = 1.5;

/// Above, what a region may take, values included; fewer pixels than an int counts.
constexpr std::int64_t kMostBytes = 8'000'000'000, kBytesPerPixel = 40;

/// Of a pixel, that the rows' index may take.
constexpr std::int64_t kIndexBytes = 3;

/// Of the unknown and the right-hand side.
constexpr std::int64_t kValueBytes = 2 * kGridChannels * sizeof(float);

/// The coarsest first: their rows are short, and looking for them is most of the work there.
void index_levels(std::vector<GridLevel>& levels) {
  const std::int64_t pixels = levels.front().count();
  std::int64_t taken = 0;
  for (const GridLevel& level : levels)
    taken += level.bytes() + kValueBytes * level.count();
  // Of masks with pixel-sized holes a few bytes less than kBytesPerPixel are left.
  std::int64_t room = std::min(kIndexBytes * pixels, (kBytesPerPixel - 4) * pixels - taken);
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    room -= index_rows(*level, room);
}

} // namespace

struct MaskMultigrid::Data {
  std::vector<GridLevel> levels;
  std::optional<CoarsestGrid> coarsest;
  double screening = 0;
  /// Of each level: see GridMaking.
  std::vector<char> is_tricky;
  std::vector<float> zeros;
};

Result<MaskMultigrid> MaskMultigrid::make(const Mask& mask, double screening, const Watch& watch) {
  CHECK(screening >= 0, "screening is not negative");
  if (mask.empty()) return Error{"clone.empty-mask", "The region covers no pixel: make it larger.", ""};
  if (mask.count() > kMostBytes / kBytesPerPixel)
    return Error{"clone.too-large",
                 "The region has " + std::to_string(mask.count()) + " pixels, and blending it would take " +
                     std::to_string(mask.count() / 1'000'000 * kBytesPerPixel) + " MB of memory: make it smaller.",
                 ""};
  const StageTimer timer(watch.times, "clone.grids");
  const auto data = std::make_shared<Data>();
  data->screening = screening;
  GridMaking made = make_finest(mask, screening);
  for (;;) {
    if (watch.stopped()) return cancelled();
    const bool is_small = made.level.count() <= kMostFactored;
    GridMaking coarser;
    if (!is_small) coarser = coarsen(made, screening);
    data->levels.push_back(std::move(made.level));
    data->is_tricky.push_back(made.is_tricky);
    if (is_small || coarser.level.count() == 0) break;
    made = std::move(coarser);
  }
  index_levels(data->levels);
  data->zeros.assign(GridRows::longest_cells(data->levels.front()), 0.0f);
  if (data->levels.back().count() <= kMostFactored) data->coarsest.emplace(data->levels.back());
  return MaskMultigrid(data);
}

int MaskMultigrid::unknowns() const {
  return data_->levels.front().count();
}
double MaskMultigrid::screening() const {
  return data_->screening;
}
int MaskMultigrid::levels() const {
  return static_cast<int>(data_->levels.size());
}

std::int64_t MaskMultigrid::bytes() const {
  auto bytes = static_cast<std::int64_t>(data_->zeros.capacity() * sizeof(float));
  for (const GridLevel& level : data_->levels)
    bytes += level.bytes();
  return bytes + (data_->coarsest ? data_->coarsest->bytes() : 0);
}

struct MultigridSolve::State {
  explicit State(const MaskMultigrid& grids) : data(grids.data_) {
    std::size_t total = 0;
    for (const GridLevel& level : data->levels)
      total += 2 * (kC * static_cast<std::size_t>(level.count()) + kBeyond);
    memory.resize(total);
    float* at = memory.data();
    for (const GridLevel& level : data->levels) {
      const std::size_t size = kC * static_cast<std::size_t>(level.count()) + kBeyond;
      values.push_back({at, at + size, false});
      at += 2 * size;
    }
  }

  const GridLevel& level(std::size_t l) const { return data->levels[l]; }
  std::size_t last() const { return data->levels.size() - 1; }

  void run(std::size_t l, const std::vector<RowStage>& stages) {
    run_stages(level(l), values[l], kernels, data->zeros, stages, threads);
  }

  static void add_relaxing(std::vector<RowStage>& stages, int colour, int lag, bool from_zero) {
    if (from_zero)
      stages.push_back({lag, [colour](GridRows& rows, int row) { rows.relax_from_zero(row, colour); }});
    else
      stages.push_back({lag, [colour](GridRows& rows, int row) { rows.relax(row, colour); }});
    stages.push_back({lag + 1, [colour](GridRows& rows, int row) { rows.relax(row, 1 - colour); }});
  }

  /// Hands the residual down, by GridRows::restrict_to or restrict_side_to.
  template <class Restrict>
  void add_restriction(std::vector<RowStage>& stages, std::size_t l, int lag, Restrict restrict_row) {
    const GridLevel &fine = level(l), &coarse = level(l + 1);
    float* const b = values[l + 1].b;
    stages.push_back({lag, [&fine, &coarse, b, restrict_row](GridRows& rows, int row) {
                        const int y = fine.y_of(row) - fine.coarse_y;
                        const int coarse_row = (y & 1) == 0 ? coarse.find_row(y >> 1) : -1;
                        if (coarse_row >= 0) (rows.*restrict_row)(coarse, coarse_row, b);
                      }});
  }

  /// Relaxes, and hands the residual down.
  void add_down(std::vector<RowStage>& stages, std::size_t l, int lag, bool from_zero) {
    add_relaxing(stages, level(l).coarse_colour(), lag, from_zero);
    add_restriction(stages, l, lag + 3, &GridRows::restrict_to);
  }

  /// Takes the correction from below, and relaxes.
  void add_up(std::vector<RowStage>& stages, std::size_t l, float factor = 1, bool from_side = false) {
    const GridLevel& coarse = level(l + 1);
    const float* const u = values[l + 1].u;
    stages.push_back({0, [&coarse, u, factor](GridRows& rows, int row) { rows.inject(row, coarse, u, factor); }});
    if (from_side)
      stages.push_back({1, [](GridRows& rows, int row) { rows.correct_from_side(row); }});
    else
      stages.push_back({1, [](GridRows& rows, int row) { rows.correct(row); }});
    add_relaxing(stages, level(l).coarse_colour(), 2, false);
  }

  void solve_last(bool from_zero) {
    const std::size_t l = last();
    if (data->coarsest) {
      data->coarsest->solve(values[l].b, values[l].u);
      return;
    }
    for (int sweep = 0; sweep < kLastSweeps; ++sweep) {
      std::vector<RowStage> stages;
      add_relaxing(stages, level(l).coarse_colour(), 0, from_zero && sweep == 0);
      run(l, stages);
    }
  }

  /// One cycle on a coarse grid.
  void cycle(std::size_t l, bool from_zero) {
    if (l == last()) return solve_last(from_zero);
    std::vector<RowStage> down, up;
    add_down(down, l, 0, from_zero);
    run(l, down);
    visit(l + 1);
    add_up(up, l);
    run(l, up);
  }

  /// Twice where the coarse grids below would leave too much of the error.
  void visit(std::size_t l, bool twice = false) {
    cycle(l, true);
    if (l != last() && (twice || is_slow || data->is_tricky[l + 1] != 0)) cycle(l, false);
  }

  bool is_tricky() const { return is_slow || (last() > 0 && data->is_tricky[1] != 0); }

  double largest_correction() const {
    return kernels.largest(values[1].u, kC * static_cast<std::size_t>(level(1).count()));
  }

  double largest_residual() {
    GridRows rows(level(0), values[0], kernels, data->zeros);
    float largest = 0;
    for (int row = 0; row < level(0).rows(); ++row)
      largest = std::max(largest, rows.largest_residual(row));
    return largest;
  }

  /// See Outcome::error.  Measured contractions: 0.1–0.19 on whole regions, to 0.6 on tricky ones.
  double what_is_left(const Outcome& out, double correction) const {
    const double least = std::max(is_tricky() ? 0.5 : 0.25, slowness);
    const double rho = std::clamp(1.25 * out.contraction, least, 0.9);
    return correction * rho / (1 - rho);
  }

  /// Float's rounding does not shrink any more.
  static bool is_floor(const Outcome& out, double correction) {
    return out.cycles > 2 && out.contraction > 0.7 && correction < kFloor;
  }

  void learn(double contraction, double correction) {
    if (correction < kFloor) return;
    if (is_tricky() && slowness == 0 && contraction > 0.4) slowness = std::min(contraction, 0.7);
    if (contraction > 0.3) is_slow = true;
  }

  /// What the coarse correction is multiplied by.  Where W cycles are slow it is because the coarse grids are too
  /// stiff: part of the error shrinks by 1 − μ, 1 − slowness ≤ μ ≤ 1, a cycle.  Then the factors are the inverse roots
  /// of the Chebyshev polynomial of degree 3 on that interval: three cycles together do best.
  float step_factor(int cycle) const {
    if (slowness == 0) return 1;
    constexpr double kCosine[3] = {0.8660254037844386, 0, -0.8660254037844386};
    return static_cast<float>(1 / (1 - slowness / 2 + slowness / 2 * kCosine[cycle % 3]));
  }

  float* in_run(float* slots, std::size_t run, std::size_t count) const;
  Result<Outcome> sweep(double tolerance, int least, int most, const Watch& watch);
  Result<Outcome> cycle_until(double tolerance, int least, int most, const Watch& watch);

  std::shared_ptr<const MaskMultigrid::Data> data;
  int threads = 1;
  GridKernels kernels = GridKernels::choose();
  std::vector<float, BulkAllocator<float>> memory;
  std::vector<GridValues> values;
  bool is_zero = true;
  /// See set_ring_side().  Several threads may set sides.
  std::atomic<bool> is_ring_side = false;
  /// Whether all coarse grids are visited twice.
  bool is_slow = false;
  /// The contraction of W cycles, where that is poor; else 0.
  double slowness = 0;
};

MultigridSolve::MultigridSolve(const MaskMultigrid& grids) : state_(std::make_unique<State>(grids)) {}
MultigridSolve::~MultigridSolve() = default;
MultigridSolve::MultigridSolve(MultigridSolve&&) noexcept = default;
MultigridSolve& MultigridSolve::operator=(MultigridSolve&&) noexcept = default;

void MultigridSolve::use_threads(int threads) {
  state_->threads = std::max(1, threads);
}

/// The slots of a run of the mask, whose length `count` must be.
float* MultigridSolve::State::in_run(float* slots, std::size_t run, std::size_t count) const {
  const std::vector<GridLevel::Run>& runs = level(0).runs;
  CHECK(count == static_cast<std::size_t>(runs[run + 1].first - runs[run].first), "a value for each pixel of the run");
  return slots + kC * static_cast<std::size_t>(runs[run].first);
}

void MultigridSolve::set_ring_side(const PixelGraph& graph, std::span<const Float4> values) {
  CHECK(values.size() == graph.ring.size(), "a value for each of the ring's edges");
  float* const b = state_->values[0].b;
  const GridLevel& level = state_->level(0);
  // From zero the first pass reads b's neighbours, too; a single grid is not worked on row by row.
  state_->is_ring_side = !state_->is_zero && state_->last() > 0;
  if (!state_->is_ring_side) std::fill_n(b, kC * static_cast<std::size_t>(level.count()), 0.0F);
  std::size_t begin = 0;
  for (std::size_t run = 0; run < graph.first.size(); ++run) {
    std::size_t end = begin;
    const auto slot_of = [&](std::size_t edge) {
      const int x = level.x0_of(static_cast<int>(run)) + graph.ring[edge].pixel - graph.first[run];
      return b + kC * static_cast<std::size_t>(level.slot(static_cast<int>(run), x));
    };
    const int after = level.first_of(static_cast<int>(run) + 1);
    for (; end < graph.ring.size() && graph.ring[end].pixel < after; ++end)
      std::fill_n(slot_of(end), kC, 0.0F);
    for (; begin < end; ++begin)
      for (std::size_t k = 0; k < kC; ++k)
        slot_of(begin)[k] += values[begin][k];
  }
}

void MultigridSolve::set_side(std::size_t run, std::span<const Float4> values) {
  state_->is_ring_side = false;
  to_slots(values, state_->in_run(state_->values[0].b, run, values.size()));
}

void MultigridSolve::set_side(std::size_t run, const float* planes, std::size_t stride) {
  state_->is_ring_side = false;
  const std::vector<GridLevel::Run>& runs = state_->level(0).runs;
  const auto count = static_cast<std::size_t>(runs[run + 1].first - runs[run].first);
  to_slots(planes, stride, count, state_->in_run(state_->values[0].b, run, count));
}

void MultigridSolve::set_start(std::size_t run, std::span<const Float4> values) {
  to_slots(values, state_->in_run(state_->values[0].u, run, values.size()));
  state_->is_zero = false;
}

void MultigridSolve::start_from_zero() {
  state_->is_zero = true;
}

void MultigridSolve::get(std::size_t run, std::span<Float4> values) const {
  from_slots(state_->in_run(state_->values[0].u, run, values.size()), values);
}

Result<MultigridSolve::Outcome> MultigridSolve::solve(double tolerance, int least, int most, const Watch& watch) {
  CHECK(!state_->is_zero || !state_->is_ring_side, "a ring's side goes with a start");
  state_->values[0].is_b_beside_boundary = state_->is_ring_side;
  // What was learnt before is forgotten: the same b and start give the same bits, whatever was solved in between.
  state_->is_slow = false;
  state_->slowness = 0;
  return state_->last() == 0 ? state_->sweep(tolerance, least, most, watch)
                             : state_->cycle_until(tolerance, least, most, watch);
}

/// On one grid.
Result<MultigridSolve::Outcome> MultigridSolve::State::sweep(double tolerance, int least, int most,
                                                             const Watch& watch) {
  Outcome out;
  do {
    if (watch.stopped()) return cancelled();
    solve_last(is_zero);
    is_zero = false;
    ++out.cycles;
    if (data->coarsest) return out;
    // A sweep halves the error, so that it is at most twice what the next one would change.
    out.error = kMargin * largest_residual() / 2;
  } while (out.cycles < most && (out.cycles < least || out.error > tolerance));
  return out;
}

Result<MultigridSolve::Outcome> MultigridSolve::State::cycle_until(double tolerance, int least, int most,
                                                                   const Watch& watch) {
  Outcome out;
  double before = 0;
  std::vector<RowStage> stages;
  // From zero, on the pixels, half a sweep is enough: of the colour without coarse nodes.  It is b / diagonal, and
  // written when the correction comes.
  bool from_side = is_zero;
  if (from_side)
    add_restriction(stages, 0, 0, &GridRows::restrict_side_to);
  else
    add_down(stages, 0, 0, false);
  for (;;) {
    if (watch.stopped()) return cancelled();
    run(0, stages);
    is_zero &= out.cycles == 0;
    // From zero most of the error is smooth: a second look takes off three quarters of it, for a fourth of a cycle.
    visit(1, from_side);
    const double correction = largest_correction();
    ++out.cycles;
    if (before > 0) out.contraction = correction / before;
    before = correction;
    const float factor = step_factor(out.cycles);
    if (out.cycles <= 3) learn(out.contraction, correction);
    out.error = what_is_left(out, correction);
    const bool is_last = out.cycles >= most || is_floor(out, correction);
    const bool is_done = is_last || (out.cycles >= least && out.error <= tolerance);
    stages.clear();
    add_up(stages, 0, factor, std::exchange(from_side, false));
    if (!is_done) add_down(stages, 0, 4, false);
    if (!is_done) continue;
    run(0, stages);
    is_zero = false;
    if (!is_tricky()) return out;
    // Where holes are dense, errors hide between the coarse nodes: a pixel's is at most its residual there.
    out.error += kMargin * largest_residual();
    if (is_last || out.error <= tolerance) return out;
    stages.clear();
    add_down(stages, 0, 0, false);
  }
}

std::int64_t MultigridSolve::bytes() const {
  return static_cast<std::int64_t>(state_->memory.size() * sizeof(float));
}

} // namespace oversketch
