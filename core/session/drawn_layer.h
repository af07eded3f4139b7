#pragma once

#include "core/clone/blend.h"
#include "core/clone/clone_system.h"
#include "core/document/document.h"
#include "core/image/warped_region.h"

#include <memory>

namespace oversketch {

/// A deformed region in the target's pixels, before the whole-pixel shift.
struct LayerShape {
  /// Empty where nothing of the region can be seen; the rest is then empty too.
  Mask mask;
  WarpedRegion warped;
  /// May be null for plain paste.
  std::shared_ptr<const CloneSystem> system;
};

/// A layer as it takes part in the picture.
struct DrawnLayer {
  LayerId id;
  std::shared_ptr<const LayerShape> shape;
  /// Names the shape by what it was made from.
  Hash shape_name;
  int dx = 0;
  int dy = 0;
  BlendOptions options;
};

} // namespace oversketch
