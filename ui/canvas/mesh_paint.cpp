#include "ui/canvas/mesh_paint.h"

#include <algorithm>
#include <cmath>

namespace oversketch {
namespace {

/// Pieces that are reserved at a time: an index list has 16 bits.
constexpr std::size_t kAtOnce = 4096;

/// Whether that many more vertices can be drawn at all.
bool has_room(const ImDrawList& list, std::size_t vertices) {
  return (list.Flags & ImDrawListFlags_AllowVtxOffset) != 0 || sizeof(ImDrawIdx) > 2 ||
         static_cast<std::size_t>(list.VtxBuffer.Size) + vertices < 0xffff;
}

void push_quad(ImDrawList& list, ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d, PackedColor color) {
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  list.PrimQuadUV(a, b, c, d, white, white, white, white, color);
}

/// Calls `draw(i)` for i = 0…count − 1, a quad each at most, with room for it.
template <class Draw>
void draw_quads(ImDrawList& list, std::size_t count, const Draw& draw) {
  for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
    const std::size_t end = std::min(count, begin + kAtOnce), room = end - begin;
    if (!has_room(list, 4 * room)) return;
    list.PrimReserve(static_cast<int>(6 * room), static_cast<int>(4 * room));
    int left_out = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (!draw(i)) ++left_out;
    list.PrimUnreserve(6 * left_out, 4 * left_out);
  }
}

bool outside(const CanvasPaint& paint, ImVec2 low, ImVec2 high) {
  return high.x < paint.corner.x || high.y < paint.corner.y || low.x > paint.end.x || low.y > paint.end.y;
}

std::vector<std::array<int, 2>> find_edges(const QuadMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(4 * mesh.cells.size());
  for (const auto& cell : mesh.cells)
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = cell[k], b = cell[(k + 1) % 4];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double median_det(const std::vector<CellDistortion>& cells) {
  std::vector<double> dets;
  for (const CellDistortion& cell : cells)
    if (cell.det > 0) dets.push_back(cell.det);
  if (dets.empty()) return 1;
  const auto middle = dets.begin() + static_cast<std::ptrdiff_t>(dets.size() / 2);
  std::nth_element(dets.begin(), middle, dets.end());
  return *middle;
}

/// 0…1, calm to alarming.
double measure(const CellDistortion& cell, double usual_det, CellColor by) {
  if (by == CellColor::kSigma) return std::isfinite(cell.sigma_ratio) ? cell.sigma_ratio - 1 : 1;
  return cell.det > 0 ? std::abs(std::log2(cell.det / usual_det)) / 2 : 1;
}

} // namespace

void MeshCache::update(const std::shared_ptr<const QuadMesh>& new_mesh,
                       const std::shared_ptr<const Points>& new_positions) {
  if (mesh == new_mesh && positions == new_positions) return;
  if (mesh != new_mesh) edges = find_edges(*new_mesh);
  mesh = new_mesh;
  positions = new_positions;
  cells = measure_cells(*mesh, *positions);
  usual_det = median_det(cells);
}

void project(const CanvasPaint& paint, const Points& positions, const Similarity& place, MeshCache& cache) {
  cache.screen.clear();
  cache.screen.reserve(positions.size());
  for (const Point p : positions)
    cache.screen.push_back(paint.at(place(p)));
}

void draw_line_pairs(const CanvasPaint& paint, std::span<const ImVec2> ends, PackedColor color, float width_px) {
  draw_quads(paint.list, ends.size() / 2, [&](std::size_t i) {
    const ImVec2 a = ends[2 * i], b = ends[2 * i + 1];
    if (outside(paint, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}))
      return false;
    const float dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) return false;
    const float nx = -dy / length * width_px / 2, ny = dx / length * width_px / 2;
    push_quad(paint.list, {a.x + nx, a.y + ny}, {b.x + nx, b.y + ny}, {b.x - nx, b.y - ny}, {a.x - nx, a.y - ny},
              color);
    return true;
  });
}

void draw_mesh_edges(const CanvasPaint& paint, const MeshCache& cache, PackedColor color, float width) {
  if (cache.edges.empty()) return;
  // A sample of the edges tells how large the cells are here.
  double total = 0;
  int counted = 0;
  for (std::size_t i = 0; i < cache.edges.size(); i += 1 + cache.edges.size() / 64, ++counted) {
    const auto [a, b] = cache.edges[i];
    const ImVec2 p = cache.screen[static_cast<std::size_t>(a)], q = cache.screen[static_cast<std::size_t>(b)];
    total += std::hypot(q.x - p.x, q.y - p.y);
  }
  const double cell_px = total / counted;
  if (cell_px < 1.5) return;
  std::vector<ImVec2> ends;
  ends.reserve(2 * cache.edges.size());
  for (const auto& [a, b] : cache.edges) {
    ends.push_back(cache.screen[static_cast<std::size_t>(a)]);
    ends.push_back(cache.screen[static_cast<std::size_t>(b)]);
  }
  draw_line_pairs(paint, ends, faded(color, static_cast<float>(cell_px / 6)), paint.look.px(width));
}

void draw_mesh_cells(const CanvasPaint& paint, const MeshCache& cache, CellColor by) {
  draw_quads(paint.list, cache.cells.size(), [&](std::size_t c) {
    const CellDistortion& cell = cache.cells[c];
    if (by == CellColor::kFlipped && !cell.flipped) return false;
    const auto& corners = cache.mesh->cells[c];
    const auto p = [&](std::size_t k) { return cache.screen[static_cast<std::size_t>(corners[k])]; };
    const auto [left, right] = std::minmax({p(0).x, p(1).x, p(2).x, p(3).x});
    const auto [top, bottom] = std::minmax({p(0).y, p(1).y, p(2).y, p(3).y});
    if (outside(paint, {left, top}, {right, bottom})) return false;
    const PackedColor color = by == CellColor::kFlipped ? faded(paint.look.danger, 0.85f)
                                                        : faded(heat_color(measure(cell, cache.usual_det, by)), 0.55f);
    push_quad(paint.list, p(0), p(1), p(2), p(3), color);
    return true;
  });
}

} // namespace oversketch
