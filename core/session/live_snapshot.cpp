#include "core/session/live_snapshot.h"

#include "core/image/resample.h"

#include <algorithm>
#include <cmath>

namespace oversketch {

const LayerSnapshot* Snapshot::find(LayerId id) const {
  const auto found = std::ranges::find(layers, id, &LayerSnapshot::id);
  return found == layers.end() ? nullptr : &*found;
}

namespace live {

namespace {

constexpr int kThumbnailPx = 96;

/// The picture's part in the box, no larger than `most` on a side.
Image reduced_part(const Image& image, const Box& box, int most) {
  const int x0 = std::clamp(static_cast<int>(std::floor(box.low.x)), 0, image.width() - 1);
  const int y0 = std::clamp(static_cast<int>(std::floor(box.low.y)), 0, image.height() - 1);
  const int x1 = std::clamp(static_cast<int>(std::ceil(box.high.x)), x0 + 1, image.width());
  const int y1 = std::clamp(static_cast<int>(std::ceil(box.high.y)), y0 + 1, image.height());
  Raster<Rgba> part(x1 - x0, y1 - y0);
  for (int y = y0; y < y1; ++y)
    std::ranges::copy(image.pixels().row(y).subspan(static_cast<std::size_t>(x0), static_cast<std::size_t>(x1 - x0)),
                      part.row(y - y0).begin());
  const double scale = std::min(1.0, static_cast<double>(most) / std::max(part.width(), part.height()));
  const int width = std::max(1, static_cast<int>(std::lround(scale * part.width())));
  const int height = std::max(1, static_cast<int>(std::lround(scale * part.height())));
  return downscaled(Image(std::move(part)), width, height);
}

} // namespace

ShownPicture SnapshotMaker::show(const Image& image) {
  if (image.empty()) return {};
  const Hash key = image.content_hash();
  auto pixels = pictures_.find(key);
  if (!pixels) pixels = pictures_.put(key, std::make_shared<const Raster<Rgba8>>(to_display(image)));
  return {key, std::move(pixels)};
}

std::shared_ptr<const Raster<Rgba8>> SnapshotMaker::thumbnail_of(const Layer& layer) {
  const Image& source = layer.source.image;
  if (source.empty()) return nullptr;
  const Hash key = Hasher().add(source.content_hash()).add(std::span<const Point>(layer.outline)).finish();
  if (auto known = thumbnails_.find(key)) return known;
  const Box whole{{0, 0}, {static_cast<double>(source.width()), static_cast<double>(source.height())}};
  const Image part = reduced_part(source, layer.outline.empty() ? whole : bounds(layer.outline), kThumbnailPx);
  return thumbnails_.put(key, std::make_shared<const Raster<Rgba8>>(to_display(part)));
}

std::optional<Metrics> SnapshotMaker::measure(Session& session, const Layer& layer, bool wanted, const Watch& watch) {
  const std::complex<double> factor = layer.placement.factor;
  const Hash key = Hasher().add(*session.deformation_name(layer.id)).add(factor.real()).add(factor.imag()).finish();
  if (const auto known = metrics_.find(key)) return *known;
  if (!wanted) return std::nullopt;
  auto metrics = session.metrics(layer.id, watch);
  if (!metrics) return std::nullopt;
  return *metrics_.put(key, std::make_shared<const Metrics>(std::move(*metrics)));
}

Snapshot SnapshotMaker::make(Session& session, bool measured, const Watch& watch) {
  Snapshot out;
  out.document = session.shown();
  out.in_gesture = session.has_preview();
  out.target = show(out.document.target.image);
  for (const auto& entry : session.history().entries())
    out.history.push_back(entry.label);
  out.cursor = session.history().cursor();
  out.modified = session.history().modified();
  for (const Layer& layer : out.document.layers) {
    LayerSnapshot shown;
    shown.id = layer.id;
    shown.source = show(layer.source.image);
    shown.thumbnail = thumbnail_of(layer);
    if (session.deformation_name(layer.id)) {
      // Solved when the command was taken, so that this finds it; after undo it may have been forgotten.
      if (auto deformation = session.deformation(layer.id, watch)) shown.deformation = std::move(*deformation);
      shown.metrics = measure(session, layer, measured, watch);
    }
    out.layers.push_back(std::move(shown));
  }
  out.counters = session.counters();
  return out;
}

} // namespace live

} // namespace oversketch
