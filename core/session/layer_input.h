#pragma once

// Turns a layer of the document into what the solvers take, and names it by content.

#include "core/base/hash.h"
#include "core/clone/blend.h"
#include "core/deform/deformation.h"
#include "core/document/document.h"
#include "core/warp/warp.h"

#include <vector>

namespace oversketch {

DeformOptions deform_options(const Layer& layer);
WarpOptions warp_options(const Layer& layer);
BlendOptions blend_options(const Layer& layer);
std::vector<PinPair> pin_pairs(const Layer& layer);

/// What the solved mesh depends on; the whole system (solved and drawn mesh, factor); the solution on the solved mesh,
/// as far as the layer itself decides it.
Hash solver_key(const Layer& layer);
Hash system_key(const Layer& layer);
Hash solution_key(const Layer& layer);

/// Whether both layers are deformed alike, drawn mesh included.
bool is_same_solve(const Layer& a, const Layer& b);

/// Given what names the deformation: the shape (mask, warped source); the blending apart from the picture below.
Hash shape_key(const Layer& layer, const Hash& deformation);
Hash blend_key(const Layer& layer, const Hash& deformation);

/// Whether it takes part in the picture at all.
bool is_drawn(const Layer& layer);

} // namespace oversketch
