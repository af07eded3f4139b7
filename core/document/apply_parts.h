#pragma once

// What each command does to a document, one function a command: the parts of apply().

#include "core/document/command.h"

namespace oversketch {

/// The layer a command speaks of, in a document that may be changed.
/// @errors layer.none-selected, layer.unknown.
Result<Layer*> find_layer(Document& document, const LayerRef& ref);

Result<void> run(Document& document, const DocumentNew& c);
Result<void> run(Document& document, const TargetSet& c);
Result<void> run(Document& document, const LayerAdd& c);
Result<void> run(Document& document, const LayerRemove& c);
Result<void> run(Document& document, const LayerSelect& c);
Result<void> run(Document& document, const LayerRename& c);
Result<void> run(Document& document, const LayerOrder& c);
Result<void> run(Document& document, const LayerSet& c);
Result<void> run(Document& document, const RegionSet& c);
Result<void> run(Document& document, const RegionEdit& c);
Result<void> run(Document& document, const SketchSet& c);
Result<void> run(Document& document, const SketchEdit& c);
Result<void> run(Document& document, const SketchReset& c);
Result<void> run(Document& document, const PinAdd& c);
Result<void> run(Document& document, const PinMove& c);
Result<void> run(Document& document, const PinRemove& c);
Result<void> run(Document& document, const LayerMove& c);
Result<void> run(Document& document, const LayerTransform& c);

} // namespace oversketch
