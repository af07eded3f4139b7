#include "core/deform/cleanup.h"

#include "core/geometry/mask.h"
#include "core/geometry/point_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>

namespace oversketch {
namespace {

constexpr double kLeastArea = 1.0;
/// Least area as a part of the square whose perimeter the curve has: below it the sketch is a line.
constexpr double kLeastFill = 1e-3;
constexpr int kMostCrossings = 10;

/// A place where the curve crosses itself: arc lengths first < second.
struct Cut {
  double first = 0;
  double second = 0;
  Point point;
  double loop = 0;
};

struct Piece {
  double end = 0;
  Point point;
};

/// The vertex furthest in a direction that no ruler and no axis suggests.
std::size_t find_start(const Points& points) {
  const Point direction{std::cos(1.0), std::sin(1.0)};
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (dot(points[i] - points[best], direction) > 0) best = i;
  return best;
}

/// Segments by the cells of a uniform grid over their box.
class SegmentGrid {
public:
  explicit SegmentGrid(const Points& points) : points_(points), box_(bounds(points)) {
    const double n = static_cast<double>(points.size());
    side_ = std::max({box_.size().x, box_.size().y, 1e-12}) / std::ceil(std::sqrt(n));
    columns_ = static_cast<int>(box_.size().x / side_) + 1;
    rows_ = static_cast<int>(box_.size().y / side_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < points.size(); ++i)
      insert(i);
  }

  const std::vector<std::vector<int>>& cells() const { return cells_; }

private:
  int column(double x) const { return std::clamp(static_cast<int>((x - box_.low.x) / side_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - box_.low.y) / side_), 0, rows_ - 1); }

  /// Row by row, so that a long slanted segment fills a line of cells and not its box.
  void insert(std::size_t i) {
    Point a = points_[i], b = points_[(i + 1) % points_.size()];
    if (a.y > b.y) std::swap(a, b);
    for (int r = row(a.y); r <= row(b.y); ++r) {
      const auto x_at = [&](double y) {
        return b.y > a.y ? a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : a.x;
      };
      double x0 = x_at(box_.low.y + r * side_), x1 = b.y > a.y ? x_at(box_.low.y + (r + 1) * side_) : b.x;
      if (x0 > x1) std::swap(x0, x1);
      const double slack = 1e-9 * side_;
      for (int c = column(x0 - slack); c <= column(x1 + slack); ++c)
        cells_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)]
            .push_back(static_cast<int>(i));
    }
  }

  const Points& points_;
  Box box_;
  double side_ = 1;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::vector<int>> cells_;
};

/// Where segments ab and cd cross, as the part of each; a point exactly on the other segment counts to one side only.
std::optional<std::pair<double, double>> cross_segments(Point a, Point b, Point c, Point d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if ((c_side >= 0) == (d_side >= 0) || (a_side >= 0) == (b_side >= 0)) return std::nullopt;
  return std::pair{a_side / (a_side - b_side), c_side / (c_side - d_side)};
}

/// All crossings of segments that are no neighbours; nullopt when there are too many to make sense of.
std::optional<std::vector<Cut>> find_cuts(const Points& points, const std::vector<double>& s, double total) {
  const std::size_t n = points.size();
  std::vector<std::pair<int, int>> pairs;
  const std::size_t most = kMostCrossings * n + 100;
  const auto crossing = [&](int i, int j) {
    return cross_segments(points[i], points[(i + 1) % n], points[j], points[(j + 1) % n]);
  };
  const SegmentGrid grid(points);
  for (const auto& cell : grid.cells())
    for (std::size_t k = 0; k < cell.size(); ++k)
      for (std::size_t l = k + 1; l < cell.size(); ++l) {
        const int i = std::min(cell[k], cell[l]), j = std::max(cell[k], cell[l]);
        if (j - i < 2 || (i == 0 && j + 1 == static_cast<int>(n))) continue;
        if (crossing(i, j)) pairs.emplace_back(i, j);
        if (pairs.size() > 4 * most) return std::nullopt;
      }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (pairs.size() > most) return std::nullopt;
  std::vector<Cut> cuts;
  for (const auto& [i, j] : pairs) {
    const auto [t, u] = *crossing(i, j);
    const Point a = points[i], b = points[(i + 1) % n];
    const double first = s[i] + t * distance(a, b), second = s[j] + u * distance(points[j], points[(j + 1) % n]);
    cuts.push_back({first, second, lerp(a, b, t), std::min(second - first, total - (second - first))});
  }
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.loop < b.loop; });
  return cuts;
}

/// Which parts of [0, total) have been cut away: start → end (beyond `total` when it wraps) and what stands there
/// instead.
class CutAway {
public:
  explicit CutAway(double total) : total_(total) {}

  bool holds(double s) const {
    const auto next = pieces_.upper_bound(s);
    if (next != pieces_.begin() && s < std::prev(next)->second.end) return true;
    return !pieces_.empty() && s + total_ < std::prev(pieces_.end())->second.end;
  }

  /// Length within [first, second) that is still there.
  double remaining(double first, double second) const {
    double left = second - first;
    for (const auto& [start, piece] : pieces_)
      for (const double shift : {0.0, total_})
        if (start + shift >= first && piece.end + shift <= second) left -= piece.end - start;
    return left;
  }

  void add(double first, double second, Point point) {
    std::erase_if(pieces_, [&](const auto& entry) {
      const double start = entry.first;
      return (start >= first && start < second) || start + total_ < second;
    });
    pieces_.emplace(first, Piece{second, point});
  }

  const std::map<double, Piece>& pieces() const { return pieces_; }

private:
  double total_;
  std::map<double, Piece> pieces_;
};

/// Points with the arc length where each is come to and left.
struct Measured {
  Points points;
  std::vector<double> s;
  std::vector<double> left;
};

/// Cuts the loops, shortest first: a loop within a loop goes with it.
Result<CutAway> cut_loops(const std::vector<Cut>& cuts, double total) {
  CutAway away(total);
  double left = total;
  for (const Cut& cut : cuts) {
    if (away.holds(cut.first) || away.holds(cut.second)) continue;
    const bool inner = cut.second - cut.first <= total - (cut.second - cut.first);
    const double from = inner ? cut.first : cut.second, to = inner ? cut.second : cut.first + total;
    const double loop = away.remaining(from, to);
    if (loop > kLargestLoop * left)
      return Error{"sketch.crosses-itself",
                   "The sketch crosses itself at " + point_text(cut.point) +
                       " with a large part on either side; draw it as one simple closed line.",
                   ""};
    away.add(from, to, cut.point);
    left -= loop;
  }
  return away;
}

Measured without_pieces(const Measured& given, const CutAway& away, double total) {
  Measured kept;
  auto piece = away.pieces().begin();
  const auto put = [&](Point p, double s, double left) {
    if (!kept.points.empty() && kept.points.back() == p) return;
    kept.points.push_back(p);
    kept.s.push_back(s);
    kept.left.push_back(left);
  };
  const auto put_piece = [&] {
    put(piece->second.point, piece->first, piece->second.end < total ? piece->second.end : piece->second.end - total);
    ++piece;
  };
  for (std::size_t i = 0; i < given.points.size(); ++i) {
    while (piece != away.pieces().end() && piece->first <= given.s[i])
      put_piece();
    if (!away.holds(given.s[i])) put(given.points[i], given.s[i], given.s[i]);
  }
  while (piece != away.pieces().end())
    put_piece();
  return kept;
}

Result<Measured> check_points(const Points& given) {
  for (const Point p : given) {
    if (!is_finite(p)) return Error{"sketch.not-finite", "A point of the sketch is not a finite number.", ""};
    if (std::max(std::abs(p.x), std::abs(p.y)) >= kMaskCoordinateLimit)
      return Error{"sketch.too-far", "The sketch reaches more than a million pixels away from the picture.", ""};
  }
  Measured measured{without_repeats(given), {}, {}};
  if (measured.points.size() < 3)
    return Error{"sketch.too-few-points", "A sketch needs at least 3 different points.", ""};
  double s = 0;
  for (std::size_t i = 0; i < measured.points.size(); ++i) {
    measured.s.push_back(s);
    s += distance(measured.points[i], measured.points[(i + 1) % measured.points.size()]);
  }
  return measured;
}

/// Turns the curve round and starts it where its shape says.
CleanSketch make_clean(Measured kept, double orientation, double total) {
  const bool reversed = signed_area(kept.points) * orientation < 0;
  if (reversed) {
    std::reverse(kept.points.begin(), kept.points.end());
    std::reverse(kept.s.begin(), kept.s.end());
    std::reverse(kept.left.begin(), kept.left.end());
    std::swap(kept.s, kept.left);
    for (auto* places : {&kept.s, &kept.left})
      for (double& s : *places)
        s = s > 0 ? total - s : 0.0;
  }
  const auto start = static_cast<std::ptrdiff_t>(find_start(kept.points));
  std::rotate(kept.points.begin(), kept.points.begin() + start, kept.points.end());
  std::rotate(kept.s.begin(), kept.s.begin() + start, kept.s.end());
  std::rotate(kept.left.begin(), kept.left.begin() + start, kept.left.end());
  ClosedCurve curve(std::move(kept.points));
  return {std::move(curve), std::move(kept.s), std::move(kept.left), total, reversed, 0, 0};
}

} // namespace

double CleanSketch::to_given(double s) const {
  s = curve.wrap(s);
  const int i = curve.segment_at(s), next = (i + 1) % curve.size();
  const double from = curve.s_at(i), to = next == 0 ? curve.length() : curve.s_at(next);
  double ahead = given_s[next] - left_s[i];
  // Less than nothing by rounding is not a whole round.
  if (ahead < -0.5 * given_length) ahead += given_length;
  ahead = std::max(ahead, 0.0);
  const double t = to > from ? std::clamp((s - from) / (to - from), 0.0, 1.0) : 0.0;
  const double at = left_s[i] + t * ahead;
  return at >= given_length ? at - given_length : at;
}

Result<CleanSketch> clean_sketch(const Points& given, double orientation) {
  auto checked = check_points(given);
  if (!checked) return checked.error();
  Measured& measured = *checked;
  const double total = perimeter(measured.points);
  const auto cuts = find_cuts(measured.points, measured.s, total);
  if (!cuts)
    return Error{"sketch.tangled", "The sketch crosses itself too often to be an outline; draw one closed line.", ""};
  const auto away = cut_loops(*cuts, total);
  if (!away) return away.error();
  Measured kept = without_pieces(measured, *away, total);
  const double around = kept.points.size() < 3 ? 0.0 : perimeter(kept.points);
  const double area = kept.points.size() < 3 ? 0.0 : std::abs(signed_area(kept.points));
  if (area < std::max(kLeastArea, kLeastFill * around * around / 16))
    return Error{"sketch.no-area", "The sketch encloses hardly any area for its length; draw it larger or plainer.",
                 ""};
  CleanSketch clean = make_clean(std::move(kept), orientation, total);
  for (const auto& [start, piece] : away->pieces()) {
    ++clean.loops_cut;
    clean.cut_length += piece.end - start;
  }
  return clean;
}

} // namespace oversketch
