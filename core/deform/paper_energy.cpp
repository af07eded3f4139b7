#include "core/deform/paper_energy.h"

#include "core/base/check.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace oversketch {
namespace {

using Complex = std::complex<double>;
using Edge = std::pair<int, int>;

/// Both directions of every cell's edge, sorted by first vertex, each once.
std::vector<Edge> list_edges(const QuadMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  std::vector<Edge> edges;
  edges.reserve(8 * mesh.cells.size());
  for (const auto& corners : mesh.cells) {
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 4];
      CHECK(a >= 0 && a < count && a != b, "a cell's corners must be distinct vertices of its mesh");
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Row `i` of A_d; `edges` are those that leave i.  Source coordinates are taken from z_i, so that the row is the same
/// wherever the region lies in its image.
void add_row(const Points& vertices, int i, std::span<const Edge> edges,
             std::vector<Eigen::Triplet<Complex>>& entries) {
  const double neighbours = static_cast<double>(edges.size());
  const auto offset = [&](int k) { return to_complex(vertices[k] - vertices[i]); };
  Complex sum = 0.0;
  for (const Edge& edge : edges)
    sum += offset(edge.second);
  const Complex centre = sum / (neighbours + 1), delta = -sum / neighbours;

  double spread = std::norm(centre);
  for (const Edge& edge : edges)
    spread += std::norm(offset(edge.second) - centre);
  CHECK(spread > 0, "a vertex and its neighbours must not all be one point");
  const auto fitted = [&](Complex place) { return delta * std::conj(place - centre) / spread; };
  entries.emplace_back(i, i, fitted(0.0) - 1.0);
  for (const Edge& edge : edges)
    entries.emplace_back(i, edge.second, fitted(offset(edge.second)) + 1.0 / neighbours);
}

} // namespace

ComplexMatrix make_energy_operator(const QuadMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  const std::vector<Edge> edges = list_edges(mesh);
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(edges.size() + mesh.vertices.size());
  std::size_t first = 0;
  for (int i = 0; i < count; ++i) {
    std::size_t last = first;
    while (last < edges.size() && edges[last].first == i)
      ++last;
    CHECK(last > first, "every vertex of a mesh must belong to a cell");
    add_row(mesh.vertices, i, std::span(edges).subspan(first, last - first), entries);
    first = last;
  }
  ComplexMatrix out(count, count);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

double measure_energy(const ComplexMatrix& energy_operator, const ComplexVector& positions) {
  return (energy_operator * positions).squaredNorm();
}

} // namespace oversketch
