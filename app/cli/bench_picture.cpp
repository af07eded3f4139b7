// Cloning and warping, in ms a picture and ns a pixel.

#include "app/cli/bench_cases.h"
#include "app/cli/bench_shapes.h"

#include "core/clone/guidance.h"
#include "core/clone/pixel_solver.h"
#include "core/clone/placed_pair.h"
#include "core/warp/warp.h"

#include <cmath>

namespace oversketch::cli {
namespace {

/// What a blend cannot go without: each pixel of source and target read, and the target written.
void mix_pixels(Raster<Rgba>& target, const WarpedRegion& source, const Mask& mask) {
  for (const Mask::Run& run : mask.runs()) {
    const Rgba* from = &source.pixels.at(run.x0 - source.rect.x, run.y - source.rect.y);
    Rgba* to = &target.at(run.x0, run.y);
    for (int i = 0; i < run.x1 - run.x0; ++i)
      to[i] = {0.5f * (from[i].r + to[i].r), 0.5f * (from[i].g + to[i].g), 0.5f * (from[i].b + to[i].b), 1};
  }
}

struct CloneSize {
  std::string name;
  double pixels;
};

Result<void> run_clone(const CloneSize& size, const BenchInput& input, BenchRecord& record) {
  const Mask mask = make_blob(size.pixels);
  const Rect box = mask.bounds();
  const auto source = unwarped_region(Image(make_picture(box.x + box.width + 8, box.y + box.height + 8, 1)), mask);
  if (!source) return source.error();
  const Raster<Rgba> picture = make_picture(box.x + box.width + 40, box.y + box.height + 40, 2);
  const auto make = [&] { return PixelSolver::make(mask, input.watch); };
  if (auto done = record.repeat(size.name + ".setup", "blob", std::min(input.runs, 3), make); !done)
    return done.error();
  const auto solver = make();
  if (!solver) return solver.error();

  Raster<Rgba> target = picture;
  int moves = 0;
  const auto move = [&](BlendMode mode) {
    BlendOptions options;
    options.mode = mode;
    const int shift = moves++ % 16;
    const PlacedPair pair(picture, *source, shift, 16 - shift, options);
    const PixelGraph& graph = solver->graph();
    return Result<std::vector<Channels>>(
        solver->solve(mode == BlendMode::kMixed ? mixed_side(pair, graph) : membrane_side(pair, graph)));
  };
  auto done = record.repeat(size.name + ".move", "blob", input.runs, [&] { return move(BlendMode::kImport); });
  if (!done) return done.error();
  done = record.repeat(size.name + ".mixed", "blob", input.runs, [&] { return move(BlendMode::kMixed); });
  if (!done) return done.error();
  target = picture;
  done = record.repeat(size.name + ".floor", "blob", 4 * input.runs, [&] {
    mix_pixels(target, *source, mask);
    return Result<void>();
  });
  if (!done) return done.error();
  const auto moved = record.summarize(size.name + ".move"), floor = record.summarize(size.name + ".floor");
  if (moved && floor) record.add_value(size.name + ".floors", "blob", moved->median / floor->median);
  return {};
}

Result<void> run_small_clone(const BenchInput& input, BenchRecord& record) {
  return run_clone({"clone.reference.65k", 65'536}, input, record);
}

Result<void> run_large_clone(const BenchInput& input, BenchRecord& record) {
  return run_clone({"clone.reference.262k", 262'144}, input, record);
}

/// Each case, scaled so that its sketch covers 262144 px, drawn with cells of at most 16 px.
Result<void> run_warp(const BenchInput& input, BenchRecord& record) {
  for (const BenchCase& c : input.cases) {
    const double scale = std::sqrt(262'144 / std::abs(c.sketch.signed_area()));
    DeformOptions options;
    options.cell_px = std::min(16 / scale, c.flipfree.region().mesh().cell);
    DeformCounts counts;
    const auto system = DeformSystem::make(c.given.outline, options, &c.drawn, counts, input.watch);
    if (!system) return at(c.given.name, system.error());
    const Deformation drawn = system->redisplay(c.solved);

    const Box box = bounds(drawn.mesh->vertices), reach = bounds(drawn.boundary);
    const auto place = [&](Point low) { return Similarity{scale, to_complex(Point{8, 8} - scale * low)}; };
    QuadMesh mesh = *drawn.mesh;
    mesh.vertices = transformed(mesh.vertices, place(box.low));
    mesh.cell *= scale;
    const Points deformed = transformed(drawn.positions, place(reach.low));
    const Point size = scale * box.size(), span = scale * reach.size();
    const Image image(make_picture(static_cast<int>(size.x) + 16, static_cast<int>(size.y) + 16, 3));
    const Mask mask = rasterize_polygon(transformed(drawn.boundary, place(reach.low)),
                                        {0, 0, static_cast<int>(span.x) + 16, static_cast<int>(span.y) + 16});
    const Mask region = rasterize_polygon(transformed(c.given.outline, place(box.low)), image.rect());
    const auto done = record.repeat(
        "warp.ns_per_pixel", c.given.name, input.runs,
        [&] { return warp_region(image, mesh, deformed, mask, input.watch, &region); },
        1e6 / static_cast<double>(mask.count()));
    if (!done) return done.error();
  }
  return {};
}

} // namespace

std::vector<BenchGroup> picture_benches() {
  return {
      {{{"clone.reference.65k.setup", "ms", "65k pixels: factorization", {}, {}},
        {"clone.reference.65k.move", "ms", "  a solution, gradients imported", {}, 10.0},
        {"clone.reference.65k.mixed", "ms", "  a solution, gradients mixed", {}, {}},
        {"clone.reference.65k.floor", "ms", "  both pictures read, one written", {}, {}},
        {"clone.reference.65k.floors", "ratio", "  a solution by that floor", {}, {}}},
       false,
       run_small_clone},
      {{{"clone.reference.262k.setup", "ms", "262k pixels: factorization", {}, {}},
        {"clone.reference.262k.move", "ms", "  a solution, gradients imported", {}, 59.0},
        {"clone.reference.262k.mixed", "ms", "  a solution, gradients mixed", {}, {}},
        {"clone.reference.262k.floor", "ms", "  both pictures read, one written", {}, {}},
        {"clone.reference.262k.floors", "ratio", "  a solution by that floor", {}, {}}},
       false,
       run_large_clone},
      {{{"warp.ns_per_pixel", "ns", "a deformed region drawn, a pixel of 262k", {}, 5.5}}, true, run_warp},
  };
}

} // namespace oversketch::cli
