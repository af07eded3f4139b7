#include "core/clone/paint.h"

#include "core/base/parallel.h"
#include "core/clone/feather.h"
#include "core/clone/row_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace oversketch {
namespace {

/// A run of the mask, as far as it lies on the target.
struct PaintedRun {
  TargetRun at;
  /// Its number in the mask.
  std::size_t run = 0;
};

std::vector<PaintedRun> clip_runs(const Raster<Rgba>& target, const PixelGraph& graph, int dx, int dy) {
  std::vector<PaintedRun> out;
  const std::vector<Mask::Run>& runs = graph.mask.runs();
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (const TargetRun run = clip_run(target.rect(), runs[k], graph.first[k], dx, dy); run.x0 < run.x1)
      out.push_back({run, k});
  return out;
}

/// `colour` laid over `below` with weight w.
Rgba over(const Channels& colour, double w, const Rgba& below) {
  const double under = (1 - w) * below.a, alpha = w + under;
  if (!(alpha > 0)) return below;
  const auto mix = [&](double top, double bottom) { return static_cast<float>((w * top + under * bottom) / alpha); };
  return {mix(colour.v[0], below.r), mix(colour.v[1], below.g), mix(colour.v[2], below.b), static_cast<float>(alpha)};
}

/// Weights of the strength or of the paste, by pixel number; empty: all 1.
std::vector<double> fading_weights(const Painting& painting) {
  const BlendOptions& options = painting.options;
  const bool fades = options.mode == BlendMode::kNone || options.strength < 1;
  return fades && options.feather_px > 0 ? inside_weights(painting.graph, options.feather_px) : std::vector<double>();
}

class Painter {
public:
  /// @param inside  fading_weights; must outlive this.
  Painter(const Painting& painting, const std::vector<double>& inside)
      : pair_(painting.pair),
        graph_(painting.graph),
        options_(painting.options),
        correction_(painting.correction),
        inside_(inside) {
    if (correction_ != nullptr && correction_->is_zero()) correction_ = nullptr;
  }

  /// Calls `take(pixel)` for the pixels of a run, from left to right; (dx, dy) as in paint().
  template <class Take>
  void run(const PaintedRun& run, int dx, int dy, Take take) {
    if (correction_ != nullptr) correction_->read(run.run, graph_.mask.runs()[run.run], u_);
    first_ = graph_.first[run.run];
    for (int i = 0; i < run.at.length(); ++i)
      take(pixel(run.at.pixel + i, run.at.x0 + i - dx, run.at.y - dy));
  }

private:
  /// Pixel number k at (x, y) of the mask.
  Rgba pixel(int k, int x, int y) const {
    const Rgba &source = pair_.source_pixel(x, y), &below = pair_.target_pixel(x, y);
    const bool pastes = options_.mode == BlendMode::kNone;
    const double inside = inside_.empty() ? 1 : inside_[static_cast<std::size_t>(k)];
    const double w = source.a * options_.opacity * (pastes ? inside : 1);
    if (w == 0) return below;
    const Channels colour = pastes ? Channels{{source.r, source.g, source.b, 0}} : blended(k, source, below, inside);
    if (w == 1)
      return {static_cast<float>(colour.v[0]), static_cast<float>(colour.v[1]), static_cast<float>(colour.v[2]), 1};
    return over(colour, w, below);
  }

  Channels blended(int k, const Rgba& source, const Rgba& below, double inside) const {
    Channels values = pair_.source_values(source);
    if (correction_ != nullptr) {
      const double strength = 1 - (1 - options_.strength) * inside;
      const Float4& u = u_[static_cast<std::size_t>(k - first_)];
      values += strength * Channels{{u[0], u[1], u[2], 0}};
    }
    if (options_.mode == BlendMode::kAverage)
      values = options_.average * values + (1 - options_.average) * to_domain(below, options_.domain);
    return from_domain(values, options_.domain);
  }

  const PlacedPair& pair_;
  const PixelGraph& graph_;
  const BlendOptions& options_;
  const Correction* correction_;
  /// Of the whole run that is painted, and the number of its first pixel.
  std::vector<Float4> u_;
  int first_ = 0;
  const std::vector<double>& inside_;
};

/// What one thread has painted.
struct PaintedPart {
  std::vector<Rgba> pixels;
  float largest = 0;
  bool is_finite = true;

  void add(const Rgba& p) {
    pixels.push_back(p);
    is_finite &= std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b);
    largest = std::max({largest, std::abs(p.r), std::abs(p.g), std::abs(p.b)});
  }
};

/// More hardly pays beside the memory's speed.
constexpr int kMostThreads = 4;

} // namespace

TargetRun clip_run(const Rect& target, const Mask::Run& run, int first, int dx, int dy) {
  // dx and dy may be any int.
  const std::int64_t y = static_cast<std::int64_t>(run.y) + dy;
  if (y < 0 || y >= target.height) return {};
  const std::int64_t left = static_cast<std::int64_t>(run.x0) + dx;
  const auto x0 = std::clamp<std::int64_t>(left, 0, target.width);
  const auto x1 = std::clamp<std::int64_t>(static_cast<std::int64_t>(run.x1) + dx, 0, target.width);
  if (x0 >= x1) return {};
  return {static_cast<int>(y), static_cast<int>(x0), static_cast<int>(x1), first + static_cast<int>(x0 - left)};
}

Rect painted_rect(const Rect& target, const Mask& mask, int dx, int dy) {
  Rect box;
  for (const Mask::Run& run : mask.runs())
    if (const TargetRun t = clip_run(target, run, 0, dx, dy); t.x0 < t.x1) box = unite(box, {t.x0, t.y, t.length(), 1});
  return box;
}

Result<double> paint(Raster<Rgba>& target, const Painting& painting, int dx, int dy, const Watch& watch,
                     const Refine& refine) {
  const std::vector<PaintedRun> runs = clip_runs(target, painting.graph, dx, dy);
  const int threads = watch.threads_up_to(kMostThreads);
  const auto parts = cut_rows(std::span(runs), threads, [](const PaintedRun& run) { return run.at.length(); });
  const std::vector<double> inside = fading_weights(painting);
  // Set aside first, so that a result that overflows leaves the target as it was.
  std::vector<PaintedPart> done(parts.size());
  const auto compute = [&]() -> Result<double> {
    run_parallel(static_cast<int>(parts.size()), threads, [&](int i) {
      const auto part = static_cast<std::size_t>(i);
      Painter painter(painting, inside);
      std::size_t count = 0;
      for (const PaintedRun& run : parts[part])
        count += static_cast<std::size_t>(run.at.length());
      done[part] = {};
      done[part].pixels.reserve(count);
      for (const PaintedRun& run : parts[part])
        painter.run(run, dx, dy, [&](const Rgba& pixel) { done[part].add(pixel); });
    });
    float largest = 0;
    for (const PaintedPart& part : done) {
      if (!part.is_finite)
        return Error{"clone.not-finite", "The blended picture has values too large to be stored.", ""};
      largest = std::max(largest, part.largest);
    }
    return static_cast<double>(largest);
  };
  Result<double> largest = compute();
  if (largest && refine) {
    const Result<bool> refined = refine(*largest);
    if (!refined) return refined.error();
    if (*refined) largest = compute();
  }
  if (!largest) return largest.error();
  if (watch.stopped()) return cancelled();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto from = done[i].pixels.begin();
    for (const PaintedRun& run : parts[i]) {
      std::copy(from, from + run.at.length(), &target.at(run.at.x0, run.at.y));
      from += run.at.length();
    }
  }
  return largest;
}

} // namespace oversketch
