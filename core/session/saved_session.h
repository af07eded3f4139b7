#pragma once

#include "core/document/command.h"
#include "core/document/document.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oversketch {

/// All that a Session must remember to go on where it was, as a plain value: what a project file holds.
struct SavedSession {
  /// How one layer's region was deformed: the layer as it stood then, and the solve that this one starts from.
  struct Solve {
    Layer layer;
    /// Index of an earlier one.
    std::optional<std::size_t> warm;
  };

  /// One entry of the history.
  struct Step {
    Document document;
    /// What led here; its pictures are loaded.
    Command command;
    std::string label;
    /// Index into `solves` of each layer that has a region.
    std::map<LayerId, std::size_t> solves;
  };

  std::vector<Solve> solves;
  std::vector<Step> steps;
  /// Index of the present step; 0 when there are none.
  std::size_t cursor = 0;
};

/// What of a history is kept in a SavedSession.
struct KeptHistory {
  /// Steps at most, at least 1; the youngest, but always the present one.
  std::size_t steps = 1000;
  /// Of pictures that the present document does not have, as they lie in memory.
  std::size_t image_bytes = std::size_t{1} << 30;
};

/// With at most that many of its steps, the youngest, but always the present one; and with the solves that those need.
/// @param steps  at least 1 (CHECK).
SavedSession shortened(const SavedSession& saved, std::size_t steps);

} // namespace oversketch
