#include "core/session/live_bleed.h"

namespace oversketch::live {

std::shared_ptr<const BleedForecast> forecast_layer(const Image& target, const Layer& layer,
                                                    const Deformation& deformation, const DrawnLayer& drawn) {
  const LayerShape& shape = *drawn.shape;
  if (layer.settings.mode == CloneMode::kNone || shape.mask.empty() || deformation.boundary.size() < 3) return nullptr;
  auto forecast =
      std::make_shared<BleedForecast>(forecast_bleed(target.pixels(), shape.warped, shape.mask, drawn.dx, drawn.dy,
                                                     transformed(deformation.boundary, layer.placement.sub_pixel())));
  // The mask stands where it was drawn, the layer some whole pixels from there.
  const Point moved{static_cast<double>(drawn.dx), static_cast<double>(drawn.dy)};
  for (BleedSample& sample : forecast->samples)
    sample.at += moved;
  return forecast;
}

} // namespace oversketch::live
