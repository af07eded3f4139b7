#pragma once

#include "core/geometry/point.h"
#include "core/image/image.h"

#include <compare>
#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// "L3": the third layer made in its document.  Ids are drawn from a counter in the document, so that a replay gives
/// the same.
struct LayerId {
  int number = 0;
  auto operator<=>(const LayerId&) const = default;
};

/// "P3": the third pin made in its document.
struct PinId {
  int number = 0;
  auto operator<=>(const PinId&) const = default;
};

std::string to_string(LayerId id);
std::string to_string(PinId id);

/// A picture and the name it was asked for by: a path relative to the script, or "@target".  Names do not decide
/// equality: the same pixels are the same picture.
struct NamedImage {
  std::string name;
  Image image;

  bool operator==(const NamedImage& other) const { return image == other.image; }
};

/// A correspondence fixed by the user.
struct Pin {
  PinId id;
  /// On the outline, source pixels.
  Point outline;
  /// On the sketch, layer space (see Placement).
  Point sketch;

  bool operator==(const Pin&) const = default;
};

/// Puts a layer's own space into the target: w ↦ factor · w + offset + (dx, dy).
///
/// The whole pixels stand apart from the rest, so that a move by whole pixels changes no rounding: everything that
/// depends on factor and offset alone (mask, warped source, factorization) stays valid to the bit.
struct Placement {
  std::complex<double> factor = 1.0;
  /// Within [0, 1) pixel.
  Point offset;
  int dx = 0;
  int dy = 0;

  bool operator==(const Placement&) const = default;
  /// The whole map.
  Similarity to_target() const;
  /// The map without the whole pixels: what masks and warps are made with.
  Similarity sub_pixel() const;
};

/// The placement of a similarity, its offset split into whole pixels and the rest.
Placement make_placement(const Similarity& to_target);

enum class DeformMethod { kFlipfree, kPaper, kInitial };
/// How a region reads its source where it is deformed.
enum class WarpSampling { kBilinear, kBicubic };
enum class CloneMode { kImport, kMixed, kMonochrome, kAverage, kNone };
enum class CloneDomain { kEncoded, kLinear, kLog };

/// What `layer.set` changes; meanings, units and ranges stand in the command table (commands.cpp).
struct LayerSettings {
  DeformMethod method = DeformMethod::kFlipfree;
  double cell_px = 10;
  double stiffness = 0.15;
  double follow = 20;
  double handle_weight = 1;
  int iterations = 50;
  WarpSampling sampling = WarpSampling::kBilinear;
  CloneMode mode = CloneMode::kImport;
  double strength = 1;
  CloneDomain domain = CloneDomain::kEncoded;
  bool visible = true;
  double opacity = 1;
  double feather_px = 0;
  double screening = 0;

  bool operator==(const LayerSettings&) const = default;
};

/// One pasted region.  Outline and sketch are empty until they are set; when set they are simple closed curves.
struct Layer {
  LayerId id;
  std::string name;
  NamedImage source;
  /// Source pixels.
  Points outline;
  /// Layer space: target pixels before the placement.
  Points sketch;
  std::vector<Pin> pins;
  Placement placement;
  LayerSettings settings;

  bool operator==(const Layer&) const = default;
  /// The sketch, and a pin's sketch end, in target pixels.
  Points sketch_in_target() const { return transformed(sketch, placement.to_target()); }
};

/// Everything that is saved and undone; a value.  A copy costs kilobytes, since pixels are shared.
struct Document {
  /// Empty (0 × 0) until document.new.
  NamedImage target;
  /// Bottom first.
  std::vector<Layer> layers;
  std::optional<LayerId> selected;
  int next_layer = 1;
  int next_pin = 1;

  bool operator==(const Document&) const = default;
  bool empty() const { return target.image.empty(); }
  const Layer* find(LayerId id) const;
};

/// Calls visit(image) for the target's and each layer's; the same image as often as it is used.
void for_each_image(const Document& document, const auto& visit) {
  visit(document.target.image);
  for (const Layer& layer : document.layers)
    visit(layer.source.image);
}

} // namespace oversketch
