#include "core/session/live_alternatives.h"

#include "core/geometry/mask.h"
#include "core/session/layer_input.h"
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

/// The farthest that the two put a point of the outline apart.
double difference(const Points& a, const Points& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, distance(a[i], b[i]));
  return most;
}

/// The least that two of the answers may differ by, layer px.
double least_difference(const Points& places) {
  return 0.05 * bounds(places).diagonal();
}

/// The point of the outline that the answer has farthest from where any other has it.
std::size_t telling_point(const std::vector<const Deformation*>& all, const Deformation& own) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < own.outline.size(); ++i) {
    double apart = HUGE_VAL;
    for (const Deformation* other : all)
      if (other != &own) apart = std::min(apart, distance(own.outline[i], other->outline[i]));
    if (apart <= most) continue;
    most = apart;
    best = i;
  }
  return best;
}

Command pin_for(const Layer& layer, Point outline, Point sketch) {
  const Point target = layer.placement.to_target()(sketch);
  if (layer.pins.empty()) return PinAdd{layer.id, outline, target, true};
  return PinMove{layer.id, layer.pins.front().id, outline, target, true};
}

} // namespace

Result<Alternatives::Matches> Alternatives::find_matches(Session& session, const Layer& layer, const Watch& watch) {
  const auto solved = session.alternatives(layer.id, kOffered, watch);
  if (!solved) return solved.error();
  const double best = solved->front().match_cost.value_or(0);
  std::vector<const Deformation*> offered;
  for (const Deformation& each : *solved) {
    const auto is_like = [&](const Deformation* other) {
      return difference(each.outline, other->outline) < least_difference(each.outline);
    };
    if (each.match_cost.value_or(0) > best + kCloseCall || std::ranges::any_of(offered, is_like)) continue;
    offered.push_back(&each);
  }
  Matches matches;
  if (offered.size() < 2) return matches;
  const ClosedCurve sketch(layer.sketch);
  for (const Deformation* each : offered) {
    auto picture = small_picture(layer, *each, watch);
    if (!picture) return picture.error();
    const std::size_t at = telling_point(offered, *each);
    matches.push_back({layer.outline[at], sketch.nearest(each->outline[at]).point, each->outline,
                       each->match_cost.value_or(0), std::move(*picture)});
  }
  return matches;
}

Result<const Alternatives::Match*> Alternatives::chosen_of(const Matches& matches, Session& session, const Layer& layer,
                                                           const Watch& watch) {
  if (layer.pins.empty()) {
    const auto shown = session.deformation(layer.id, watch);
    if (!shown) return shown.error();
    const auto apart = [&](const Match& match) { return difference(match.places, (*shown)->outline); };
    const auto nearest = std::ranges::min_element(matches, {}, apart);
    return apart(*nearest) < least_difference(nearest->places) ? &*nearest : nullptr;
  }
  // Where a pin was put and where it is differ by rounding.
  const double same = 1e-6 * bounds(layer.sketch).diagonal();
  const Pin& pin = layer.pins.front();
  const auto held = std::ranges::find_if(matches, [&](const Match& match) {
    return distance(match.outline, pin.outline) <= same && distance(match.sketch, pin.sketch) <= same;
  });
  return layer.pins.size() == 1 && held != matches.end() ? &*held : nullptr;
}

Result<std::vector<AlternativeSnapshot>> Alternatives::list(Session& session, bool find, const Watch& watch) {
  using List = std::vector<AlternativeSnapshot>;
  const Document& document = session.shown();
  const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
  const bool choice = layer != nullptr && !layer->outline.empty() && layer->pins.size() <= 1 &&
                      layer->settings.method == DeformMethod::kFlipfree;
  if (!choice) return List();
  Layer unpinned = *layer;
  unpinned.pins.clear();
  const std::complex<double> turn = layer->placement.factor;
  const Hash key = Hasher()
                       .add(solution_key(unpinned))
                       .add(layer->settings.cell_px)
                       .add(layer->source.image.content_hash())
                       .add(turn.real())
                       .add(turn.imag())
                       .finish();
  auto known = known_.find(key);
  if (!known) {
    if (!find) return List();
    auto found = find_matches(session, *layer, watch);
    if (!found) return found.error();
    known = known_.put(key, std::make_shared<const Matches>(std::move(*found)));
  }
  if (known->empty()) return List();
  const auto chosen = chosen_of(*known, session, *layer, watch);
  if (!chosen) return chosen.error();
  List list;
  if (!layer->pins.empty() && *chosen == nullptr) return list;
  for (const Match& match : *known)
    list.push_back({pin_for(*layer, match.outline, match.sketch), &match == *chosen, match.cost, match.picture});
  return list;
}

} // namespace oversketch::live
