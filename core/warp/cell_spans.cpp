#include "core/warp/cell_spans.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oversketch {
namespace {

// 2⁻¹⁰ px: with |coordinates| < 2²⁰ px every product below stays under 2⁶³.
constexpr std::int64_t kOne = 1024;
constexpr std::int64_t kHalf = kOne / 2;
constexpr int kNoCell = -1;

std::int64_t to_fixed(double x) {
  CHECK(std::abs(x) < kMaskCoordinateLimit, "vertex out of range");
  return std::llround(x * static_cast<double>(kOne));
}

std::int64_t divide_down(std::int64_t a, std::int64_t positive) {
  return a / positive - (a % positive < 0 ? 1 : 0);
}

/// First pixel (row or column) whose centre is at `fixed` or beyond it.
int first_centre(std::int64_t fixed) {
  return static_cast<int>(divide_down(fixed - kHalf + kOne - 1, kOne));
}

/// The first pixel of a row whose centre is on a side or to its right, row by row, exactly: the fraction
/// ((x − ½) height + (centre − y) width) / height, rounded up, is kept as its whole part and the rest.
class SideWalk {
public:
  /// @param rise  the side's height, > 0; `run` its width, `x`, `y` its upper end, all fixed; at the row's centre.
  SideWalk(std::int64_t x, std::int64_t y, std::int64_t run, std::int64_t rise, std::int64_t centre_y)
      : unit_(kOne * rise), step_(divide_down(run, rise)), rest_step_((run - step_ * rise) * kOne) {
    const std::int64_t above = (x - kHalf) * rise + (centre_y - y) * run + unit_ - 1;
    pixel_ = divide_down(above, unit_);
    rest_ = above - pixel_ * unit_;
  }

  int pixel() const { return static_cast<int>(pixel_); }
  void next_row() {
    pixel_ += step_;
    rest_ += rest_step_;
    if (rest_ >= unit_) rest_ -= unit_, ++pixel_;
  }

private:
  std::int64_t unit_, step_, rest_step_;
  std::int64_t pixel_, rest_;
};

struct RowSpan {
  int y = 0;
  CellSpan span;
};

bool is_left(const CellSpan& a, const CellSpan& b) {
  return a.x0 < b.x0;
}

/// For spans that are nearly in order.
void sort_spans(std::span<CellSpan> spans) {
  for (std::size_t i = 1; i < spans.size(); ++i) {
    if (!is_left(spans[i], spans[i - 1])) continue;
    const CellSpan moved = spans[i];
    std::size_t at = i;
    for (; at > 0 && is_left(moved, spans[at - 1]); --at)
      spans[at] = spans[at - 1];
    spans[at] = moved;
  }
}

} // namespace

/// Where a cell's sides cross each of some rows.
struct CellRaster::Crossings {
  explicit Crossings(int rows) : pixels(static_cast<std::size_t>(rows)), counts(pixels.size(), 0) {}

  void add(int row, int pixel) {
    const auto at = static_cast<std::size_t>(row);
    // In order from the start: there are two, seldom four.
    std::size_t place = counts[at]++;
    for (; place > 0 && pixels[at][place - 1] > pixel; --place)
      pixels[at][place] = pixels[at][place - 1];
    pixels[at][place] = pixel;
  }

  std::vector<std::array<int, 4>> pixels;
  std::vector<std::uint8_t> counts;
};

CellRaster::CellRaster(const QuadMesh& mesh, const Points& deformed, const std::vector<CellInverse>& inverses,
                       const Rect& rect, const Mask* source_region)
    : mesh_(mesh), inverses_(inverses), rect_(rect), region_(source_region) {
  CHECK(inverses.size() == mesh.cells.size(), "one inverse for each cell");
  vertices_.reserve(deformed.size());
  for (const Point p : deformed)
    vertices_.push_back({to_fixed(p.x), to_fixed(p.y)});
  sort_cells(mesh);
}

void CellRaster::sort_cells(const QuadMesh& mesh) {
  const std::size_t columns = static_cast<std::size_t>(rect_.width);
  std::vector<std::size_t> ends(columns + 2, 0);
  std::vector<std::pair<std::size_t, Reach>> found;
  found.reserve(mesh.cells.size());
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    std::int64_t left = INT64_MAX, right = INT64_MIN, top = INT64_MAX, bottom = INT64_MIN;
    for (const int vertex : mesh.cells[cell]) {
      const FixedPoint& p = vertices_[static_cast<std::size_t>(vertex)];
      left = std::min(left, p.x), right = std::max(right, p.x), top = std::min(top, p.y),
      bottom = std::max(bottom, p.y);
    }
    const Reach reach{static_cast<int>(cell), std::max(first_centre(top), rect_.y),
                      std::min(first_centre(bottom), rect_.bottom())};
    const int first = std::max(first_centre(left), rect_.x), end = std::min(first_centre(right), rect_.right());
    if (reach.first >= reach.end || first >= end) continue;
    const auto column = static_cast<std::size_t>(first - rect_.x);
    ++ends[column + 1];
    found.push_back({column, reach});
  }
  for (std::size_t x = 1; x < ends.size(); ++x)
    ends[x] += ends[x - 1];
  reaches_.resize(found.size());
  for (const auto& [column, reach] : found)
    reaches_[ends[column]++] = reach;
}

void CellRaster::cross_rows(const Reach& reach, int y0, int y1, Crossings& crossings) const {
  const auto& corners = mesh_.cells[static_cast<std::size_t>(reach.cell)];
  for (std::size_t k = 0; k < 4; ++k) {
    FixedPoint a = vertices_[static_cast<std::size_t>(corners[k])];
    FixedPoint b = vertices_[static_cast<std::size_t>(corners[(k + 1) % 4])];
    if (b.y < a.y) std::swap(a, b);
    const int first = std::max(first_centre(a.y), y0), end = std::min(first_centre(b.y), y1);
    if (first >= end) continue;
    SideWalk side(a.x, a.y, b.x - a.x, b.y - a.y, first * kOne + kHalf);
    for (int y = first; y < end; ++y, side.next_row())
      crossings.add(y - y0, side.pixel());
  }
}

CellSpans CellRaster::rows(int y0, int y1) const {
  CHECK(y0 >= rect_.y && y0 <= y1 && y1 <= rect_.bottom(), "rows of the rect");
  Crossings crossings(y1 - y0);
  std::vector<RowSpan> found;
  std::vector<std::size_t> ends(static_cast<std::size_t>(y1 - y0) + 1, 0);
  for (const Reach& reach : reaches_) {
    const int first = std::max(reach.first, y0), end = std::min(reach.end, y1);
    if (first >= end) continue;
    cross_rows(reach, y0, y1, crossings);
    for (int y = first; y < end; ++y) {
      const auto at = static_cast<std::size_t>(y - y0);
      const std::size_t count = std::exchange(crossings.counts[at], std::uint8_t{0});
      for (std::size_t k = 0; k + 1 < count; k += 2) {
        const int x0 = std::max(crossings.pixels[at][k], rect_.x);
        const int x1 = std::min(crossings.pixels[at][k + 1], rect_.right());
        if (x0 >= x1) continue;
        found.push_back({y, {x0, x1, reach.cell}});
        ++ends[at + 1];
      }
    }
  }
  for (std::size_t i = 1; i < ends.size(); ++i)
    ends[i] += ends[i - 1];
  std::vector<CellSpan> by_row(found.size());
  std::vector<std::size_t> next(ends.begin(), ends.end());
  for (const RowSpan& row_span : found)
    by_row[next[static_cast<std::size_t>(row_span.y - y0)]++] = row_span.span;

  return settled(y0, std::move(by_row), std::move(ends));
}

CellSpans CellRaster::settled(int y0, std::vector<CellSpan> spans, std::vector<std::size_t> ends) const {
  const std::size_t rows = ends.size() - 1;
  const auto row = [&](std::size_t i) { return std::span(spans).subspan(ends[i], ends[i + 1] - ends[i]); };
  std::vector<char> overlaps(rows, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    sort_spans(row(i));
    overlaps[i] = std::ranges::adjacent_find(
                      row(i), [](const CellSpan& a, const CellSpan& b) { return a.x1 > b.x0; }) != row(i).end();
  }
  CellSpans out;
  out.first_row_ = y0;
  if (std::ranges::find(overlaps, 1) == overlaps.end()) {
    out.ends_ = std::move(ends);
    out.spans_ = std::move(spans);
    return out;
  }
  out.ends_.assign(1, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<CellSpan> kept(row(i).begin(), row(i).end());
    if (overlaps[i] != 0) settle_overlaps(y0 + static_cast<int>(i), kept);
    out.spans_.insert(out.spans_.end(), kept.begin(), kept.end());
    out.ends_.push_back(out.spans_.size());
  }
  return out;
}

void CellRaster::settle_overlaps(int y, std::vector<CellSpan>& spans) const {
  std::stable_sort(spans.begin(), spans.end(), [](const CellSpan& a, const CellSpan& b) { return a.cell < b.cell; });
  std::vector<int> cells(static_cast<std::size_t>(rect_.width), kNoCell);
  for (const CellSpan& span : spans)
    for (int x = span.x0; x < span.x1; ++x) {
      int& here = cells[static_cast<std::size_t>(x - rect_.x)];
      if (here == kNoCell || region_ == nullptr || wins(span.cell, here, {x + 0.5, y + 0.5})) here = span.cell;
    }
  spans.clear();
  for (int x = 0; x < rect_.width; ++x) {
    const int cell = cells[static_cast<std::size_t>(x)];
    if (cell == kNoCell) continue;
    const int at = rect_.x + x;
    if (!spans.empty() && spans.back().cell == cell && spans.back().x1 == at)
      ++spans.back().x1;
    else
      spans.push_back({at, at + 1, cell});
  }
}

bool CellRaster::wins(int later, int earlier, Point p) const {
  if (is_in_region(inverses_[static_cast<std::size_t>(later)](p))) return true;
  return !is_in_region(inverses_[static_cast<std::size_t>(earlier)](p));
}

bool CellRaster::is_in_region(Point source) const {
  const bool sane = std::abs(source.x) < kMaskCoordinateLimit && std::abs(source.y) < kMaskCoordinateLimit;
  return sane && region_->contains(static_cast<int>(std::floor(source.x)), static_cast<int>(std::floor(source.y)));
}

} // namespace oversketch
