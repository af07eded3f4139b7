// How far what is painted is from the exact solution, pixel by pixel, on photographs.

#include "app/cli/bench_shapes.h"
#include "app/cli/figures.h"

#include "core/base/file.h"
#include "core/clone/clone.h"
#include "core/clone/correction.h"
#include "core/clone/guidance.h"
#include "core/clone/pixel_solver.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace oversketch::cli {
namespace {

/// Photographs are shown pixel by pixel.
constexpr int kTile = 380, kGap = 36, kRowHead = 92, kRowFoot = 56;

struct Subject {
  std::string name, source, target;
  Mask (*make)(double pixels) = nullptr;
  double pixels = 0;
};

struct Step {
  std::string name;
  CloneQuality quality = CloneQuality::kDrag;
  /// What is shown as white, levels.
  double most = 1;
};

const std::array kSteps{Step{"while dragging, k = 2", CloneQuality::kDrag, 1},
                        Step{"at rest, k = 4", CloneQuality::kRest, 0.25}, Step{"export", CloneQuality::kExport, 0.03}};

/// The middle of a picture; where it ends its edge pixels go on.
Result<Raster<Rgba>> read_tile(const std::filesystem::path& path) {
  const auto image = load_image(path);
  if (!image) return image.error();
  Raster<Rgba> tile(kTile, kTile);
  const int left = (image->width() - kTile) / 2, top = (image->height() - kTile) / 2;
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      tile.at(x, y) =
          image->at(std::clamp(left + x, 0, image->width() - 1), std::clamp(top + y, 0, image->height() - 1));
      tile.at(x, y).a = 1;
    }
  return tile;
}

/// The mask in the middle of the tile.
Mask centred_mask(const Subject& subject) {
  const Mask mask = subject.make(subject.pixels);
  const Rect box = mask.bounds();
  return intersect(translated(mask, (kTile - box.width) / 2 - box.x, (kTile - box.height) / 2 - box.y),
                   {1, 1, kTile - 2, kTile - 2});
}

/// Black, blue, red, yellow, white.
Rgba heat(double part) {
  constexpr std::array<std::uint32_t, 5> kColors = {0x0B0B14, 0x3A2FA8, 0xD6304A, 0xFFC233, 0xFFFFFF};
  const double at = std::clamp(part, 0.0, 1.0) * (kColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kColors.size() - 2);
  const Rgba a = color_of(kColors[below]), b = color_of(kColors[below + 1]);
  const auto t = static_cast<float>(at - static_cast<double>(below));
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), 1};
}

struct ErrorMap {
  Raster<Rgba> picture;
  double worst = 0;
  double mean = 0;
};

class Scene {
public:
  Scene(Raster<Rgba> source, Raster<Rgba> target, CloneSystem system)
      : source_{source.rect(), std::move(source)}, target_(std::move(target)), system_(std::move(system)) {}

  Result<Raster<Rgba>> blended(const Watch& watch) const {
    Raster<Rgba> out = target_;
    const auto done = clone_into(out, source_, 0, 0, system_, {}, CloneQuality::kExport, watch);
    if (!done) return done.error();
    return out;
  }

  Result<std::vector<Channels>> exact(const Watch& watch) const {
    const auto solver = PixelSolver::make(system_.mask(), watch);
    if (!solver) return solver.error();
    return solver->solve(membrane_side(pair(), system_.graph()));
  }

  Result<ErrorMap> errors(const Step& step, const std::vector<Channels>& exact, const Watch& watch) const {
    const auto near = solve_correction(pair(), system_, {}, step.quality, watch.threads_up_to(2), watch);
    if (!near) return near.error();
    ErrorMap map{Raster<Rgba>(kTile, kTile, color_of(kRuleColor)), 0, 0};
    std::size_t pixel = 0;
    std::vector<Float4> line;
    for (std::size_t run = 0; run < system_.mask().runs().size(); ++run) {
      const Mask::Run& at = system_.mask().runs()[run];
      near->read(run, at, line);
      for (int x = at.x0; x < at.x1; ++x, ++pixel) {
        double error = 0;
        for (std::size_t k = 0; k < 3; ++k)
          error = std::max(error, 255 * std::abs(static_cast<double>(line[static_cast<std::size_t>(x - at.x0)][k]) -
                                                 exact[pixel].v[k]));
        map.worst = std::max(map.worst, error);
        map.mean += error / static_cast<double>(exact.size());
        map.picture.at(x, at.y) = heat(error / step.most);
      }
    }
    return map;
  }

private:
  PlacedPair pair() const { return PlacedPair(target_, source_, 0, 0, kPlain); }

  static constexpr BlendOptions kPlain{};
  WarpedRegion source_;
  Raster<Rgba> target_;
  CloneSystem system_;
};

Result<Scene> make_scene(const FigureInput& input, const Subject& subject) {
  auto source = read_tile(input.samples / subject.source);
  if (!source) return source.error();
  auto target = read_tile(input.samples / subject.target);
  if (!target) return target.error();
  auto system = CloneSystem::make(centred_mask(subject));
  if (!system) return system.error();
  return Scene(std::move(*source), std::move(*target), std::move(*system));
}

double left_of(std::size_t column) {
  return kMargin + static_cast<double>(column) * (kTile + kGap);
}

Result<Json> draw_row(Page& page, const FigureInput& input, const Subject& subject, int top) {
  const Watch& watch = *input.watch;
  const auto scene = make_scene(input, subject);
  if (!scene) return scene.error();
  const auto blended = scene->blended(watch);
  if (!blended) return blended.error();
  const auto exact = scene->exact(watch);
  if (!exact) return exact.error();
  const auto middle = [](std::size_t column) { return left_of(column) + 0.5 * kTile; };
  page.draw(*blended, static_cast<int>(left_of(0)), top + kRowHead);
  page.write({{subject.name, kInkColor, true}}, kTextSize, {middle(0), top + 40.0}, Align::kCentre);
  page.write({{number_text(static_cast<double>(exact->size()), 0) + " pixels", kQuietColor}}, kSmallSize,
             {middle(0), top + 72.0}, Align::kCentre);
  Json row{{"mask", subject.name}, {"pixels", exact->size()}};
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const Step& step = kSteps[i];
    const auto map = scene->errors(step, *exact, watch);
    if (!map) return map.error();
    page.draw(map->picture, static_cast<int>(left_of(i + 1)), top + kRowHead);
    page.write({{step.name, kAccentColor, true}, {"   white = " + number_text(step.most, 2), kQuietColor}}, kSmallSize,
               {middle(i + 1), top + 40.0}, Align::kCentre);
    page.write({{"worst ", kQuietColor},
                {number_text(map->worst, 3), kInkColor, true},
                {"   mean ", kQuietColor},
                {number_text(map->mean, 4), kInkColor, true}},
               kSmallSize, {middle(i + 1), top + 72.0}, Align::kCentre);
    row["steps"].push_back({{"step", step.name}, {"worst_levels", map->worst}, {"mean_levels", map->mean}});
  }
  return row;
}

} // namespace

Result<Json> draw_errors(const FigureInput& input) {
  const std::array subjects{Subject{"blob", "giraffe.jpg", "sea_sand_bg.jpg", make_blob, 75'000},
                            Subject{"snake", "sea_sand_bg.jpg", "kingfisher.jpg", make_snake, 8'000},
                            Subject{"holed", "kingfisher.jpg", "giraffe.jpg", make_holed, 75'000}};
  constexpr int kRow = kRowHead + kTile + kRowFoot;
  const int width = 2 * kMargin + 4 * kTile + 3 * kGap;
  Page page(width, kHeadHeight + kRow * static_cast<int>(subjects.size()), input.lettering);
  page.head("How far what is painted is from the exact solution",
            "Gradients imported; the largest difference of a channel in each pixel, in 8-bit levels");
  Json rows = Json::array();
  int top = kHeadHeight;
  for (const Subject& subject : subjects) {
    page.rule(top);
    auto row = draw_row(page, input, subject, top);
    if (!row) return row.error();
    rows.push_back(std::move(*row));
    top += kRow;
  }
  const auto saved = save_page(input, std::move(page), "errors.png");
  if (!saved) return saved.error();
  const auto written = write_file(input.out / "errors.json", Json{{"rows", rows}}.dump(1) + "\n");
  if (!written) return written.error();
  return Json::array({*saved, "errors.json"});
}

} // namespace oversketch::cli
