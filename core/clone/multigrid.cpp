#include "core/clone/multigrid.h"

#include "core/base/check.h"
#include "core/clone/grid_cycle.h"
#include "core/clone/pixel_planes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

namespace oversketch {
namespace {

constexpr std::size_t kC = kGridChannels;
/// Few enough to be factored: a substitution then costs less than a cycle on them.
constexpr int kMostFactored = 600;
/// Corrections this small, 0.03 levels, may be float's rounding, which does not shrink.
constexpr double kFloor = 1e-4;

/// By how much bounds on errors are greater than what they rest on says.
constexpr double kMargin = 1.5;

/// How much more of the error half a sweep at the end leaves than a whole one.
constexpr double kHalfSweepMore = 1.25;

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
  GridStack grids;
  double screening = 0;
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
  GridStack& grids = data->grids;
  GridMaking made = make_finest(mask, screening);
  for (;;) {
    if (watch.stopped()) return cancelled();
    const bool is_small = made.level.count() <= kMostFactored;
    GridMaking coarser;
    if (!is_small) coarser = coarsen(made, screening);
    grids.levels.push_back(std::move(made.level));
    grids.is_tricky.push_back(made.is_tricky);
    if (is_small || coarser.level.count() == 0) break;
    made = std::move(coarser);
  }
  index_levels(grids.levels);
  grids.zeros.assign(GridRows::longest_cells(grids.levels.front()), 0.0f);
  if (grids.levels.back().count() <= kMostFactored) grids.coarsest.emplace(grids.levels.back());
  return MaskMultigrid(data);
}

int MaskMultigrid::unknowns() const {
  return data_->grids.levels.front().count();
}
double MaskMultigrid::screening() const {
  return data_->screening;
}
int MaskMultigrid::levels() const {
  return static_cast<int>(data_->grids.levels.size());
}

std::int64_t MaskMultigrid::bytes() const {
  auto bytes = static_cast<std::int64_t>(data_->grids.zeros.capacity() * sizeof(float));
  for (const GridLevel& level : data_->grids.levels)
    bytes += level.bytes();
  return bytes + (data_->grids.coarsest ? data_->grids.coarsest->bytes() : 0);
}

namespace {

Error not_finite() {
  return {"clone.not-finite", "A picture has a pixel that is not a number, or infinite.", ""};
}

/// b written row by row.
struct SideWriting {
  std::function<MultigridSolve::WriteSide()> make;
  /// Set by any thread.
  std::atomic<bool> is_finite = true;

  /// One thread's, of the rows of the pixels.
  std::function<void(int row)> writer(const GridLevel& pixels) {
    return [this, &pixels, write = make()](int row) {
      if (!write(static_cast<std::size_t>(pixels.begin_of(row)), static_cast<std::size_t>(pixels.end_of(row))))
        is_finite = false;
    };
  }

  bool write_all(const GridLevel& pixels) {
    if (!make) return true;
    const std::function<void(int row)> write = writer(pixels);
    for (int row = 0; row < pixels.rows(); ++row)
      write(row);
    return is_finite;
  }
};

} // namespace

struct MultigridSolve::State {
  explicit State(const MaskMultigrid& grids) : data(grids.data_), cycle(data->grids) {}

  bool has_one_grid() const { return data->grids.last() == 0; }

  /// See Outcome::error.  Measured contractions: 0.1–0.19 on whole regions, to 0.6 on tricky ones.
  double what_is_left(const Outcome& out, double correction) const {
    const double least = std::max(cycle.is_tricky() ? 0.5 : 0.3, slowness);
    const double rho = std::clamp(1.25 * out.contraction, least, 0.9);
    return correction * rho / (1 - rho);
  }

  /// Float's rounding does not shrink any more.
  static bool is_floor(const Outcome& out, double correction) {
    return out.cycles > 2 && out.contraction > 0.7 && correction < kFloor;
  }

  void learn(double contraction, double correction) {
    if (correction < kFloor) return;
    if (cycle.is_tricky() && slowness == 0 && contraction > 0.4) slowness = std::min(contraction, 0.7);
    if (contraction > 0.3) cycle.is_slow = true;
  }

  /// What the coarse correction is multiplied by.  Where W cycles are slow it is because the coarse grids are too
  /// stiff: part of the error shrinks by 1 − μ, 1 − slowness ≤ μ ≤ 1, a cycle.  Then the factors are the inverse roots
  /// of the Chebyshev polynomial of degree 3 on that interval: three cycles together do best.
  float step_factor(int number) const {
    if (slowness == 0) return 1;
    constexpr double kCosine[3] = {0.8660254037844386, 0, -0.8660254037844386};
    return static_cast<float>(1 / (1 - slowness / 2 + slowness / 2 * kCosine[number % 3]));
  }

  // Of a run of the mask: its slots, and how many there are.
  template <class Value>
  GridSlots<Value> in_run(Value* slots, std::size_t run) const {
    Value* const even = slots + kC * static_cast<std::size_t>(cycle.level(0).runs[run].first);
    return {even, even + kC * ((length_of(run) + 1) / 2)};
  }
  std::size_t length_of(std::size_t run) const {
    const std::vector<GridLevel::Run>& runs = cycle.level(0).runs;
    return static_cast<std::size_t>(runs[run + 1].first - runs[run].first);
  }
  Result<Outcome> sweep(double tolerance, int least, int most, SideWriting& writing, const Watch& watch);
  Result<Outcome> cycle_until(double tolerance, int least, int most, SideWriting& writing, const Watch& watch);

  std::shared_ptr<const MaskMultigrid::Data> data;
  GridCycle cycle;
  /// What is still to write b, if anything.
  std::function<WriteSide()> make_write_side;
  bool is_zero = true;
  /// See set_ring_side().
  bool is_ring_side = false;
  /// The contraction of W cycles, where that is poor; else 0.
  double slowness = 0;
};

MultigridSolve::MultigridSolve(const MaskMultigrid& grids) : state_(std::make_unique<State>(grids)) {}
MultigridSolve::~MultigridSolve() = default;
MultigridSolve::MultigridSolve(MultigridSolve&&) noexcept = default;
MultigridSolve& MultigridSolve::operator=(MultigridSolve&&) noexcept = default;

void MultigridSolve::use_threads(int threads) {
  state_->cycle.threads = std::max(1, threads);
}

void MultigridSolve::set_ring_side(const PixelGraph& graph, std::span<const Float4> values) {
  CHECK(values.size() == graph.ring.size(), "a value for each of the ring's edges");
  state_->make_write_side = nullptr;
  float* const b = state_->cycle.values(0).b;
  const GridLevel& level = state_->cycle.level(0);
  // From zero the first pass reads b's neighbours, too; a single grid is not worked on row by row.
  state_->is_ring_side = !state_->is_zero && !state_->has_one_grid();
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
  CHECK(values.size() == state_->length_of(run), "a value for each pixel of the run");
  state_->is_ring_side = false;
  state_->make_write_side = nullptr;
  to_slots(values, side(run));
}

void MultigridSolve::set_side_by(std::function<WriteSide()> make) {
  state_->make_write_side = std::move(make);
}

GridSlots<float> MultigridSolve::side(std::size_t run) {
  return state_->in_run(state_->cycle.values(0).b, run);
}

void MultigridSolve::set_start(std::size_t run, std::span<const Float4> values) {
  CHECK(values.size() == state_->length_of(run), "a value for each pixel of the run");
  to_slots(values, state_->in_run(state_->cycle.values(0).u, run));
  state_->is_zero = false;
}

void MultigridSolve::start_from_zero() {
  state_->is_zero = true;
}

void MultigridSolve::get(std::size_t run, std::span<Float4> values) const {
  CHECK(values.size() == state_->length_of(run), "room for each pixel of the run");
  from_slots(slots(run), values);
}

GridSlots<const float> MultigridSolve::slots(std::size_t run) const {
  return state_->in_run<const float>(state_->cycle.values(0).u, run);
}

Result<MultigridSolve::Outcome> MultigridSolve::solve(double tolerance, int least, int most, const Watch& watch) {
  State& state = *state_;
  SideWriting writing{std::exchange(state.make_write_side, nullptr)};
  if (writing.make) state.is_ring_side = false;
  CHECK(!state.is_zero || !state.is_ring_side, "a ring's side goes with a start");
  state.cycle.values(0).is_b_beside_boundary = state.is_ring_side;
  // What was learnt before is forgotten: the same b and start give the same bits, whatever was solved in between.
  state.cycle.is_slow = false;
  state.slowness = 0;
  return state.has_one_grid() ? state.sweep(tolerance, least, most, writing, watch)
                              : state.cycle_until(tolerance, least, most, writing, watch);
}

/// On one grid.
Result<MultigridSolve::Outcome> MultigridSolve::State::sweep(double tolerance, int least, int most,
                                                             SideWriting& writing, const Watch& watch) {
  Outcome out;
  if (!writing.write_all(cycle.level(0))) return not_finite();
  do {
    if (watch.stopped()) return cancelled();
    cycle.solve_last(is_zero);
    is_zero = false;
    ++out.cycles;
    if (data->grids.coarsest) return out;
    // A sweep halves the error, so that it is at most twice what the next one would change.
    out.error = kMargin * cycle.largest_residual() / 2;
  } while (out.cycles < most && (out.cycles < least || out.error > tolerance));
  return out;
}

Result<MultigridSolve::Outcome> MultigridSolve::State::cycle_until(double tolerance, int least, int most,
                                                                   SideWriting& writing, const Watch& watch) {
  Outcome out;
  double before = 0;
  using From = GridCycle::From;
  using To = GridCycle::To;
  From from = is_zero ? From::kSide : From::kValues;
  if (from == From::kValues && !writing.write_all(cycle.level(0))) return not_finite();
  RowPass pass = cycle.down(0, from);
  if (from == From::kSide && writing.make) pass.make_writer = [&] { return writing.writer(cycle.level(0)); };
  for (;;) {
    if (watch.stopped()) return cancelled();
    cycle.run(0, pass);
    if (!writing.is_finite) return not_finite();
    is_zero &= out.cycles == 0;
    // From zero most of the error is smooth: a second look takes off three quarters of it, for a fourth of a cycle.
    cycle.visit(1, from == From::kSide);
    const double correction = cycle.largest_correction();
    ++out.cycles;
    if (before > 0) out.contraction = correction / before;
    before = correction;
    const float factor = step_factor(out.cycles);
    if (out.cycles <= 3) learn(out.contraction, correction);
    out.error = what_is_left(out, correction);
    const bool is_last = out.cycles >= most || is_floor(out, correction);
    const bool is_done = is_last || (out.cycles >= least && out.error <= tolerance);
    To to = is_done ? To::kSweep : To::kNext;
    // Where it is good enough for that.  Of tricky masks a residual is wanted, and told where a whole sweep came last.
    if (is_done && !cycle.is_tricky() && kHalfSweepMore * out.error <= tolerance) {
      out.error *= kHalfSweepMore;
      to = To::kHalfSweep;
    }
    pass = cycle.up(0, std::exchange(from, From::kValues), to, factor);
    if (!is_done) continue;
    cycle.run(0, pass);
    is_zero = false;
    if (!cycle.is_tricky()) return out;
    // Where holes are dense, errors hide between the coarse nodes: a pixel's is at most its residual there.
    out.error += kMargin * cycle.largest_residual();
    if (is_last || out.error <= tolerance) return out;
    pass = cycle.down(0, From::kValues);
  }
}

std::int64_t MultigridSolve::bytes() const {
  return state_->cycle.bytes();
}

} // namespace oversketch
