#include "app/cli/cli.h"

#include "core/clone/clone.h"
#include "core/document/command_table.h"
#include "core/image/image_io.h"
#include "core/warp/warp.h"

#include <charconv>
#include <chrono>
#include <memory>

namespace oversketch::cli {
namespace {

struct CloneArguments {
  std::string source, target, mask, out, at = "0,0", mode = "import", domain = "encoded";
  double strength = 1, feather_px = 0, screening_px = 0;
  int depth = 8;
};

struct Shift {
  int x = 0, y = 0;
};

Result<Shift> parse_shift(const std::string& text) {
  Shift shift;
  const char *first = text.data(), *last = first + text.size();
  const auto x = std::from_chars(first, last, shift.x);
  if (x.ec == std::errc() && x.ptr != last && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, last, shift.y);
    constexpr int kFurthest = 1 << 20;
    if (y.ec == std::errc() && y.ptr == last && std::abs(shift.x) <= kFurthest && std::abs(shift.y) <= kFurthest)
      return shift;
  }
  return Error{"clone.at", "--at takes two whole numbers X,Y within a million, not \"" + text + "\"", ""};
}

/// White pastes, black does not: the pixels whose mean level, weighed by alpha, is 128 or more.
Mask mask_from(const Image& image) {
  std::vector<Mask::Run> runs;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgba& p = image.at(x, y);
      if ((p.r + p.g + p.b) / 3 * p.a < 127.5f / 255) continue;
      if (!runs.empty() && runs.back().y == y && runs.back().x1 == x)
        ++runs.back().x1;
      else
        runs.push_back({y, x, x + 1});
    }
  return Mask(std::move(runs));
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Result<BlendOptions> blend_options(const CloneArguments& options) {
  BlendOptions blend;
  const auto mode = parse_blend_mode(options.mode);
  if (!mode) return mode.error();
  const auto domain = parse_domain(options.domain);
  if (!domain) return domain.error();
  blend.mode = *mode;
  blend.domain = *domain;
  // Within the bounds of a layer's settings.
  LayerSet settings;
  settings.strength = blend.strength = options.strength;
  settings.feather_px = blend.feather_px = options.feather_px;
  settings.screening = options.screening_px;
  if (const auto good = check_values(settings); !good) return good.error();
  blend.screening = screening_for(options.screening_px);
  return blend;
}

struct Inputs {
  Image source, target;
  Mask mask;
};

/// @param memory_bytes  for all pictures together.
Result<Inputs> read_inputs(const CloneArguments& options, std::size_t memory_bytes, const Watch& watch) {
  const StageTimer timer(watch.times, "read");
  auto pixels_left = static_cast<std::int64_t>(memory_bytes / sizeof(Rgba));
  const auto load = [&](const std::string& path) {
    auto image = load_image(path, pixels_left);
    if (image) pixels_left -= static_cast<std::int64_t>(image->pixels().values().size());
    return image;
  };
  auto source = load(options.source);
  if (!source) return source.error();
  auto target = load(options.target);
  if (!target) return target.error();
  const auto mask = load(options.mask);
  if (!mask) return mask.error();
  if (mask->width() != source->width() || mask->height() != source->height())
    return Error{"clone.mask-size",
                 "the mask is " + std::to_string(mask->width()) + " × " + std::to_string(mask->height()) +
                     " px, the source " + std::to_string(source->width()) + " × " + std::to_string(source->height()) +
                     ": they must be equal",
                 options.mask};
  Inputs inputs{std::move(*source), std::move(*target), mask_from(*mask)};
  if (inputs.mask.empty())
    return Error{"clone.empty-mask", "the mask has no white pixel: there is nothing to paste", options.mask};
  return inputs;
}

Result<Json> clone(const CloneArguments& options, const IoLimits& limits, const Watch& watch) {
  const auto shift = parse_shift(options.at);
  if (!shift) return shift.error();
  const auto blend = blend_options(options);
  if (!blend) return blend.error();
  const auto inputs = read_inputs(options, limits.memory_bytes, watch);
  if (!inputs) return inputs.error();

  auto region = unwarped_region(inputs->source, inputs->mask);
  if (!region) return region.error();
  const Mask mask = opaque_part(*region, inputs->mask);
  if (mask.empty()) return Error{"clone.empty-mask", "the source is transparent all over the mask", options.source};

  Raster<Rgba> pixels = inputs->target.pixels();
  Json report;
  const auto setup_start = std::chrono::steady_clock::now();
  CloneReport done;
  double setup_ms = 0, solve_ms = 0;
  if (blend->mode == BlendMode::kNone) {
    const auto start = std::chrono::steady_clock::now();
    const auto pasted = paste_into(pixels, *region, mask, shift->x, shift->y, *blend, watch);
    if (!pasted) return pasted.error();
    done = *pasted, solve_ms = ms_since(start);
  } else {
    const auto system = CloneSystem::make(mask);
    if (!system) return system.error();
    if (const auto ready = system->prepare(*blend, CloneQuality::kExport, watch); !ready) return ready.error();
    setup_ms = ms_since(setup_start);
    const auto start = std::chrono::steady_clock::now();
    const auto cloned = clone_into(pixels, *region, shift->x, shift->y, *system, *blend, CloneQuality::kExport, watch);
    if (!cloned) return cloned.error();
    done = *cloned, solve_ms = ms_since(start);
  }
  const StageTimer timer(watch.times, "write");
  const auto saved =
      save_image(Image(std::move(pixels)), options.out, options.depth == 16 ? BitDepth::k16 : BitDepth::k8);
  if (!saved) return saved.error();
  report["unknowns"] = done.unknowns;
  report["setup_ms"] = setup_ms;
  report["solve_ms"] = solve_ms;
  report["residual_levels"] = done.residual_levels;
  return report;
}

} // namespace

void add_clone(Cli& cli) {
  const auto options = std::make_shared<CloneArguments>();
  CLI::App* sub =
      cli.add("clone", "Blend part of one picture into another without a seam.",
              "clone --source fish.png --target sea.jpg --mask mask.png --at 400,300 --mode mixed --out out.png");
  sub->add_option("--source", options->source, "the picture that is pasted")->required()->type_name("S");
  sub->add_option("--target", options->target, "the picture that it is pasted into")->required()->type_name("T");
  sub->add_option("--mask", options->mask,
                  "as large as the source; pasted where it is white: level 128 or more of 255, the "
                  "mean of red, green and blue times alpha")
      ->required()
      ->type_name("M");
  sub->add_option("--at", options->at, "where the source's top left corner lands; may be negative or hang out")
      ->type_name("X,Y")
      ->capture_default_str();
  sub->add_option(
         "--mode", options->mode,
         "import, mixed, monochrome, average or none; monochrome takes the source's light and dark only, and so "
         "changes even a target that equals a source in colour")
      ->check(CLI::IsMember({"import", "mixed", "monochrome", "average", "none"}))
      ->type_name("MODE")
      ->capture_default_str();
  sub->add_option("--strength", options->strength, "part of the colour correction, 0 to 1")
      ->type_name("S")
      ->capture_default_str();
  sub->add_option("--domain", options->domain, "encoded, linear or log")
      ->check(CLI::IsMember({"encoded", "linear", "log"}))
      ->type_name("DOMAIN")
      ->capture_default_str();
  sub->add_option("--feather", options->feather_px,
                  "width over which a strength below 1, or mode none, sets in, 0 to 1000")
      ->type_name("PX")
      ->capture_default_str();
  sub->add_option("--screening", options->screening_px,
                  "how far from the edge the colour correction dies away, to 100000; 0: it does not")
      ->type_name("PX")
      ->capture_default_str();
  sub->add_option("--depth", options->depth, "bits a channel: 8, or 16 for PNG")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  sub->add_option("--out", options->out, "PNG or JPEG, by its extension")->required()->type_name("PICTURE");
  cli.add_memory_option(sub);
  cli.on_run(sub, [options, &cli](const Watch& watch) { return clone(*options, cli.limits(), watch); });
}

} // namespace oversketch::cli
