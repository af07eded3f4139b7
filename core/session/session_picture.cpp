// How a session's picture is put together: shapes, blending, composites.

#include "core/clone/clone.h"
#include "core/session/layer_input.h"
#include "core/session/session_caches.h"
#include "core/session/session_solve.h"
#include "core/warp/warp.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// The pasted region's mask: the raster of its deformed boundary.
Result<Mask> raster_of(const Points& boundary) {
  const Box box = bounds(boundary);
  for (const Point p : {box.low, box.high})
    if (!is_finite(p) || std::abs(p.x) >= kMaskCoordinateLimit || std::abs(p.y) >= kMaskCoordinateLimit)
      return Error{"layer.too-far", "the deformed region reaches more than a million pixels away", ""};
  const int x = static_cast<int>(std::floor(box.low.x)), y = static_cast<int>(std::floor(box.low.y));
  const Rect clip{x, y, static_cast<int>(std::ceil(box.high.x)) - x, static_cast<int>(std::ceil(box.high.y)) - y};
  return rasterize_polygon(boundary, clip);
}

WarpedRegion part_of(const Raster<Rgba>& pixels, const Rect& rect) {
  WarpedRegion part{rect, Raster<Rgba>(rect.width, rect.height, Unset{})};
  for (int y = 0; y < rect.height; ++y)
    std::copy_n(pixels.row(rect.y + y).begin() + rect.x, rect.width, part.pixels.row(y).begin());
  return part;
}

void paste(const WarpedRegion& part, Raster<Rgba>& pixels) {
  for (int y = 0; y < part.rect.height; ++y)
    std::ranges::copy(part.pixels.row(y), pixels.row(part.rect.y + y).begin() + part.rect.x);
}

/// Whether no colour is darker than black or brighter than white, as in every picture of whole numbers.
bool is_within_white(const Raster<Rgba>& pixels) {
  const auto is_within = [](float v) { return v >= 0 && v <= 1; };
  return std::ranges::all_of(pixels.values(),
                             [&](const Rgba& p) { return is_within(p.r) && is_within(p.g) && is_within(p.b); });
}

void cut_to_white(Raster<Rgba>& pixels, const Rect& rect) {
  for (int y = rect.y; y < rect.bottom(); ++y)
    for (Rgba& p : pixels.row(y).subspan(static_cast<std::size_t>(rect.x), static_cast<std::size_t>(rect.width)))
      for (float* const v : {&p.r, &p.g, &p.b})
        *v = std::clamp(*v, 0.0F, 1.0F);
}

/// What a region is blended onto, within the picture: its place and the ring round it.
Rect ground_of(const LayerShape& shape, const Layer& layer, const Rect& picture) {
  Rect rect = grown(shape.mask.bounds(), 1);
  rect.x += layer.placement.dx;
  rect.y += layer.placement.dy;
  return intersect(rect, picture);
}

} // namespace

ImagePyramid Session::source_of(const Layer& layer) {
  const Hash key = layer.source.image.content_hash();
  if (const auto cached = caches_->sources.find(key)) return *cached;
  return *caches_->sources.put(key, std::make_shared<const ImagePyramid>(layer.source.image));
}

Result<std::shared_ptr<const LayerShape>> Session::shape_of(const Layer& layer, const Solve& solve, bool needs_system,
                                                            const Watch& watch) {
  const Hash key = shape_key(layer, solve.deformation);
  auto shape = caches_->shapes.find(key);
  if (shape && (shape->system || !needs_system || shape->mask.empty())) return shape;

  auto made = std::make_shared<LayerShape>();
  if (shape) {
    *made = *shape;
  } else {
    const auto deformed = run(solve, watch);
    if (!deformed) return deformed.error();
    const Similarity place = layer.placement.sub_pixel();
    StageTimer timer(watch.times, "warp");
    auto mask = raster_of(transformed((*deformed)->boundary, place));
    if (!mask) return at(place_of(layer), mask.error());
    if (!mask->empty()) {
      const Mask region = rasterize_polygon(layer.outline, layer.source.image.rect());
      WarpOptions options = warp_options(layer);
      // More hardly pays beside the memory's speed.
      options.threads = watch.threads_up_to(2);
      options.most_pixels = static_cast<std::int64_t>(memory_bytes_ / kLayerPixelBytes);
      // All shapes are made above, not const, and nobody sees this one any more.
      const auto dropped = std::const_pointer_cast<LayerShape>(caches_->shapes.drop_last());
      auto warped = warp_region(source_of(layer), *(*deformed)->mesh, transformed((*deformed)->positions, place), *mask,
                                watch, &region, options, dropped ? std::move(dropped->warped.pixels) : Raster<Rgba>());
      if (!warped) return at(place_of(layer), warped.error());
      made->mask = opaque_part(*warped, *mask);
      made->warped = std::move(*warped);
    }
  }
  if (needs_system && !made->mask.empty()) {
    StageTimer timer(watch.times, "mask");
    auto system = CloneSystem::make(made->mask);
    if (!system) return at(place_of(layer), system.error());
    made->system = std::make_shared<const CloneSystem>(std::move(*system));
    ++counters_.mask_setups;
  }
  return caches_->shapes.put(key, std::move(made));
}

Result<WarpedRegion> Session::blend(const Layer& layer, bool onto_seen, Raster<Rgba>& pixels, const Watch& watch) {
  const auto shape = shape_of(layer, solve_of(layer), layer.settings.mode != CloneMode::kNone, watch);
  if (!shape) return shape.error();
  if ((*shape)->mask.empty()) return WarpedRegion{};
  StageTimer timer(watch.times, "blend");
  const LayerShape& s = **shape;
  const auto [dx, dy] = std::pair(layer.placement.dx, layer.placement.dy);
  WarpedRegion unseen;
  if (onto_seen) {
    unseen = part_of(pixels, ground_of(s, layer, pixels.rect()));
    cut_to_white(pixels, unseen.rect);
  }
  const auto report =
      layer.settings.mode == CloneMode::kNone
          ? paste_into(pixels, s.warped, s.mask, dx, dy, blend_options(layer), watch)
          : clone_into(pixels, s.warped, dx, dy, *s.system, blend_options(layer), CloneQuality::kExport, watch);
  if (!report) return at(place_of(layer), report.error());
  ++counters_.clone_solves;
  WarpedRegion painted = part_of(pixels, report->changed);
  if (onto_seen) {
    paste(unseen, pixels);
    paste(painted, pixels);
  }
  return painted;
}

Result<Image> Session::composite_until(const Document& document, std::size_t count, const Watch& watch) {
  if (document.empty()) return Error{"document.none", "there is no document yet: begin with document.new", ""};
  std::vector<const Layer*> drawn;
  for (std::size_t i = 0; i < count; ++i)
    if (is_drawn(document.layers[i])) drawn.push_back(&document.layers[i]);
  std::vector<Hash> keys{document.target.image.content_hash()};
  for (const Layer* layer : drawn)
    keys.push_back(Hasher().add(keys.back()).add(blend_key(*layer, solve_of(*layer).deformation)).finish());

  // The highest picture that is still there, then what stands above it.
  std::size_t have = drawn.size();
  Image picture = document.target.image;
  for (; have > 0; --have)
    if (const auto cached = caches_->composites.find(keys[have])) {
      picture = *cached;
      break;
    }
  if (have == drawn.size()) return picture;
  // Of a target beyond white, what is beyond is meant.
  const bool cuts = drawn.size() > 1 && is_within_white(document.target.image.pixels());
  Raster<Rgba> pixels = picture.pixels();
  for (; have < drawn.size(); ++have) {
    if (watch.stopped()) return cancelled();
    watch.report(static_cast<double>(have) / static_cast<double>(drawn.size()), "blending " + drawn[have]->name);
    if (const auto cached = caches_->painted.find(keys[have + 1])) {
      paste(*cached, pixels);
      continue;
    }
    auto painted = blend(*drawn[have], cuts && have > 0, pixels, watch);
    if (!painted) return painted.error();
    caches_->painted.put(keys[have + 1], std::make_shared<const WarpedRegion>(std::move(*painted)));
  }
  picture = Image(std::move(pixels));
  caches_->composites.put(keys.back(), std::make_shared<const Image>(picture));
  return picture;
}

Result<std::vector<DrawnLayer>> Session::drawn_layers(const Layer* otherwise, const Watch& watch) {
  // All of them, and as many again for what a gesture makes of them.
  caches_->shapes.grow(2 * shown().layers.size());
  std::vector<DrawnLayer> drawn;
  for (const Layer& own : shown().layers) {
    const bool other = otherwise != nullptr && otherwise->id == own.id;
    const Layer& layer = other ? *otherwise : own;
    if (!is_drawn(layer)) continue;
    const auto solve = other ? plan_layer(layer, nullptr, true) : shown_solves().at(layer.id);
    auto shape = shape_of(layer, *solve, true, watch);
    if (!shape) return shape.error();
    drawn.push_back({layer.id, std::move(*shape), shape_key(layer, solve->deformation), layer.placement.dx,
                     layer.placement.dy, blend_options(layer)});
  }
  return drawn;
}

Result<Image> Session::composite(const Watch& watch) {
  return composite_until(shown(), shown().layers.size(), watch);
}

Result<BleedForecast> Session::bleed(LayerId id, const Watch& watch) {
  const Layer* layer = shown().find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  if (!is_drawn(*layer) || layer->settings.mode == CloneMode::kNone) return BleedForecast{};
  const auto below = composite_until(shown(), static_cast<std::size_t>(layer - shown().layers.data()), watch);
  if (!below) return below.error();
  const auto deformed = deformation(id, watch);
  if (!deformed) return deformed.error();
  const auto shape = shape_of(*layer, solve_of(*layer), false, watch);
  if (!shape) return shape.error();
  if ((*shape)->mask.empty()) return BleedForecast{};
  const auto [dx, dy] = std::pair(layer->placement.dx, layer->placement.dy);
  const Raster<Rgba>& target = shown().target.image.pixels();
  Image seen = *below;
  if (&seen.pixels() != &target && is_within_white(target)) {
    Raster<Rgba> pixels = seen.pixels();
    cut_to_white(pixels, ground_of(**shape, *layer, pixels.rect()));
    seen = Image(std::move(pixels));
  }
  BleedForecast forecast = forecast_bleed(seen.pixels(), (*shape)->warped, (*shape)->mask, dx, dy,
                                          transformed((*deformed)->boundary, layer->placement.sub_pixel()));
  for (BleedSample& sample : forecast.samples)
    sample.at = sample.at + Point{dx + 0.0, dy + 0.0};
  return forecast;
}

Result<std::int64_t> Session::painted_pixels(LayerId id, const Watch& watch) {
  const Layer* layer = shown().find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  if (!is_drawn(*layer)) return 0;
  const auto shape = shape_of(*layer, solve_of(*layer), false, watch);
  if (!shape) return shape.error();
  const Rect target = shown().target.image.rect();
  std::int64_t count = 0;
  for (const Mask::Run& run : (*shape)->mask.runs())
    count += intersect({run.x0 + layer->placement.dx, run.y + layer->placement.dy, run.x1 - run.x0, 1}, target).width;
  return count;
}

Result<WarpedRegion> Session::layer_pixels(LayerId id, const Watch& watch) {
  const Document& now = shown();
  const Layer* layer = now.find(id);
  if (layer == nullptr) return Error{"layer.unknown", "there is no layer " + to_string(id), ""};
  const auto index = static_cast<std::size_t>(layer - now.layers.data());
  Document shown = now;
  shown.layers[index].settings.visible = true;
  const auto picture = composite_until(shown, index + 1, watch);
  if (!picture) return picture.error();
  if (!is_drawn(shown.layers[index])) return WarpedRegion{};
  const auto shape = shape_of(shown.layers[index], solve_of(shown.layers[index]), false, watch);
  if (!shape) return shape.error();
  const Mask placed = translated((*shape)->mask, layer->placement.dx, layer->placement.dy);
  WarpedRegion alone;
  alone.rect = intersect(placed.bounds(), picture->rect());
  if (alone.rect.empty()) return WarpedRegion{};
  alone.pixels = Raster<Rgba>(alone.rect.width, alone.rect.height, {0, 0, 0, 0});
  for (const Mask::Run& run : placed.runs()) {
    if (run.y < alone.rect.y || run.y >= alone.rect.bottom()) continue;
    for (int x = std::max(run.x0, alone.rect.x); x < std::min(run.x1, alone.rect.right()); ++x)
      alone.pixels.at(x - alone.rect.x, run.y - alone.rect.y) = picture->at(x, run.y);
  }
  return alone;
}

Result<Image> Session::layer_picture(LayerId id, const Watch& watch) {
  const auto alone = layer_pixels(id, watch);
  if (!alone) return alone.error();
  Raster<Rgba> whole(document().target.image.width(), document().target.image.height(), {0, 0, 0, 0});
  paste(*alone, whole);
  return Image(std::move(whole));
}

} // namespace oversketch
