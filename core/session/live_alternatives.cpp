#include "core/session/live_alternatives.h"

#include "core/geometry/mask.h"
#include "core/warp/warp.h"

#include <algorithm>
#include <cmath>

namespace oversketch::live {

namespace {

/// Of the small pictures' longer side.
constexpr double kPicturePx = 112;

/// The deformed region with its box's corner at (1, 1).
Result<std::shared_ptr<const Raster<Rgba8>>> small_picture(const Layer& layer, const Deformation& deformation,
                                                           const Watch& watch) {
  const std::complex<double> turn = layer.placement.factor / std::abs(layer.placement.factor);
  const Box turned = bounds(transformed(deformation.boundary, Similarity{turn, {}}));
  const Point size = turned.size();
  const double scale = kPicturePx / std::max({size.x, size.y, 1.0});
  const Similarity place{scale * turn, to_complex(Point{1, 1} - scale * turned.low)};
  const Rect frame{0, 0, static_cast<int>(std::ceil(scale * size.x)) + 2,
                   static_cast<int>(std::ceil(scale * size.y)) + 2};
  const Mask mask = rasterize_polygon(transformed(deformation.boundary, place), frame);
  const Mask region = rasterize_polygon(layer.outline, layer.source.image.rect());
  const auto warped = warp_region(layer.source.image, *deformation.mesh, transformed(deformation.positions, place),
                                  mask, watch, &region);
  if (!warped) return warped.error();
  auto picture = std::make_shared<Raster<Rgba8>>(frame.width, frame.height, Rgba8{0, 0, 0, 0});
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x)
      picture->at(x, run.y) = to_display(warped->pixels.at(x - warped->rect.x, run.y - warped->rect.y));
  return std::shared_ptr<const Raster<Rgba8>>(std::move(picture));
}

/// The point of the outline that the two put farthest apart.
std::size_t telling_point(const Deformation& a, const Deformation& b) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < a.outline.size(); ++i) {
    const double apart = distance(a.outline[i], b.outline[i]);
    if (apart > most) {
      most = apart;
      best = i;
    }
  }
  return best;
}

} // namespace

Result<std::vector<AlternativeSnapshot>> Alternatives::list(Session& session, const Watch& watch) {
  using List = std::vector<AlternativeSnapshot>;
  const Document& document = session.shown();
  const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
  const bool choice = layer != nullptr && !layer->outline.empty() && layer->pins.empty() &&
                      layer->settings.method == DeformMethod::kFlipfree;
  if (!choice) return List();
  const Hash key = *session.deformation_name(layer->id);
  if (const auto known = known_.find(key)) return *known;

  const auto shown = session.deformation(layer->id, watch);
  if (!shown) return shown.error();
  const auto solved = session.alternatives(layer->id, kOffered, watch);
  if (!solved) return solved.error();
  List list;
  const double best = solved->front().match_cost.value_or(0);
  for (const Deformation& other : *solved) {
    const std::size_t at = telling_point(other, **shown);
    const double apart = distance(other.outline[at], (*shown)->outline[at]);
    const Box box = bounds(other.boundary);
    // The one that is shown is no alternative to itself.
    if (apart < 0.05 * box.diagonal()) continue;
    if (other.match_cost.value_or(0) > best + kCloseCall) continue;
    auto picture = small_picture(*layer, other, watch);
    if (!picture) return picture.error();
    const PinAdd take{layer->id, layer->outline[at], layer->placement.to_target()(other.outline[at])};
    list.push_back({take, other.match_cost.value_or(0), std::move(*picture)});
  }
  known_.put(key, std::make_shared<const List>(list));
  return list;
}

} // namespace oversketch::live
