#pragma once

// The table of script steps, in the form of the command table (command_specs.h).

#include "core/document/record.h"
#include "core/session/script.h"

namespace oversketch {

inline constexpr std::string_view kOutHelp = "relative, below the output folder";

template <>
struct Spec<UndoStep> {
  static constexpr std::string_view name = "undo", label = "Undo", help = "Goes back in the history.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"steps", &UndoStep::steps, "how many", "", 0, HUGE_VAL, true});
  }
};
template <>
struct Spec<RedoStep> {
  static constexpr std::string_view name = "redo", label = "Redo", help = "Goes forward in the history.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"steps", &RedoStep::steps, "how many", "", 0, HUGE_VAL, true});
  }
};
template <>
struct Spec<SaveStep> {
  static constexpr std::string_view name = "save", label = "Save";
  static constexpr std::string_view help =
      "Writes the session as a project (.ora), or as a script (.jsonl) with its pictures beside it, named by content.";
  static constexpr auto fields() { return std::make_tuple(Field{"path", &SaveStep::path, kOutHelp}); }
};
template <>
struct Spec<OpenStep> {
  static constexpr std::string_view name = "open", label = "Open";
  static constexpr std::string_view help = "Replaces the session by a saved one, .ora or .jsonl.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"path", &OpenStep::path, "looked for below the output folder, then beside the script"});
  }
};
template <>
struct Spec<ExportStep> {
  static constexpr std::string_view name = "export", label = "Export",
                                    help = "Writes the picture, PNG or JPEG by the path's extension.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"path", &ExportStep::path, kOutHelp},
                           Field{"depth", &ExportStep::depth, "8, or 16 for PNG", "bits a channel", 8, 16, true});
  }
};
template <>
struct Spec<ExportLayerStep> {
  static constexpr std::string_view name = "export.layer", label = "Export layer";
  static constexpr std::string_view help =
      "Writes one layer as it is blended, on a transparent picture of the target's size.";
  static constexpr auto fields() {
    return std::make_tuple(Field{"layer", &ExportLayerStep::layer, "the layer; the selected one when left out"},
                           Field{"path", &ExportLayerStep::path, kOutHelp},
                           Field{"depth", &ExportLayerStep::depth, "8 or 16", "bits a channel", 8, 16, true});
  }
};
template <>
struct Spec<ReportStep> {
  static constexpr std::string_view name = "report", label = "Report";
  static constexpr std::string_view help =
      "Writes layers, metrics, history and counters as JSON, for each layer how many of the target's pixels it paints "
      "(`pixels`), and how well its edge within the target matches what is below it (`bleed`; null in mode none).";
  static constexpr auto fields() { return std::make_tuple(Field{"path", &ReportStep::path, kOutHelp}); }
};
template <>
struct Spec<ExpectStep> {
  static constexpr std::string_view name = "expect", label = "Expect",
                                    help = "Stops the script when the state is not as said.";
  static constexpr auto fields() {
    return std::make_tuple(
        Field{"layers", &ExpectStep::layers, "number of layers", "", 0},
        Field{"pins", &ExpectStep::pins, "number of pins in all layers", "", 0},
        Field{"history", &ExpectStep::history, "number of history entries, the opening one included", "", 0},
        Field{"flipped_cells", &ExpectStep::flipped_cells, "in all layers", "", 0},
        Field{"image", &ExpectStep::image, "a picture that the composite must equal"},
        Field{"max_difference", &ExpectStep::max_difference, "from that picture", "8-bit levels", 0, 255, true},
        Field{"modified", &ExpectStep::modified, "whether there is something to save"});
  }
};

} // namespace oversketch
