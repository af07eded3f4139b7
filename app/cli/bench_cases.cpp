#include "app/cli/bench_cases.h"

#include "core/deform/cleanup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oversketch::cli {

namespace fs = std::filesystem;

namespace {

Result<std::vector<fs::path>> list_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  if (failure) return Error{"file.unreadable", failure.message(), folder.string()};
  if (files.empty()) return Error{"bench.no-cases", "no .json file is there", folder.string()};
  std::sort(files.begin(), files.end());
  return files;
}

/// The same points and more between them, at most 1 % of the length apart.
ClosedCurve subdivide(const ClosedCurve& curve) {
  Points points;
  for (int i = 0; i < curve.size(); ++i) {
    const Point from = curve.points()[i], to = curve.points()[(i + 1) % curve.size()];
    const int pieces = std::max(1, static_cast<int>(std::ceil(100 * distance(from, to) / curve.length())));
    for (int k = 0; k < pieces; ++k)
      points.push_back(k == 0 ? from : lerp(from, to, static_cast<double>(k) / pieces));
  }
  return ClosedCurve(std::move(points));
}

Result<BenchCase> prepare(DeformCase given, const Watch& watch) {
  auto clean = clean_sketch(given.sketch, 1.0);
  if (!clean) return clean.error();
  ClosedCurve sketch = subdivide(clean->curve);
  auto flipfree = FlipfreeSystem::make(ClosedCurve(given.outline), watch);
  if (!flipfree) return flipfree.error();
  DeformOptions options;
  options.cell_px = cell_for(given.outline, kDrawnVertices);
  auto display = make_display_mesh(flipfree->region(), options.cell_px, watch);
  if (!display) return display.error();
  DeformCounts counts;
  auto drawn = DeformSystem::make(given.outline, options, nullptr, counts, watch);
  if (!drawn) return drawn.error();
  auto solved = drawn->deform(sketch.points(), {}, options, nullptr, counts, watch);
  if (!solved) return solved.error();
  return BenchCase{std::move(given),    std::move(sketch), std::move(*flipfree),
                   std::move(*display), std::move(*drawn), std::move(*solved)};
}

} // namespace

double cell_for(const Points& outline, double vertices) {
  return std::sqrt(std::abs(signed_area(outline)) / vertices);
}

Result<std::vector<BenchCase>> prepare_cases(const fs::path& folder, const Watch& watch) {
  const auto files = list_files(folder);
  if (!files) return files.error();
  std::vector<BenchCase> cases;
  for (const fs::path& file : *files) {
    auto given = read_case(file);
    if (!given) return given.error();
    auto prepared = prepare(std::move(*given), watch);
    if (!prepared) return at(file.string(), prepared.error());
    cases.push_back(std::move(*prepared));
  }
  return cases;
}

double BenchRandom::between(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
}

double BenchRandom::sign() {
  return between(-1, 1) < 0 ? -1 : 1;
}

Points draw_stroke(const ClosedCurve& curve, BenchRandom& random) {
  constexpr int kSamples = 60;
  const double begin = random.between(0, curve.length()), part = random.between(0.1, 0.35) * curve.length();
  const Point chord = curve.at(begin + part) - curve.at(begin);
  const Point along = length(chord) > 0 ? chord / length(chord) : curve.tangent(begin);
  const Point push = random.sign() * random.between(0.05, 0.2) * part * turned(along);
  const double tremble = 0.001 * curve.length();
  Points stroke;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples, bulge = std::pow(std::sin(std::numbers::pi * t), 2);
    const Point shake{random.between(-tremble, tremble), random.between(-tremble, tremble)};
    stroke.push_back(curve.at(begin + t * part) + bulge * push + (i % kSamples == 0 ? 0.0 : 1.0) * shake);
  }
  return stroke;
}

Points drag_point(const ClosedCurve& curve, double s, Point shift) {
  const double reach = 0.06 * curve.length();
  Points points = curve.points();
  for (int i = 0; i < curve.size(); ++i) {
    const double away = std::min(curve.forward(s, curve.s_at(i)), curve.forward(curve.s_at(i), s)) / reach;
    if (away < 1) points[i] += std::pow(1 - away * away, 2) * shift;
  }
  return points;
}

} // namespace oversketch::cli
