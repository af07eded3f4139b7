// Warping, in ns a pixel of the mask: one thread, quads of 16 px in the target.

#include "app/cli/bench_cases.h"

#include "core/image/pyramid.h"
#include "core/warp/warp.h"

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace oversketch::cli {
namespace {

constexpr double kQuad = 16;
/// How much the minified rows shrink the source.
constexpr double kShrink = 3;

/// Waves and grain, opaque.
Raster<Rgba> make_source(int width, int height) {
  std::uint32_t state = 1;
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      state = state * 1664525 + 1013904223;
      const float grain = static_cast<float>(state >> 8) * 0x1p-27F;
      const float wave = 0.5F + 0.3F * std::sin(0.021F * static_cast<float>(x) + 0.034F * static_cast<float>(y));
      pixels.at(x, y) = {wave + grain, 0.9F * wave + grain, 0.8F * wave, 1};
    }
  return pixels;
}

/// The same, each pixel half transparent or so.
Image make_translucent(const Image& opaque) {
  Raster<Rgba> pixels = opaque.pixels();
  int i = 0;
  for (Rgba& pixel : pixels.values())
    pixel.a = 0.3F + 0.1F * static_cast<float>(i++ % 5);
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
  out.source = Image(make_source(size, size));
  return out;
}

std::string prefix_of(const std::string& size) {
  return std::string("warp.").append(size).append(".");
}

Result<void> run_size(const std::string& size, double pixels, const BenchInput& input, BenchRecord& record) {
  const auto measure = [&](const std::string& name, const WarpBench& bench, const Image& picture, Sampling sampling) {
    const ImagePyramid source(picture);
    WarpOptions options;
    options.sampling = sampling;
    for (const Simd simd : {Simd::kBest, Simd::kBaseline}) {
      options.simd = simd;
      // As a session does: into the memory of a result that it has dropped.
      Raster<Rgba> spare;
      const auto done = record.repeat(
          prefix_of(size) + name + (simd == Simd::kBaseline ? ".baseline" : ""),
          std::to_string(bench.mask.count()) + " px", input.runs,
          [&]() -> Result<void> {
            auto warped = warp_region(source, bench.mesh, bench.deformed, bench.mask, input.watch, nullptr, options,
                                      std::move(spare));
            if (!warped) return warped.error();
            spare = std::move(warped->pixels);
            return {};
          },
          1e6 / static_cast<double>(bench.mask.count()));
      if (!done) return done;
    }
    return Result<void>();
  };
  const WarpBench plain = make_warp(pixels, 1);
  if (auto done = measure("bilinear", plain, plain.source, Sampling::kBilinear); !done) return done;
  if (auto done = measure("bicubic", plain, plain.source, Sampling::kBicubic); !done) return done;
  if (auto done = measure("alpha", plain, make_translucent(plain.source), Sampling::kBilinear); !done) return done;
  const WarpBench shrunk = make_warp(pixels, kShrink);
  return measure("minified", shrunk, shrunk.source, Sampling::kBilinear);
}

std::vector<BenchRow> rows_of(const std::string& size, std::optional<double> prototype,
                              std::optional<double> baseline_prototype) {
  const std::string name = prefix_of(size);
  const auto baseline = [&](const std::string& row, std::optional<double> before = {}) {
    return BenchRow{name + row + ".baseline", "ns", "  without AVX2", {}, before};
  };
  return {{name + "bilinear", "ns", std::string("a pixel of ").append(size).append(", 16-px quads"), BenchGoal{5.5},
           prototype},
          baseline("bilinear", baseline_prototype),
          {name + "bicubic", "ns", "  bicubic", {}, {}},
          baseline("bicubic"),
          {name + "alpha", "ns", "  bilinear, the source translucent", {}, {}},
          baseline("alpha"),
          {name + "minified", "ns", "  shrunk to a third, the pyramid made", {}, {}},
          baseline("minified")};
}

} // namespace

std::vector<BenchGroup> warp_benches() {
  std::vector<BenchGroup> groups;
  const auto add = [&](const std::string& size, double pixels, std::vector<BenchRow> rows) {
    groups.push_back({std::move(rows), false, [=](const BenchInput& input, BenchRecord& record) {
                        return run_size(size, pixels, input, record);
                      }});
  };
  add("262k", 262'144, rows_of("262k", 5.5, 11.8));
  add("1m", 1'048'576, rows_of("1m", {}, {}));
  add("4m", 4'194'304, rows_of("4m", {}, {}));
  return groups;
}

} // namespace oversketch::cli
