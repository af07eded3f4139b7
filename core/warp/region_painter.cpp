#include "core/warp/region_painter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace oversketch {
namespace {

constexpr int kMostInRow = RowKernels::kMost;
using Values = RowKernels::Values;

/// r, g, b, a in one register.
using Lanes = float __attribute__((vector_size(16)));

/// Colour times alpha, and alpha.
Lanes premultiplied(const Rgba& p) {
  return std::bit_cast<Lanes>(p) * Lanes{p.a, p.a, p.a, 1};
}

Rgba straight(const Lanes& sum) {
  const float alpha = sum[3];
  if (!(alpha > 0)) return {0, 0, 0, 0};
  const Lanes color = sum / Lanes{alpha, alpha, alpha, 1};
  return std::bit_cast<Rgba>(color);
}

/// How many pixels of the texture lie between a point and where a row of points soon comes by.
std::ptrdiff_t ahead(const Texture& texture, Point step_down) {
  constexpr double kRows = 4;
  const Point step = kRows * step_down;
  return static_cast<std::ptrdiff_t>(std::lround(step.y)) * texture.width + std::lround(step.x);
}

/// One of the values of a vertex at a cell's corners.
std::array<Point, 4> pick(const std::array<Minification::Vertex, 4>& corners, Point Minification::Vertex::*of) {
  return {corners[0].*of, corners[1].*of, corners[2].*of, corners[3].*of};
}
std::array<Point, 4> pick_stages(const std::array<Minification::Vertex, 4>& corners) {
  return {Point{corners[0].stage, 0}, Point{corners[1].stage, 0}, Point{corners[2].stage, 0},
          Point{corners[3].stage, 0}};
}

} // namespace

/// Source points of some pixels of a row and, where `shrunk`, how their colours are averaged.
struct RegionPainter::Places {
  Values x{}, y{};
  bool shrunk = false;
  /// See Minification::Vertex; `unused` takes what has no second component.
  Values stage{}, unused{}, x_along_x{}, y_along_x{}, x_along_y{}, y_along_y{};
  Values u{}, v{};
  /// See CellInverse::step_down, of one of their cells.
  Point down;
};

RegionPainter::RegionPainter(const ImagePyramid& source, const QuadMesh& mesh, const Points& deformed,
                             const WarpOptions& options)
    : source_(source),
      options_(options),
      kernels_(row_kernels(options.simd)),
      texture_(source.image().pixels()),
      minification_(mesh, deformed, source.top()) {
  inverses_.reserve(mesh.cells.size());
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    inverses_.emplace_back(mesh, deformed, cell);
}

std::vector<Mask::Run> RegionPainter::paint(std::span<const Mask::Run> runs, const CellSpans& spans,
                                            WarpedRegion& out) const {
  std::vector<Mask::Run> uncovered;
  Places places;
  for (const Mask::Run& run : runs)
    paint_run(run, spans.row(run.y), &out.pixels.at(run.x0 - out.rect.x, run.y - out.rect.y), places, uncovered);
  return uncovered;
}

void RegionPainter::paint_run(const Mask::Run& run, std::span<const CellSpan> spans, Rgba* out, Places& places,
                              std::vector<Mask::Run>& uncovered) const {
  auto span = std::ranges::partition_point(spans, [&](const CellSpan& s) { return s.x1 <= run.x0; });
  for (int x = run.x0; x < run.x1;) {
    const int begin = x, end = std::min(run.x1, x + kMostInRow);
    places.shrunk = false;
    places.down = {};
    while (x < end) {
      while (span != spans.end() && span->x1 <= x)
        ++span;
      const bool covered = span != spans.end() && span->x0 <= x;
      const int until = covered ? std::min(end, span->x1) : span != spans.end() ? std::min(end, span->x0) : end;
      if (covered) {
        place(span->cell, x, run.y, x - begin, until - x, places);
      } else {
        std::fill(places.x.begin() + (x - begin), places.x.begin() + (until - begin), 0.0);
        std::fill(places.y.begin() + (x - begin), places.y.begin() + (until - begin), 0.0);
        clear_shrinking(x - begin, until - x, places);
        uncovered.push_back({run.y, x, until});
      }
      x = until;
    }
    sample(end - begin, places, out + (begin - run.x0));
  }
}

Rgba RegionPainter::paint_continued(int cell, Point p, Point step) const {
  const CellInverse& inverse = inverses_[static_cast<std::size_t>(cell)];
  const CellInverse::Place place = inverse.locate(p);
  const Point grown = inverse.growth(place, step);
  const BilinearForm& f = inverse.source(place.part);
  const Point source = f(place.u, place.v) + grown.x * (f.a + place.v * f.c) + grown.y * (f.b + place.u * f.c);
  Places places;
  place_one(inverse, cell, place, source, 0, places);
  Rgba out;
  sample(1, places, &out);
  return out;
}

void RegionPainter::place(int cell, int x, int y, int at, int count, Places& places) const {
  const CellInverse& inverse = inverses_[static_cast<std::size_t>(cell)];
  if (!inverse.is_convex()) {
    for (int i = 0; i < count; ++i) {
      const CellInverse::Place place = inverse.locate({x + i + 0.5, y + 0.5});
      place_one(inverse, cell, place, inverse.source(place.part)(place.u, place.v), at + i, places);
    }
    return;
  }
  double *const u = &places.u[static_cast<std::size_t>(at)], *const v = &places.v[static_cast<std::size_t>(at)];
  const auto evaluate = [&](const BilinearForm& form, Values& to_x, Values& to_y) {
    kernels_.evaluate(form, count, u, v, &to_x[static_cast<std::size_t>(at)], &to_y[static_cast<std::size_t>(at)]);
  };
  const bool shrunk = minification_.touches(cell);
  places.down = inverse.step_down();
  if (inverse.is_gentle())
    kernels_.map_gently(inverse.gentle_row(x, y), count, &places.x[static_cast<std::size_t>(at)],
                        &places.y[static_cast<std::size_t>(at)]);
  if (shrunk || !inverse.is_gentle()) kernels_.invert(inverse.row(x, y), count, u, v);
  if (!inverse.is_gentle()) evaluate(inverse.source(0), places.x, places.y);
  if (!shrunk) return clear_shrinking(at, count, places);
  const auto corners = minification_.corners(cell);
  places.shrunk = true;
  evaluate(inverse.form(0, pick_stages(corners)), places.stage, places.unused);
  evaluate(inverse.form(0, pick(corners, &Minification::Vertex::along_x)), places.x_along_x, places.y_along_x);
  evaluate(inverse.form(0, pick(corners, &Minification::Vertex::along_y)), places.x_along_y, places.y_along_y);
}

void RegionPainter::place_one(const CellInverse& inverse, int cell, const CellInverse::Place& place, Point source,
                              int at, Places& places) const {
  const auto i = static_cast<std::size_t>(at);
  places.x[i] = source.x, places.y[i] = source.y;
  if (!minification_.touches(cell)) return clear_shrinking(at, 1, places);
  const auto corners = minification_.corners(cell);
  const auto evaluate = [&](const std::array<Point, 4>& values) {
    return inverse.form(place.part, values)(place.u, place.v);
  };
  places.shrunk = true;
  places.stage[i] = evaluate(pick_stages(corners)).x;
  const Point along_x = evaluate(pick(corners, &Minification::Vertex::along_x));
  const Point along_y = evaluate(pick(corners, &Minification::Vertex::along_y));
  places.x_along_x[i] = along_x.x, places.y_along_x[i] = along_x.y;
  places.x_along_y[i] = along_y.x, places.y_along_y[i] = along_y.y;
}

void RegionPainter::clear_shrinking(int at, int count, Places& places) const {
  if (!minification_.shrinks()) return;
  for (Values* values : {&places.stage, &places.x_along_x, &places.y_along_x, &places.x_along_y, &places.y_along_y})
    std::fill_n(values->begin() + at, count, 0.0);
}

void RegionPainter::sample(int count, Places& places, Rgba* out) const {
  if (places.shrunk) return sample_shrunk(count, places, out);
  const auto kernel = options_.sampling == Sampling::kBicubic ? kernels_.bicubic : kernels_.bilinear;
  kernel(texture_, count, places.x.data(), places.y.data(), ahead(texture_, places.down), out);
}

void RegionPainter::sample_shrunk(int count, Places& places, Rgba* out) const {
  int lowest = source_.top() + 1, highest = 0;
  std::array<int, kMostInRow> stages;
  std::array<float, kMostInRow> parts;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    // Not-a-number is stage 0, too.
    const double stage = std::min(std::max(0.0, places.stage[i]), source_.top() + 1.0);
    stages[i] = static_cast<int>(stage);
    parts[i] = static_cast<float>(stage - stages[i]);
    lowest = std::min(lowest, stages[i]), highest = std::max(highest, stages[i] + (parts[i] > 0 ? 1 : 0));
  }
  std::array<Lanes, kMostInRow> sums{}, colors;
  for (int stage = lowest; stage <= highest; ++stage) {
    sample_stage(stage, count, places, colors.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      // What is of one stage alone keeps its bits.
      if (stages[i] == stage && parts[i] == 0) out[i] = straight(colors[i]);
      if (stage == stages[i]) sums[i] += (1 - parts[i]) * colors[i];
      if (stage == stages[i] + 1) sums[i] += parts[i] * colors[i];
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    if (parts[i] > 0) out[i] = straight(sums[i]);
}

void RegionPainter::sample_stage(int stage, int count, const Places& places, Lanes* out) const {
  std::array<Rgba, kMostInRow> colors;
  if (stage == 0) {
    const auto kernel = options_.sampling == Sampling::kBicubic ? kernels_.bicubic : kernels_.bilinear;
    kernel(texture_, count, places.x.data(), places.y.data(), ahead(texture_, places.down), colors.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      out[i] = premultiplied(colors[i]);
    return;
  }
  const Texture texture(source_.level(stage - 1));
  const double scale = std::ldexp(1.0, 1 - stage);
  std::fill_n(out, count, Lanes{});
  Values x, y;
  const std::ptrdiff_t further = ahead(texture, scale * places.down);
  for (const auto& [right, down] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{-1, 1}, std::pair{1, 1}}) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      x[i] = scale * (places.x[i] + right * places.x_along_x[i] + down * places.x_along_y[i]);
      y[i] = scale * (places.y[i] + right * places.y_along_x[i] + down * places.y_along_y[i]);
    }
    kernels_.bilinear(texture, count, x.data(), y.data(), further, colors.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      out[i] += 0.25F * premultiplied(colors[i]);
  }
}

} // namespace oversketch
