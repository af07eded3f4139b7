#include "core/mesh/assemble.h"

#include "core/base/check.h"

#include <numeric>

namespace oversketch {

namespace {

using Port = CellCopies::Port;

/// Corner k of copy c has the number 4c + k; corners that ports join become one.
class CornerUnion {
public:
  explicit CornerUnion(int corners) : parent_(static_cast<std::size_t>(corners)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest number that a corner is joined with.
  int find(int i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(int i, int j) {
    i = find(i);
    j = find(j);
    if (i < j)
      parent_[j] = i;
    else
      parent_[i] = j;
  }

private:
  std::vector<int> parent_;
};

CornerUnion join_corners(const CellCopies& c, const std::vector<bool>& kept) {
  CornerUnion corners(4 * c.copy_count());
  for (const Port& port : c.ports) {
    const Port& twin = c.ports[port.twin];
    if (port.copy > twin.copy || !kept[port.copy] || !kept[twin.copy]) continue;
    // The two sides run against each other.
    corners.join(4 * port.copy + port.side, 4 * twin.copy + ((twin.side + 1) & 3));
    corners.join(4 * port.copy + ((port.side + 1) & 3), 4 * twin.copy + twin.side);
  }
  return corners;
}

} // namespace

std::vector<int> number_kept(const std::vector<bool>& kept) {
  std::vector<int> cell(kept.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) cell[i] = next++;
  return cell;
}

QuadMesh assemble_mesh(const CellCopies& copies, const std::vector<bool>& kept) {
  CornerUnion corners = join_corners(copies, kept);
  std::vector<int> vertex(static_cast<std::size_t>(4 * copies.copy_count()), -1);
  QuadMesh mesh;
  mesh.cell = copies.grid.cell();
  for (int copy = 0; copy < copies.copy_count(); ++copy) {
    if (!kept[copy]) continue;
    const CellCopies::Copy& at = copies.copies[copy];
    std::array<int, 4> cell{};
    for (int k = 0; k < 4; ++k) {
      int& number = vertex[corners.find(4 * copy + k)];
      if (number < 0) {
        number = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(copies.grid.corner(at.column + (k == 1 || k == 2 ? 1 : 0), at.row + (k >= 2 ? 1 : 0)));
      }
      cell[k] = number;
    }
    mesh.cells.push_back(cell);
    mesh.coverage.push_back(at.coverage);
  }
  return mesh;
}

namespace {

/// Goes round the kept pieces: in through a port, along the border in positive direction to the next one, out through
/// it.
class BoundaryWalk {
public:
  BoundaryWalk(const CellCopies& copies, const std::vector<bool>& kept, const QuadMesh& mesh)
      : c_(copies), kept_(kept), cell_(number_kept(kept)), mesh_(mesh) {}

  std::vector<int> run() {
    const int start = find_start();
    if (start < 0) return {mesh_.cells[0].begin(), mesh_.cells[0].end()};
    int port = start;
    std::size_t passed = 0;
    do {
      port = c_.ports[pass_piece(port)].twin;
      CHECK(++passed <= c_.ports.size(), "the way round a mesh must close");
    } while (port != start);
    while (loop_.size() > 1 && loop_.front() == loop_.back())
      loop_.pop_back();
    return std::move(loop_);
  }

private:
  bool joined(int port) const { return kept_[c_.ports[port].copy] && kept_[c_.ports[c_.ports[port].twin].copy]; }

  /// Whether a joined port is followed by a corner that kept copies surround.
  bool before_inner_corner(int port) const {
    const int across = c_.ports[c_.previous_port(c_.ports[port].twin)].twin;
    return c_.ports[port].inside_corner && joined(c_.next_port(port)) && kept_[c_.ports[across].copy];
  }

  int find_start() const {
    for (int port = 0; port < static_cast<int>(c_.ports.size()); ++port)
      if (joined(port) && !before_inner_corner(port)) return port;
    return -1;
  }

  /// Notes the corners between a port and the next joined one, which is returned.
  int pass_piece(int port) {
    const std::array<int, 4>& cell = mesh_.cells[cell_[c_.ports[port].copy]];
    int corner = c_.ports[port].side;
    do {
      for (int k = 0; k < c_.ports[port].corners_to_next; ++k)
        note(cell[++corner & 3]);
      port = c_.next_port(port);
    } while (!joined(port));
    return port;
  }

  void note(int vertex) {
    if (loop_.empty() || loop_.back() != vertex) loop_.push_back(vertex);
  }

  const CellCopies& c_;
  const std::vector<bool>& kept_;
  std::vector<int> cell_;
  const QuadMesh& mesh_;
  std::vector<int> loop_;
};

} // namespace

std::vector<int> boundary_loop(const CellCopies& copies, const std::vector<bool>& kept, const QuadMesh& mesh) {
  return BoundaryWalk(copies, kept, mesh).run();
}

} // namespace oversketch
