#pragma once

#include "core/mesh/cell_copies.h"
#include "core/mesh/quad_mesh.h"

#include <vector>

namespace oversketch {

/// For each copy whether it stays when copies covered by less than half are left out (MeshKind::kTrimmed): least
/// covered first, as long as each has a neighbour across an edge that is covered by at least half, and as long as what
/// stays is a disc, that is, the copy touches the others along one unbroken part of its border.
/// @cost linear but for sorting the copies covered by less than half.
std::vector<bool> trim(const CellCopies& copies);

/// The cells that stay, in order of the copies, with vertices shared through the ports between them, in order of first
/// use.
QuadMesh assemble_mesh(const CellCopies& copies, const std::vector<bool>& kept);

/// The boundary of that mesh as a loop of vertices in positive direction: the way round the kept pieces from port to
/// port.
/// @param kept  what stays is a disc.
std::vector<int> boundary_loop(const CellCopies& copies, const std::vector<bool>& kept, const QuadMesh& mesh);

/// For each copy its cell in the assembled mesh, or −1.
std::vector<int> number_kept(const std::vector<bool>& kept);

} // namespace oversketch
