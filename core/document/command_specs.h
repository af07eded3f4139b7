#pragma once

// The command table: one Spec a command, one row a field.  Parser, printer, ranges, labels, help and the reference page
// come from here.

#include "core/document/record.h"

#include "core/geometry/mask.h"

namespace oversketch {

inline constexpr double kFar = kMaskCoordinateLimit;
inline constexpr std::string_view kLayerHelp = "the layer; the selected one when left out";
inline constexpr std::string_view kMatchHelp =
    "takes another way to lay the outline along the sketch, as the history says";

template <>
struct Spec<DocumentNew> {
  static constexpr std::string_view name = "document.new", label = "Open";
  static constexpr std::string_view help =
      "Starts a document on a target picture, or on an empty canvas of a colour.  Begins a new history.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"target", &DocumentNew::target, "the picture that regions are pasted into"},
        Field{"width", &DocumentNew::width, "of an empty canvas", "px", 1, 65535},
        Field{"height", &DocumentNew::height, "of an empty canvas", "px", 1, 65535},
        Field{"color", &DocumentNew::color, "of an empty canvas; white when left out", "levels", 0, 255});
  }
};

template <>
struct Spec<TargetSet> {
  static constexpr std::string_view name = "target.set", label = "Change target";
  static constexpr std::string_view help = "Puts another picture under the layers, which stay where they are.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"target", &TargetSet::target, "the new target picture"});
  }
};

template <>
struct Spec<LayerAdd> {
  static constexpr std::string_view name = "layer.add", label = "Add layer";
  static constexpr std::string_view help = "Adds a layer on top and selects it.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"source", &LayerAdd::source, "the picture a region is taken from; \"@target\" is the target itself"},
        Field{"name", &LayerAdd::name, "of the layer; the file's when left out"});
  }
};

template <>
struct Spec<LayerRemove> {
  static constexpr std::string_view name = "layer.remove", label = "Remove layer";
  static constexpr std::string_view help = "Removes a layer; its neighbour is selected if it was.";
  static constexpr auto fields() { return std::make_tuple(Field{"layer", &LayerRemove::layer, kLayerHelp}); }
};

template <>
struct Spec<LayerSelect> {
  static constexpr std::string_view name = "layer.select", label = "Select layer";
  static constexpr std::string_view help = "Selects a layer: the one that commands without \"layer\" speak of.";
  static constexpr auto fields() { return std::make_tuple(Field{"layer", &LayerSelect::layer, "the layer to select"}); }
};

template <>
struct Spec<LayerRename> {
  static constexpr std::string_view name = "layer.rename", label = "Rename layer";
  static constexpr std::string_view help = "Gives a layer another name.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &LayerRename::layer, kLayerHelp},
                           Field{"name", &LayerRename::name, "the new name"});
  }
};

template <>
struct Spec<LayerOrder> {
  static constexpr std::string_view name = "layer.order", label = "Reorder layer";
  static constexpr std::string_view help = "Moves a layer to another height in the stack.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &LayerOrder::layer, kLayerHelp},
                           Field{"to", &LayerOrder::to, "its new index, 0 the lowest", "", 0});
  }
};

template <>
struct Spec<RegionSet> {
  static constexpr std::string_view name = "region.set", label = "Outline";
  static constexpr std::string_view help =
      "Sets the outline of the part that is taken from the source.  A layer without a sketch gets the outline as its "
      "sketch, "
      "where it lies in the source if that is inside the target, else in the target's middle.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layer", &RegionSet::layer, kLayerHelp},
        Field{"outline", &RegionSet::outline, "closed, simple, within the source picture", "source px"});
  }
};

template <class C>
constexpr auto stroke_fields(std::string_view of, std::string_view unit) {
  return std::make_tuple(
      Field{"layer", &C::layer, kLayerHelp}, Field{"stroke", &C::stroke, of, unit},
      Field{"side", &C::side, "which part between the stroke's ends is replaced: the likelier one, or the other", "",
            -HUGE_VAL, HUGE_VAL, true},
      Field{"tolerance_px", &C::tolerance_px, "how near to the curve an end must be; also the scale of the joins", unit,
            0.01, 10000, true},
      Field{"sharp", &C::sharp, "corners instead of smooth joins", "", -HUGE_VAL, HUGE_VAL, true});
}

template <>
struct Spec<RegionEdit> {
  static constexpr std::string_view name = "region.edit", label = "Redraw outline";
  static constexpr std::string_view help =
      "Draws a part of the outline over again.  The rest stays as it is, to the bit; pins on the part go to the "
      "nearest place of the new one.";
  static constexpr auto fields() {
    return stroke_fields<RegionEdit>("open; begins and ends near the outline", "source px");
  }
};

template <>
struct Spec<SketchSet> {
  static constexpr std::string_view name = "sketch.set", label = "Sketch";
  static constexpr std::string_view help = "Sets the closed curve that the region's outline shall become.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &SketchSet::layer, kLayerHelp},
                           Field{"curve", &SketchSet::curve, "closed, simple; may leave the picture", "target px"});
  }
};

template <>
struct Spec<SketchEdit> {
  static constexpr std::string_view name = "sketch.edit", label = "Oversketch";
  static constexpr std::string_view help =
      "Draws a part of the sketch over again.  The rest stays as it is, to the bit; pins on the part go to the "
      "nearest place of the new one.";
  static constexpr auto fields() {
    return stroke_fields<SketchEdit>("open; begins and ends near the sketch", "target px");
  }
};

template <>
struct Spec<SketchReset> {
  static constexpr std::string_view name = "sketch.reset", label = "Reset sketch";
  static constexpr std::string_view help = "Makes the sketch the outline again, where the layer stands.";
  static constexpr auto fields() { return std::make_tuple(Field{"layer", &SketchReset::layer, kLayerHelp}); }
};

template <>
struct Spec<PinAdd> {
  static constexpr std::string_view name = "pin.add", label = "Pin";
  static constexpr std::string_view help = "Fixes a point of the outline to a point of the sketch.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layer", &PinAdd::layer, kLayerHelp},
        Field{"outline", &PinAdd::outline, "snapped to the nearest point of the outline", "source px", -kFar, kFar},
        Field{"sketch", &PinAdd::sketch, "snapped to the nearest point of the sketch", "target px", -kFar, kFar},
        Field{"match", &PinAdd::match, kMatchHelp, "", -HUGE_VAL, HUGE_VAL, true});
  }
};

template <>
struct Spec<PinMove> {
  static constexpr std::string_view name = "pin.move", label = "Move pin";
  static constexpr std::string_view help = "Moves one end of a pin, or both.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layer", &PinMove::layer, kLayerHelp}, Field{"pin", &PinMove::pin, "the pin"},
        Field{"outline", &PinMove::outline, "snapped to the nearest point of the outline", "source px", -kFar, kFar},
        Field{"sketch", &PinMove::sketch, "snapped to the nearest point of the sketch", "target px", -kFar, kFar},
        Field{"match", &PinMove::match, kMatchHelp, "", -HUGE_VAL, HUGE_VAL, true});
  }
};

template <>
struct Spec<PinRemove> {
  static constexpr std::string_view name = "pin.remove", label = "Remove pin";
  static constexpr std::string_view help = "Removes a pin.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &PinRemove::layer, kLayerHelp}, Field{"pin", &PinRemove::pin, "the pin"});
  }
};

template <>
struct Spec<LayerMove> {
  static constexpr std::string_view name = "layer.move", label = "Move";
  static constexpr std::string_view help = "Moves the pasted region, its sketch and its pins along.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &LayerMove::layer, kLayerHelp},
                           Field{"by", &LayerMove::by, "how far", "px", -kFar, kFar});
  }
};

template <>
struct Spec<LayerTransform> {
  static constexpr std::string_view name = "layer.transform", label = "Transform";
  static constexpr std::string_view help = "Turns and scales the pasted region, its sketch and its pins along.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layer", &LayerTransform::layer, kLayerHelp},
        Field{"rotate_deg", &LayerTransform::rotate_deg, "clockwise on the screen", "degrees", -36000, 36000, true},
        Field{"scale", &LayerTransform::scale, "about the same point", "", 0.001, 1000, true},
        Field{"about", &LayerTransform::about, "the fixed point; the middle of the sketch's box when left out",
              "target px", -kFar, kFar});
  }
};

template <>
struct Spec<LayerSet> {
  static constexpr std::string_view name = "layer.set", label = "Settings";
  static constexpr std::string_view help = "Changes settings of a layer; those left out stay.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layer", &LayerSet::layer, kLayerHelp},
        Field{"method", &LayerSet::method, "how the region is deformed; flipfree from the start"},
        Field{"cell_px", &LayerSet::cell_px, "side of a mesh cell; 10 from the start", "source px", 0.1, 10000},
        Field{"stiffness", &LayerSet::stiffness, "against change of area, method flipfree; 0.15 from the start", "",
              0.001, 1000},
        Field{"follow", &LayerSet::follow, "how closely the sketch is followed, method flipfree; 20 from the start", "",
              0.01, 10000},
        Field{"handle_weight", &LayerSet::handle_weight, "the paper's ω, methods paper and initial; 1 from the start",
              "", 0.01, 100},
        Field{"iterations", &LayerSet::iterations, "gradient steps, method paper; 50 from the start", "", 0, 100000},
        Field{"sampling", &LayerSet::sampling,
              "how the source is read where it is deformed: bicubic is sharper; bilinear from the start"},
        Field{"mode", &LayerSet::mode,
              "how the region is blended; import from the start; monochrome takes the source's light and dark only, "
              "and so "
              "changes even a target that equals a source in colour"},
        Field{"strength", &LayerSet::strength, "how much of the colour correction is applied; 1 from the start", "", 0,
              1},
        Field{"domain", &LayerSet::domain, "the values that are blended; encoded from the start"},
        Field{"visible", &LayerSet::visible, "whether it is drawn; true from the start"},
        Field{"opacity", &LayerSet::opacity, "1 from the start", "", 0, 1},
        Field{"feather_px", &LayerSet::feather_px,
              "width over which a strength below 1, or mode none, sets in; 0 from the start", "px", 0, 1000},
        Field{"screening", &LayerSet::screening,
              "how far from the edge the colour correction dies away, by a factor of e: keeps a colour that bleeds in "
              "from tinting the whole region; 0 from the start: it does not",
              "px", 0, 100000});
  }
};

} // namespace oversketch
