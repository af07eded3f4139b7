#include "core/base/check.h"
#include "core/mesh/cell_copies.h"
#include "core/mesh/grid_crossings.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace oversketch {

namespace {

using Copy = CellCopies::Copy;
using Port = CellCopies::Port;
using Span = CellCopies::Span;
using Stop = CellCopies::Stop;

constexpr int kNoPort = -1;

Error not_simple() {
  return {"mesh.not-simple", "The outline crosses or touches itself; draw it without a crossing.", "outline"};
}

/// The stop where the outline comes into a cell, or goes out of it, at a crossing.
Stop stop_at(const GridCrossing& c, int chain, bool enters) {
  // The cell at the larger coordinates of the line is entered by going forward, and left by going backward.
  const bool larger = enters == c.forward;
  const int side = c.vertical ? (larger ? 3 : 1) : (larger ? 0 : 2);
  const int across = larger ? c.line : c.line - 1;
  const bool increasing = side < 2;
  Stop stop{
      c.vertical ? c.along : across, c.vertical ? across : c.along, side, increasing ? c.rank : -c.rank, chain, enters};
  stop.part_before = increasing ? c.part_before() : c.part_after();
  stop.part_after = increasing ? c.part_after() : c.part_before();
  stop.segment = c.segment;
  stop.forward = c.forward;
  return stop;
}

/// Corners passed in positive direction from one stop to another of the same cell.
int corners_between(const Stop& from, const Stop& to) {
  if (from.side == to.side) return to.order > from.order ? 0 : 4;
  return (to.side - from.side) & 3;
}

/// Builds CellCopies row by row: copies of the cells that the outline enters, and between them those wholly inside.
class Cutter {
public:
  Cutter(const ClosedCurve& outline, const Grid& grid, std::vector<GridCrossing> crossings)
      : out_{grid, outline, {}, {}, {}, {}, {}, {}, 0}, crossings_(std::move(crossings)) {}

  Result<CellCopies> run(const Watch& watch) {
    make_stops();
    if (!cut_rows(watch)) return watch.stopped() ? cancelled() : not_simple();
    for (int row = 0; row + 1 < static_cast<int>(out_.first_span_of_row.size()); ++row)
      if (!join_rows(row)) return not_simple();
    return is_disc() ? Result<CellCopies>(std::move(out_)) : not_simple();
  }

private:
  void make_stops() {
    const int count = static_cast<int>(crossings_.size());
    out_.chains.resize(crossings_.size());
    out_.stops.reserve(2 * crossings_.size());
    for (int i = 0; i < count; ++i) {
      const GridCrossing& c = crossings_[i];
      out_.chains[i] = {c.s, -1, c.segment, out_.grid.within(c.line) == 0};
      out_.stops.push_back(stop_at(crossings_[i], i, true));
      out_.stops.push_back(stop_at(crossings_[i], i == 0 ? count - 1 : i - 1, false));
    }
    std::sort(out_.stops.begin(), out_.stops.end(), [](const Stop& a, const Stop& b) {
      return std::tie(a.row, a.column, a.side, a.order) < std::tie(b.row, b.column, b.side, b.order);
    });
    exit_of_chain_.resize(crossings_.size());
    for (int i = 0; i < static_cast<int>(out_.stops.size()); ++i)
      if (!out_.stops[i].enters) exit_of_chain_[out_.stops[i].chain] = i;
    port_at_part_.assign(static_cast<std::size_t>(2 * count + 1), kNoPort);
  }

  bool cut_rows(const Watch& watch) {
    const auto& stops = out_.stops;
    out_.first_row = stops.front().row;
    const int end = static_cast<int>(stops.size());
    for (int first = 0; first < end;) {
      const int row = stops[first].row;
      // The region is connected: no row between its first and its last is without stops.
      if (row != out_.first_row + static_cast<int>(out_.first_span_of_row.size())) return false;
      out_.first_span_of_row.push_back(static_cast<int>(out_.spans.size()));
      if (watch.stopped()) return false;
      while (first < end && stops[first].row == row) {
        int last = first;
        while (last < end && stops[last].row == row && stops[last].column == stops[first].column)
          ++last;
        if (!add_entered(row, first, last)) return false;
        first = last;
      }
      if (out_.spans.back().open_side[1] != kNoPort) return false;
    }
    out_.first_span_of_row.push_back(static_cast<int>(out_.spans.size()));
    out_.copies.push_back({0, 0, static_cast<int>(out_.ports.size()), 0});
    return true;
  }

  bool add_entered(int row, int first_stop, int last_stop) {
    const int column = out_.stops[first_stop].column;
    int left = kNoPort;
    if (static_cast<int>(out_.spans.size()) > out_.first_span_of_row.back()) {
      const Span& before = out_.spans.back();
      left = before.open_side[1];
      if (left != kNoPort && before.last_column + 1 < column)
        left = add_inside(row, before.last_column + 1, column - 1, left);
      else if (before.last_column + 1 < column)
        left = kNoPort;
    }
    Span span{column,     column,    static_cast<int>(out_.copies.size()),
              first_stop, last_stop, {kNoPort, kNoPort, kNoPort, kNoPort}};
    for (int i = first_stop; i < last_stop; ++i)
      if (out_.stops[i].enters && out_.chains[out_.stops[i].chain].copy < 0 && !add_piece(span, i)) return false;
    out_.spans.push_back(span);
    return join(left, span.open_side[3]);
  }

  /// Cells wholly inside, from the right side of the span before them; returns the port on the last one's right side.
  int add_inside(int row, int first_column, int last_column, int left) {
    out_.spans.push_back({first_column, last_column, static_cast<int>(out_.copies.size()), 0, 0, {}});
    for (int column = first_column; column <= last_column; ++column) {
      const int copy = static_cast<int>(out_.copies.size()), port = static_cast<int>(out_.ports.size());
      out_.copies.push_back({column, row, port, 1.0});
      for (int side = 0; side < 4; ++side)
        out_.ports.push_back({copy, kNoPort, static_cast<std::int8_t>(side), 1, true});
      link(left, port + 3);
      left = port + 1;
    }
    return left;
  }

  /// The piece whose outline comes in at a stop: along the chain to its exit, along the cell's sides to the next entry,
  /// and so on until it closes.
  bool add_piece(Span& span, int entry) {
    const int copy = static_cast<int>(out_.copies.size()), first_port = static_cast<int>(out_.ports.size());
    const int start = out_.stops[entry].chain;
    double twice_area = 0;
    for (int chain = start;;) {
      if (out_.chains[chain].copy >= 0) return false;
      out_.chains[chain].copy = copy;
      const int exit = exit_of_chain_[chain];
      const Stop& from = out_.stops[exit];
      if (from.column != span.first_column || from.row != out_.stops[entry].row) return false;
      if (static_cast<int>(out_.ports.size()) > first_port)
        out_.ports.back().corners_to_next = static_cast<std::int8_t>(corners_between(out_.stops[entry], from));
      entry = exit + 1 == span.last_stop ? span.first_stop : exit + 1;
      const Stop& to = out_.stops[entry];
      if (!to.enters) return false;
      add_ports(span, copy, from, to);
      twice_area += twice_area_of(chain, from, to);
      chain = to.chain;
      if (chain == start) break;
    }
    out_.ports.back().corners_to_next =
        static_cast<std::int8_t>(corners_between(out_.stops[entry], out_.stops[exit_of_chain_[start]]));
    const double cell_area = out_.grid.cell() * out_.grid.cell();
    // Only rounding can lead out of 0…1.
    out_.copies.push_back(
        {span.first_column, out_.stops[entry].row, first_port, std::clamp(0.5 * twice_area / cell_area, 0.0, 1.0)});
    return true;
  }

  /// Ports on the way along the cell's sides, inside the region, from an exit to the next entry.
  void add_ports(Span& span, int copy, const Stop& from, const Stop& to) {
    const int corners = corners_between(from, to);
    for (int k = 0; k <= corners; ++k) {
      const int side = (from.side + k) & 3, port = static_cast<int>(out_.ports.size());
      const bool more = k < corners;
      out_.ports.push_back(
          {copy, kNoPort, static_cast<std::int8_t>(side), static_cast<std::int8_t>(more ? 1 : 0), more});
      if (k == 0 || k == corners)
        join_at_part(k == 0 ? from.part_after : to.part_before, port);
      else
        span.open_side[side] = port;
    }
  }

  /// Twice the area to the left of a chain and of the way along the sides to the next entry, seen from the cell's
  /// centre.
  double twice_area_of(int chain, const Stop& from, const Stop& to) const {
    const Grid& grid = out_.grid;
    const Point low = grid.corner(from.column, from.row), high = grid.corner(from.column + 1, from.row + 1);
    const Point centre = 0.5 * (low + high);
    const int next_chain = chain + 1 == static_cast<int>(crossings_.size()) ? 0 : chain + 1;
    const int n = out_.outline.size();
    const int first = crossings_[chain].segment, last = crossings_[next_chain].segment + (next_chain == 0 ? n : 0);
    Point previous = crossings_[chain].at(grid) - centre;
    double sum = 0;
    const auto go_to = [&](Point p) {
      sum += cross(previous, p - centre);
      previous = p - centre;
    };
    for (int i = first + 1; i <= last; ++i)
      go_to(out_.outline.points()[i < n ? i : i - n]);
    go_to(crossings_[next_chain].at(grid));
    const Point corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    for (int k = 1, count = corners_between(from, to); k <= count; ++k)
      go_to(corners[(from.side + k) & 3]);
    go_to(crossings_[to.chain].at(grid));
    return sum;
  }

  void join_at_part(int part, int port) {
    if (port_at_part_[part] == kNoPort)
      port_at_part_[part] = port;
    else
      link(port_at_part_[part], port);
  }

  void link(int a, int b) {
    out_.ports[a].twin = b;
    out_.ports[b].twin = a;
  }

  /// Joins two sides that face each other and that the outline does not cross: both lie inside, or neither.
  bool join(int a, int b) {
    if ((a == kNoPort) != (b == kNoPort)) return false;
    if (a != kNoPort) link(a, b);
    return true;
  }

  int port_on_side(const Span& span, int column, int side) const {
    if (span.entered()) return span.open_side[side];
    return out_.copies[span.first_copy + (column - span.first_column)].first_port + side;
  }

  /// Joins the lower sides of a row (counted from the first) to the upper sides of the next one.
  bool join_rows(int row) {
    const auto& first = out_.first_span_of_row;
    int above = first[row];
    int below = first[row + 1];
    const int below_end = row + 2 < static_cast<int>(first.size()) ? first[row + 2] : below;
    for (; above < first[row + 1]; ++above) {
      const Span& a = out_.spans[above];
      for (int column = a.first_column; column <= a.last_column; ++column) {
        while (below < below_end && out_.spans[below].last_column < column)
          ++below;
        const bool faces = below < below_end && out_.spans[below].first_column <= column;
        const int upper = port_on_side(a, column, 2),
                  lower = faces ? port_on_side(out_.spans[below], column, 0) : kNoPort;
        if (!join(upper, lower)) return false;
      }
    }
    return true;
  }

  /// Every port has its twin, and pieces − joints + corners inside is 1, as for every disc that is cut up.
  bool is_disc() const {
    std::int64_t corners = 0;
    for (const Port& port : out_.ports) {
      if (port.twin == kNoPort) return false;
      corners += port.inside_corner ? 1 : 0;
    }
    const std::int64_t joints = static_cast<std::int64_t>(out_.ports.size()) / 2;
    return corners % 4 == 0 && out_.copy_count() - joints + corners / 4 == 1;
  }

  CellCopies out_;
  std::vector<GridCrossing> crossings_;
  std::vector<int> exit_of_chain_;
  /// The first port found at each part of a crossed edge.
  std::vector<int> port_at_part_;
};

} // namespace

Error too_many_vertices() {
  return {"mesh.too-many-vertices", "The mesh would have more than 1,000,000 vertices; choose larger cells.",
          "cell size"};
}

Result<CellCopies> cut_into_copies(const ClosedCurve& outline, const Grid& grid, const Watch& watch) {
  CHECK(outline.signed_area() > 0, "an outline must be oriented before it is cut");
  const Point size = bounds(outline.points()).size();
  const auto limit = static_cast<double>(kMostGridCrossings);
  if (!(std::max(size.x, size.y) / grid.cell() < limit / 2)) return too_many_vertices();
  // A mesh has more vertices than cells, and these hold the region.
  if (outline.signed_area() / (grid.cell() * grid.cell()) > static_cast<double>(kMostMeshVertices))
    return too_many_vertices();
  if (count_crossings(outline, grid) > kMostGridCrossings) return too_many_vertices();
  auto crossings = find_crossings(outline, grid);
  if (!crossings) return not_simple();
  CHECK(!crossings->empty(), "the outline must cross the grid");
  auto copies = Cutter(outline, grid, std::move(*crossings)).run(watch);
  if (!copies) return copies;
  const std::int64_t joints = static_cast<std::int64_t>(copies->ports.size()) / 2;
  // Euler: vertices = 1 + edges − cells, and every joint makes one edge of two.
  if (1 + 3 * std::int64_t{copies->copy_count()} - joints > kMostMeshVertices) return too_many_vertices();
  return copies;
}

} // namespace oversketch
