#include "core/session/live_picture.h"

#include <algorithm>
#include <chrono>

namespace oversketch::live {

namespace {

class Stopwatch {
public:
  double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// More hardly pays beside the memory's speed.
constexpr int kPaintingThreads = 2;

Hash name_of(const DrawnLayer& layer) {
  const BlendOptions& o = layer.options;
  return Hasher()
      .add(layer.shape_name)
      .add(layer.dx)
      .add(layer.dy)
      .add(o.mode)
      .add(o.strength)
      .add(o.domain)
      .add(o.feather_px)
      .add(o.opacity)
      .add(o.screening)
      .add(o.average)
      .finish();
}

void copy_rect(const Raster<Rgba8>& from, Raster<Rgba8>& to, const Rect& rect) {
  const auto x = static_cast<std::size_t>(rect.x), width = static_cast<std::size_t>(rect.width);
  for (int y = rect.y; y < rect.bottom(); ++y)
    std::ranges::copy(from.row(y).subspan(x, width), to.row(y).subspan(x, width).begin());
}

bool needs_system(const DrawnLayer& layer) {
  return layer.options.mode != BlendMode::kNone;
}

bool solves_on_pixels(const DrawnLayer& layer) {
  return layer.options.mode == BlendMode::kMixed || layer.options.screening > 0;
}

} // namespace

Raster<Rgba8> part_of(const Raster<Rgba8>& pixels, const Rect& rect) {
  Raster<Rgba8> part(rect.width, rect.height);
  const auto x = static_cast<std::size_t>(rect.x), width = static_cast<std::size_t>(rect.width);
  for (int y = 0; y < rect.height; ++y)
    std::ranges::copy(pixels.row(rect.y + y).subspan(x, width), part.row(y).begin());
  return part;
}

Rect Picture::layers_rect() const {
  Rect all;
  for (const Painted& layer : painted_)
    all = unite(all, layer.rect);
  return all;
}

std::optional<Picture::Timing> Picture::timing_of(LayerId id) const {
  const auto found = std::ranges::find(painted_, id, &Painted::id);
  return found == painted_.end() ? std::nullopt : std::optional(found->timing);
}

Result<std::shared_ptr<const LiveRegion>> Picture::region_of(const DrawnLayer& layer) {
  if (auto known = regions_.find(layer.shape_name)) return known;
  auto made = LiveRegion::make(layer.shape->warped, *layer.shape->system);
  if (!made) return at("layer " + to_string(layer.id), made.error());
  return regions_.put(layer.shape_name, std::make_shared<const LiveRegion>(std::move(*made)));
}

/// Everything that takes long or can fail, before the first pixel is touched.
Result<std::vector<Picture::Painted>> Picture::prepare(std::span<const DrawnLayer> layers, Quality quality,
                                                       const Watch& watch) {
  regions_.grow(2 * layers.size());
  std::vector<Painted> wanted;
  for (const DrawnLayer& layer : layers) {
    const LayerShape& shape = *layer.shape;
    const Rect rect = intersect(translated(shape.mask.bounds(), layer.dx, layer.dy), target_->rect());
    if (shape.mask.empty() || rect.empty()) continue;
    auto region = region_of(layer);
    if (!region) return region.error();
    Painted painted{layer.id, name_of(layer), rect, CloneQuality::kFirst, std::move(*region), layer, {}};
    const Stopwatch stopwatch;
    if (needs_system(layer)) {
      // At rest both are made: the finest for what stays, the quick one for the next time it is moved.
      if (quality == Quality::kRest) {
        for (const CloneQuality wish : {CloneQuality::kDrag, CloneQuality::kRest})
          if (auto made = shape.system->prepare(layer.options, wish, watch); !made)
            return at("layer " + to_string(layer.id), made.error());
        painted.quality = CloneQuality::kRest;
      } else {
        // What is solved on the pixels has nothing that is sooner than dragging.
        const bool quick = solves_on_pixels(layer) || shape.system->has_membrane(CloneQuality::kDrag);
        if (quick) painted.quality = CloneQuality::kDrag;
        if (auto made = shape.system->prepare(layer.options, painted.quality, watch); !made)
          return at("layer " + to_string(layer.id), made.error());
      }
    }
    painted.timing.mask_ms = stopwatch.ms();
    wanted.push_back(std::move(painted));
  }
  if (watch.stopped()) return cancelled();
  return wanted;
}

/// The layers below it stay as they are painted.
std::size_t Picture::first_changed(const std::vector<Painted>& wanted) const {
  std::size_t i = 0;
  while (i < wanted.size() && i < painted_.size() && wanted[i].name == painted_[i].name &&
         wanted[i].quality <= painted_[i].quality)
    ++i;
  return i;
}

/// Which of the layers from `first` on must be painted again, and the rectangle that this touches.
std::vector<bool> Picture::list_dirty(const std::vector<Painted>& wanted, std::size_t first, Rect& dirty) const {
  std::vector<bool> again(wanted.size(), false);
  for (std::size_t i = first; i < std::max(wanted.size(), painted_.size()); ++i) {
    const bool stays = i < wanted.size() && i < painted_.size() && wanted[i].name == painted_[i].name &&
                       wanted[i].quality <= painted_[i].quality;
    if (stays) continue;
    if (i < painted_.size()) dirty = unite(dirty, painted_[i].rect);
    if (i < wanted.size()) {
      dirty = unite(dirty, wanted[i].rect);
      again[i] = true;
    }
  }
  // A layer that reaches into what is painted anew, its ring of matched pixels too, is painted anew as a whole.
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t i = first; i < wanted.size(); ++i) {
      if (again[i] || intersect(grown(wanted[i].rect, 1), dirty).empty()) continue;
      again[i] = grew = true;
      dirty = unite(dirty, wanted[i].rect);
    }
  }
  return again;
}

Result<void> Picture::paint_layer(Painted& layer, Raster<Rgba8>& pixels, const Watch& watch) {
  const Stopwatch stopwatch;
  const auto done =
      clone_live(pixels, pixels, *layer.region, *layer.layer.shape->system, layer.layer.dx, layer.layer.dy,
                 layer.layer.options, layer.quality, watch.threads_up_to(kPaintingThreads));
  if (!done) return at("layer " + to_string(layer.id), done.error());
  layer.timing.blend_ms = stopwatch.ms();
  return {};
}

/// The target with the first `count` layers painted on.
Result<const Raster<Rgba8>*> Picture::picture_below(std::vector<Painted>& wanted, std::size_t count,
                                                    const Watch& watch) {
  if (count == 0) return target_.get();
  std::vector<Hash> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(Hasher().add(wanted[i].name).add(painted_[i].quality).finish());
  if (names == below_names_) return &below_;
  below_names_.clear();
  below_ = *target_;
  for (std::size_t i = 0; i < count; ++i) {
    Painted again = wanted[i];
    again.quality = painted_[i].quality;
    if (auto done = paint_layer(again, below_, watch); !done) return done.error();
  }
  below_names_ = std::move(names);
  return &below_;
}

Result<void> Picture::paint(std::shared_ptr<const Raster<Rgba8>> target, std::span<const DrawnLayer> layers,
                            Quality quality, const Watch& watch, PictureUpdate& changed) {
  const bool other_target = target != target_;
  if (!target) {
    *this = Picture();
    if (other_target) changed.whole = true;
    return {};
  }
  target_ = std::move(target);
  if (other_target) {
    sound_ = false;
    below_names_.clear();
  }
  auto wanted = prepare(layers, quality, watch);
  if (!wanted) return wanted.error();

  changed.width = target_->width();
  changed.height = target_->height();
  Rect dirty;
  std::size_t first = 0;
  std::vector<bool> again(wanted->size(), true);
  const Raster<Rgba8>* below = target_.get();
  if (sound_) {
    first = first_changed(*wanted);
    again = list_dirty(*wanted, first, dirty);
    if (dirty.empty()) return {};
    const auto found = picture_below(*wanted, first, watch);
    if (!found) return found.error();
    below = *found;
    copy_rect(*below, pixels_, dirty);
  } else {
    changed.whole = true;
    pixels_ = *target_;
    dirty = target_->rect();
  }

  sound_ = false;
  for (std::size_t i = 0; i < wanted->size(); ++i) {
    if (i >= first && again[i]) {
      if (auto done = paint_layer((*wanted)[i], pixels_, watch); !done) return done.error();
    } else {
      (*wanted)[i].quality = painted_[i].quality;
      (*wanted)[i].timing = painted_[i].timing;
    }
  }
  painted_ = std::move(*wanted);
  sound_ = true;
  changed.patches.push_back({dirty.x, dirty.y, part_of(pixels_, dirty)});
  return {};
}

} // namespace oversketch::live
