// Warping, in ns a pixel of the mask: one thread, quads of 16 px in the target.

#include "app/cli/bench_cases.h"

#include "core/image/pyramid.h"
#include "core/warp/warp.h"

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>

namespace oversketch::cli {
namespace {

constexpr double kQuad = 16;
/// How much the minified rows shrink the source.
constexpr double kShrink = 3;

/// Waves and grain, opaque.
Image make_source(int width, int height) {
  std::uint32_t state = 1;
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      state = state * 1664525 + 1013904223;
      const float grain = static_cast<float>(state >> 8) * 0x1p-27F;
      const float wave = 0.5F + 0.3F * std::sin(0.021F * static_cast<float>(x) + 0.034F * static_cast<float>(y));
      pixels.at(x, y) = {wave + grain, 0.9F * wave + grain, 0.8F * wave, 1};
    }
  return Image(std::move(pixels));
}

struct WarpBench {
  QuadMesh mesh;
  Points deformed;
  Mask mask;
  Image source;
};

/// A bent, turned square grid, and a smooth blob of about that many pixels in its middle.
WarpBench make_warp(double pixels, double shrink) {
  WarpBench out;
  const double radius = std::sqrt(pixels / std::numbers::pi);
  const int half = static_cast<int>(1.5 * radius / kQuad) + 2;
  const Point middle = Point{1, 1} * (kQuad * half * 1.5);
  const auto bend = [&](Point p) {
    const double wave = 2 * std::numbers::pi / (0.7 * radius), high = 0.025 * radius;
    p = p + Point{high * std::sin(wave * p.y), high * std::cos(wave * p.x)};
    return to_point(std::polar(1.0, 0.3) * to_complex(p)) + middle;
  };
  Points outline;
  for (int i = 0; i < 500; ++i) {
    const double angle = 2 * std::numbers::pi * i / 500;
    outline.push_back(bend(std::polar(radius, angle).real() * Point{1, 0} +
                           std::polar(radius, angle).imag() * Point{0, 1} +
                           0.06 * radius * Point{std::cos(3 * angle), std::sin(2 * angle)}));
  }
  out.mask = rasterize_polygon(outline, {0, 0, static_cast<int>(3 * kQuad * half), static_cast<int>(3 * kQuad * half)});

  // Only cells near the blob, as a region has them.
  std::map<std::pair<int, int>, int> vertices;
  const auto vertex = [&](int x, int y) {
    const auto [at, fresh] = vertices.try_emplace({x, y}, static_cast<int>(out.deformed.size()));
    if (fresh) {
      out.mesh.vertices.push_back(shrink * (kQuad * Point{x + half + 0.0, y + half + 0.0} + Point{1, 1}));
      out.deformed.push_back(bend(kQuad * Point{x + 0.0, y + 0.0}));
    }
    return at->second;
  };
  for (int y = -half; y < half; ++y)
    for (int x = -half; x < half; ++x)
      if (length(kQuad * Point{x + 0.5, y + 0.5}) < 1.08 * radius + kQuad)
        out.mesh.cells.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
  out.mesh.cell = shrink * kQuad;
  const int size = static_cast<int>(shrink * (2 * kQuad * half + 2));
  out.source = make_source(size, size);
  return out;
}

struct WarpRow {
  std::string name;
  bool shrunk;
  WarpOptions options;
};

Result<void> run_size(const std::string& size, double pixels, const BenchInput& input, BenchRecord& record) {
  WarpOptions plain, cubic;
  cubic.sampling = Sampling::kBicubic;
  for (const bool shrunk : {false, true}) {
    const WarpBench bench = make_warp(pixels, shrunk ? kShrink : 1);
    const ImagePyramid source(bench.source);
    const std::string item = std::to_string(bench.mask.count()) + " px";
    for (const auto& sampling : {std::pair{"bilinear", plain}, std::pair{"bicubic", cubic}}) {
      const std::string name = sampling.first;
      WarpOptions options = sampling.second;
      if (shrunk && options.sampling == Sampling::kBicubic) continue;
      for (const Simd simd : {Simd::kBest, Simd::kBaseline}) {
        options.simd = simd;
        const std::string row =
            "warp." + size + "." + (shrunk ? "minified" : name) + (simd == Simd::kBaseline ? ".baseline" : "");
        const auto done = record.repeat(
            row, item, input.runs,
            [&] { return warp_region(source, bench.mesh, bench.deformed, bench.mask, input.watch, nullptr, options); },
            1e6 / static_cast<double>(bench.mask.count()));
        if (!done) return done.error();
      }
    }
  }
  return {};
}

} // namespace

std::vector<BenchGroup> warp_benches() {
  return {
      {{{"warp.262k.bilinear", "ns", "a pixel of 262k, 16-px quads", BenchGoal{5.5}, 5.5},
        {"warp.262k.bilinear.baseline", "ns", "  without AVX2", {}, 11.8},
        {"warp.262k.bicubic", "ns", "  bicubic", {}, {}},
        {"warp.262k.bicubic.baseline", "ns", "  without AVX2", {}, {}},
        {"warp.262k.minified", "ns", "  shrunk to a third, the pyramid made", {}, {}},
        {"warp.262k.minified.baseline", "ns", "  without AVX2", {}, {}}},
       false,
       [](const BenchInput& input, BenchRecord& record) { return run_size("262k", 262'144, input, record); }},
      {{{"warp.1m.bilinear", "ns", "a pixel of 1M, 16-px quads", BenchGoal{5.5}, {}},
        {"warp.1m.bilinear.baseline", "ns", "  without AVX2", {}, {}},
        {"warp.1m.bicubic", "ns", "  bicubic", {}, {}},
        {"warp.1m.bicubic.baseline", "ns", "  without AVX2", {}, {}},
        {"warp.1m.minified", "ns", "  shrunk to a third, the pyramid made", {}, {}},
        {"warp.1m.minified.baseline", "ns", "  without AVX2", {}, {}}},
       false,
       [](const BenchInput& input, BenchRecord& record) { return run_size("1m", 1'048'576, input, record); }},
      {{{"warp.4m.bilinear", "ns", "a pixel of 4M, 16-px quads", BenchGoal{5.5}, {}},
        {"warp.4m.bilinear.baseline", "ns", "  without AVX2", {}, {}},
        {"warp.4m.bicubic", "ns", "  bicubic", {}, {}},
        {"warp.4m.bicubic.baseline", "ns", "  without AVX2", {}, {}},
        {"warp.4m.minified", "ns", "  shrunk to a third, the pyramid made", {}, {}},
        {"warp.4m.minified.baseline", "ns", "  without AVX2", {}, {}}},
       false,
       [](const BenchInput& input, BenchRecord& record) { return run_size("4m", 4'194'304, input, record); }},
  };
}

} // namespace oversketch::cli
