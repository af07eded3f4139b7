#include "core/session/layer_input.h"

namespace oversketch {
namespace {

Method method_of(DeformMethod method) {
  switch (method) {
  case DeformMethod::kFlipfree:
    return Method::kFlipfree;
  case DeformMethod::kPaper:
    return Method::kPaper;
  case DeformMethod::kInitial:
    return Method::kInitial;
  }
  CHECK(false, "a method without a solver");
  return {};
}

Sampling sampling_of(WarpSampling sampling) {
  switch (sampling) {
  case WarpSampling::kBilinear:
    return Sampling::kBilinear;
  case WarpSampling::kBicubic:
    return Sampling::kBicubic;
  }
  CHECK(false, "a sampling without a kernel");
  return {};
}

BlendMode mode_of(CloneMode mode) {
  switch (mode) {
  case CloneMode::kImport:
    return BlendMode::kImport;
  case CloneMode::kMixed:
    return BlendMode::kMixed;
  case CloneMode::kMonochrome:
    return BlendMode::kMonochrome;
  case CloneMode::kAverage:
    return BlendMode::kAverage;
  case CloneMode::kNone:
    return BlendMode::kNone;
  }
  CHECK(false, "a mode without a blend");
  return {};
}

Domain domain_of(CloneDomain domain) {
  switch (domain) {
  case CloneDomain::kEncoded:
    return Domain::kEncoded;
  case CloneDomain::kLinear:
    return Domain::kLinear;
  case CloneDomain::kLog:
    return Domain::kLog;
  }
  CHECK(false, "a domain without a blend");
  return {};
}

void add_points(Hasher& hasher, const Points& points) {
  hasher.add(std::span<const Point>(points));
}

} // namespace

DeformOptions deform_options(const Layer& layer) {
  DeformOptions options;
  options.method = method_of(layer.settings.method);
  options.cell_px = layer.settings.cell_px;
  options.stiffness = layer.settings.stiffness;
  options.follow = layer.settings.follow;
  options.handle_weight = layer.settings.handle_weight;
  options.iterations = layer.settings.iterations;
  return options;
}

WarpOptions warp_options(const Layer& layer) {
  WarpOptions options;
  options.sampling = sampling_of(layer.settings.sampling);
  return options;
}

BlendOptions blend_options(const Layer& layer) {
  BlendOptions options;
  options.mode = mode_of(layer.settings.mode);
  options.strength = layer.settings.strength;
  options.domain = domain_of(layer.settings.domain);
  options.feather_px = layer.settings.feather_px;
  options.opacity = layer.settings.opacity;
  options.screening = screening_for(layer.settings.screening);
  return options;
}

std::vector<PinPair> pin_pairs(const Layer& layer) {
  std::vector<PinPair> pairs;
  for (const Pin& pin : layer.pins)
    pairs.push_back({pin.outline, pin.sketch});
  return pairs;
}

Hash solver_key(const Layer& layer) {
  const bool flipfree = layer.settings.method == DeformMethod::kFlipfree;
  Hasher hasher;
  add_points(hasher, layer.outline);
  hasher.add(flipfree);
  // The paper is solved on the mesh that is drawn, flipfree on one of its own.
  if (!flipfree) hasher.add(layer.settings.cell_px);
  return hasher.finish();
}

Hash system_key(const Layer& layer) {
  return Hasher().add(solver_key(layer)).add(layer.settings.cell_px).add(layer.settings.handle_weight).finish();
}

Hash solution_key(const Layer& layer) {
  const DeformOptions options = deform_options(layer);
  Hasher hasher;
  hasher.add(solver_key(layer)).add(options.method);
  if (options.method == Method::kFlipfree)
    hasher.add(options.stiffness).add(options.follow);
  else
    hasher.add(options.handle_weight);
  if (options.method == Method::kPaper) hasher.add(options.iterations);
  add_points(hasher, layer.sketch);
  for (const Pin& pin : layer.pins)
    hasher.add(pin.outline.x).add(pin.outline.y).add(pin.sketch.x).add(pin.sketch.y);
  return hasher.finish();
}

bool is_same_solve(const Layer& a, const Layer& b) {
  const bool by_value = a.outline == b.outline && a.sketch == b.sketch && a.pins == b.pins;
  return by_value && deform_options(a) == deform_options(b);
}

Hash shape_key(const Layer& layer, const Hash& deformation) {
  const Placement& p = layer.placement;
  return Hasher()
      .add(deformation)
      .add(layer.source.image.content_hash())
      .add(layer.settings.sampling)
      .add(p.factor.real())
      .add(p.factor.imag())
      .add(p.offset.x)
      .add(p.offset.y)
      .finish();
}

Hash blend_key(const Layer& layer, const Hash& deformation) {
  const LayerSettings& s = layer.settings;
  return Hasher()
      .add(shape_key(layer, deformation))
      .add(layer.placement.dx)
      .add(layer.placement.dy)
      .add(s.mode)
      .add(s.strength)
      .add(s.domain)
      .add(s.feather_px)
      .add(s.screening)
      .add(s.opacity)
      .finish();
}

bool is_drawn(const Layer& layer) {
  return layer.settings.visible && layer.settings.opacity > 0 && !layer.outline.empty();
}

} // namespace oversketch
