#pragma once

// Turns a layer of the document into what the solvers take, and names it by content.

#include "core/base/hash.h"
#include "core/clone/blend.h"
#include "core/deform/deformation.h"
#include "core/document/document.h"

#include <vector>

namespace oversketch {

DeformOptions deform_options(const Layer& layer);
BlendOptions blend_options(const Layer& layer);
std::vector<PinPair> pin_pairs(const Layer& layer);

/// What the mesh depends on; the system (mesh and factor); the deformation; the shape (mask, warped source); and the
/// blending apart from the picture below.
Hash mesh_key(const Layer& layer);
Hash system_key(const Layer& layer);
Hash deformation_key(const Layer& layer);
Hash shape_key(const Layer& layer);
Hash blend_key(const Layer& layer);

/// Whether it takes part in the picture at all.
bool is_drawn(const Layer& layer);

} // namespace oversketch
