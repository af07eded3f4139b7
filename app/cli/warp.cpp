#include "app/cli/deform_options.h"

#include "core/geometry/curve.h"
#include "core/image/image_io.h"
#include "core/session/case_file.h"
#include "core/session/report.h"
#include "core/warp/warp.h"

#include <cmath>
#include <filesystem>
#include <memory>

namespace oversketch::cli {
namespace {

struct WarpArguments {
  std::string image, outline, sketch, out;
  int depth = 8;
  DeformOptions deform;
  WarpOptions warp;
};

/// A curve that is sound and, where it must, lies in the picture.
Result<Points> read_curve(const std::string& path, const char* what, const std::vector<std::string>& keys) {
  auto points = read_points(path, keys);
  if (!points) return points.error();
  if (auto sound = check_closed_curve(*points, what); !sound) return at(path, sound.error());
  return points;
}

/// The picture's size, enlarged to the right and downwards as far as the sketch reaches.
Result<Rect> canvas_for(const Image& image, const Points& sketch) {
  const Box box = bounds(sketch);
  const double width = std::max<double>(image.width(), std::ceil(box.high.x));
  const double height = std::max<double>(image.height(), std::ceil(box.high.y));
  if (width * height > static_cast<double>(kMaxPixels))
    return Error{"warp.too-large", "the picture would have more than 200 megapixels", ""};
  return Rect{0, 0, static_cast<int>(width), static_cast<int>(height)};
}

Result<Json> warp(const WarpArguments& options, const Watch& watch) {
  if (std::filesystem::path(options.out).has_extension() && !keeps_alpha(options.out))
    return Error{"image.no-alpha", "the region is transparent outside, which only PNG can hold: end the name in .png",
                 options.out};
  const auto image = load_image(options.image);
  if (!image) return image.error();
  auto outline = read_curve(options.outline, "outline", {"outline", "points"});
  if (!outline) return outline.error();
  for (const Point p : *outline)
    if (p.x < 0 || p.y < 0 || p.x > image->width() || p.y > image->height())
      return Error{"region.outside-source",
                   "the outline leaves the picture at (" + Json(p.x).dump() + ", " + Json(p.y).dump() + ")",
                   options.outline};
  auto sketch = read_curve(options.sketch, "sketch", {"sketch", "curve", "points"});
  if (!sketch) return sketch.error();
  const auto canvas = canvas_for(*image, *sketch);
  if (!canvas) return canvas.error();

  const auto solved = solve_case({"", *outline, *sketch, {}, {}}, options.deform, watch);
  if (!solved) return solved.error();
  const Deformation& deformation = solved->deformation;
  const Mask mask = rasterize_polygon(deformation.boundary, *canvas);
  Raster<Rgba> pixels(canvas->width, canvas->height, {0, 0, 0, 0});
  if (!mask.empty()) {
    const StageTimer timer(watch.times, "warp");
    const Mask region = rasterize_polygon(*outline, image->rect());
    WarpOptions how = options.warp;
    how.threads = watch.threads_up_to(2);
    const auto warped = warp_region(*image, *deformation.mesh, deformation.positions, mask, watch, &region, how);
    if (!warped) return warped.error();
    for (const Mask::Run& run : mask.runs())
      for (int x = run.x0; x < run.x1; ++x)
        pixels.at(x, run.y) = warped->pixels.at(x - warped->rect.x, run.y - warped->rect.y);
  }
  const auto saved =
      save_image(Image(std::move(pixels)), options.out, options.depth == 16 ? BitDepth::k16 : BitDepth::k8);
  if (!saved) return saved.error();
  Json report;
  report["pixels"] = mask.count();
  report["metrics"] = metrics_json(solved->metrics);
  return report;
}

} // namespace

void add_warp(Cli& cli) {
  const auto options = std::make_shared<WarpArguments>();
  CLI::App* sub = cli.add("warp", "Deform part of a picture and write it alone, transparent outside.",
                          "warp --image fish.png --outline outline.json --sketch sketch.json --out bent.png");
  sub->add_option("--image", options->image, "the picture")->required()->type_name("I");
  sub->add_option("--outline", options->outline, "[[x, y], …] or {\"outline\": …}, pixels of the picture")
      ->required()
      ->type_name("O.json");
  sub->add_option("--sketch", options->sketch, "[[x, y], …] or {\"sketch\": …}, pixels of the output")
      ->required()
      ->type_name("S.json");
  sub->add_option("--out", options->out, "PNG; as large as the picture, or larger where the sketch needs it")
      ->required()
      ->type_name("PICTURE");
  sub->add_option("--depth", options->depth, "bits a channel: 8 or 16")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  const auto set_sampling = [options](const std::string& name) {
    options->warp.sampling = name == "bicubic" ? Sampling::kBicubic : Sampling::kBilinear;
  };
  sub->add_option_function<std::string>("--sampling", set_sampling,
                                        "how the picture is read: bilinear (default), bicubic")
      ->check(CLI::IsMember({"bilinear", "bicubic"}))
      ->type_name("SAMPLING");
  add_deform_options(sub, options->deform);
  cli.on_run(sub, [options](const Watch& watch) { return warp(*options, watch); });
}

} // namespace oversketch::cli
