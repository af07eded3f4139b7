#pragma once

#include "core/base/result.h"
#include "core/document/document.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace oversketch {

/// A picture asked for by name.  A script's reader fills `image` before the command is applied; the name alone is
/// printed, and it alone decides equality.
struct ImageRef {
  std::string name;
  std::optional<Image> image;

  bool operator==(const ImageRef& other) const { return name == other.name; }
};

/// Which layer a command speaks of; none means the selected one.
using LayerRef = std::optional<LayerId>;

/// 8-bit levels, 0…255.
struct Color {
  std::array<double, 3> rgb{};
  bool operator==(const Color&) const = default;
};

/// A length in whole pixels.
struct WholeOffset {
  int x = 0;
  int y = 0;
  bool operator==(const WholeOffset&) const = default;
};

// The commands, as data.  What each field means stands in the command table (command_table.h), once.

struct DocumentNew {
  std::optional<ImageRef> target;
  std::optional<int> width, height;
  std::optional<Color> color;
  bool operator==(const DocumentNew&) const = default;
};
struct TargetSet {
  ImageRef target;
  bool operator==(const TargetSet&) const = default;
};
struct LayerAdd {
  ImageRef source;
  std::optional<std::string> name;
  bool operator==(const LayerAdd&) const = default;
};
struct LayerRemove {
  LayerRef layer;
  bool operator==(const LayerRemove&) const = default;
};
struct LayerSelect {
  LayerRef layer;
  bool operator==(const LayerSelect&) const = default;
};
struct LayerRename {
  LayerRef layer;
  std::string name;
  bool operator==(const LayerRename&) const = default;
};
struct LayerOrder {
  LayerRef layer;
  int to = 0;
  bool operator==(const LayerOrder&) const = default;
};
struct RegionSet {
  LayerRef layer;
  Points outline;
  bool operator==(const RegionSet&) const = default;
};
/// Which of the two parts between a stroke's ends it replaces.
enum class StrokeSide { kAuto, kOther };

struct RegionEdit {
  LayerRef layer;
  Points stroke;
  StrokeSide side = StrokeSide::kAuto;
  double tolerance_px = 10;
  bool sharp = false;
  bool operator==(const RegionEdit&) const = default;
};
struct SketchSet {
  LayerRef layer;
  Points curve;
  bool operator==(const SketchSet&) const = default;
};
struct SketchEdit {
  LayerRef layer;
  Points stroke;
  StrokeSide side = StrokeSide::kAuto;
  double tolerance_px = 10;
  bool sharp = false;
  bool operator==(const SketchEdit&) const = default;
};
struct SketchReset {
  LayerRef layer;
  bool operator==(const SketchReset&) const = default;
};
struct PinAdd {
  LayerRef layer;
  Point outline, sketch;
  /// It takes another of the matcher's answers.
  bool match = false;
  bool operator==(const PinAdd&) const = default;
};
struct PinMove {
  LayerRef layer;
  PinId pin;
  std::optional<Point> outline, sketch;
  bool match = false;
  bool operator==(const PinMove&) const = default;
};
struct PinRemove {
  LayerRef layer;
  PinId pin;
  bool operator==(const PinRemove&) const = default;
};
struct LayerMove {
  LayerRef layer;
  WholeOffset by;
  bool operator==(const LayerMove&) const = default;
};
struct LayerTransform {
  LayerRef layer;
  double rotate_deg = 0;
  double scale = 1;
  std::optional<Point> about;
  bool operator==(const LayerTransform&) const = default;
};
struct LayerSet {
  LayerRef layer;
  std::optional<DeformMethod> method;
  std::optional<double> cell_px, stiffness, follow, handle_weight;
  std::optional<int> iterations;
  std::optional<WarpSampling> sampling;
  std::optional<CloneMode> mode;
  std::optional<double> strength;
  std::optional<CloneDomain> domain;
  std::optional<bool> visible;
  std::optional<double> opacity, feather_px, screening;
  bool operator==(const LayerSet&) const = default;
};

/// One change of a Document, as plain data: undoable, printable, parsable.
/// Copied, moved and ended in one place: a variant of so many kinds is dear to compile.
class Command : public std::variant<DocumentNew, TargetSet, LayerAdd, LayerRemove, LayerSelect, LayerRename, LayerOrder,
                                    RegionSet, RegionEdit, SketchSet, SketchEdit, SketchReset, PinAdd, PinMove,
                                    PinRemove, LayerMove, LayerTransform, LayerSet> {
public:
  using variant::variant;
  Command() noexcept;
  Command(const Command& other);
  Command(Command&& other) noexcept;
  Command& operator=(const Command& other);
  Command& operator=(Command&& other) noexcept;
  ~Command();
};
bool operator==(const Command& a, const Command& b);

/// The document after the command.  Pure: the same in, the same out; when it fails there is nothing to roll back.
///
/// Every number is held against its range in the command table, curves must be simple (check_closed_curve), the outline
/// must lie in its picture, pins must follow each other in the same order on outline and sketch.  An image must have
/// been loaded into its ImageRef (CHECK), a source "@target" apart.
///
/// @errors those of check_closed_curve and oversketch, and document.none, document.size, target.itself, layer.unknown,
///   layer.none-selected, layer.index, layer.no-region, region.outside-source, sketch.outside-target, pin.unknown,
///   pin.same-place, pin.order, pin.nothing-to-move, value.range, value.missing, command.nothing-to-do,
///   transform.range; the document given is unchanged, being const.
/// @cost O(points); no image is touched.
Result<Document> apply(const Document& document, const Command& command);

/// What the history calls the step: "Move 40, 12", "Add layer puffer fish".
std::string label_of(const Command& command, const Document& before, const Document& after);

/// The images that a command asks for by path ("@target" is none), and those of them that are not loaded yet.
std::vector<ImageRef*> images_of(Command& command);
std::vector<ImageRef*> images_to_load(Command& command);

/// The name that stands for the target itself as a source.
inline constexpr std::string_view kTargetName = "@target";

} // namespace oversketch
