#include "core/deform/paper_boundary.h"

#include "core/base/check.h"
#include "core/geometry/segment_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <optional>

namespace oversketch {
namespace {

/// Samples of the outline a cell's side.
constexpr double kSamplesPerCell = 3;

struct Sample {
  double s = 0;
  double place = 0;
};

/// Finds the places of the boundary near a cell.
class LoopFinder {
public:
  explicit LoopFinder(const RegionMesh& region)
      : mesh_(region.mesh()), loop_(region.boundary()), start_(mesh_.vertices.size() + 1), at_(loop_.size()) {
    for (const int vertex : loop_)
      ++start_[vertex + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < loop_.size(); ++i)
      at_[next[loop_[i]]++] = static_cast<int>(i);
  }

  /// The nearest place on the boundary edges that meet a corner of this cell; none where no corner is on the boundary.
  std::optional<double> find(int cell, Point p) const {
    double best = HUGE_VAL, place = 0;
    const int count = static_cast<int>(loop_.size());
    for (const int vertex : mesh_.cells[cell]) {
      for (int k = start_[vertex]; k < start_[vertex + 1]; ++k) {
        for (const int from : {(at_[k] + count - 1) % count, at_[k]}) {
          const Point a = mesh_.vertices[loop_[from]], b = mesh_.vertices[loop_[(from + 1) % count]];
          const SegmentHit hit = nearest_on_segment(a, b, p);
          if (hit.squared < best) best = hit.squared, place = from + hit.t;
        }
      }
    }
    return best < HUGE_VAL ? std::optional(place) : std::nullopt;
  }

private:
  const QuadMesh& mesh_;
  const std::vector<int>& loop_;
  std::vector<int> start_;
  std::vector<int> at_;
};

std::vector<Sample> take_samples(const RegionMesh& region) {
  const LoopFinder finder(region);
  const ClosedCurve& outline = region.outline();
  const double spacing = region.mesh().cell / kSamplesPerCell;
  const int count = std::max(12, static_cast<int>(std::ceil(outline.length() / spacing)));
  std::vector<Sample> out;
  for (int k = 0; k < count; ++k) {
    const double s = outline.length() * k / count;
    if (const auto place = finder.find(region.locate_outline(s).cell, outline.at(s))) out.push_back({s, *place});
  }
  CHECK(!out.empty(), "an outline runs through cells of its mesh's boundary");
  return out;
}

/// Adds whole rounds to the places so that each is the one nearest to where its arc length lets it be expected.
void unwrap(std::vector<Sample>& samples, double length, double loop) {
  std::complex<double> mean = 0.0;
  for (const Sample& k : samples)
    mean += std::polar(1.0, 2 * std::numbers::pi * (k.place / loop - k.s / length));
  const double shift = loop * std::arg(mean) / (2 * std::numbers::pi);
  for (Sample& k : samples)
    k.place -= loop * std::round((k.place - shift) / loop - k.s / length);
}

struct Block {
  double s_sum = 0;
  double place_sum = 0;
  double count = 0;

  double s() const { return s_sum / count; }
  double place() const { return place_sum / count; }
};

/// Pool adjacent violators over three rounds: the middle one does not feel the ends.
std::vector<Block> regress(const std::vector<Sample>& samples, double length, double loop) {
  std::vector<Block> blocks;
  for (int round = -1; round <= 1; ++round) {
    for (const Sample& k : samples) {
      Block block{k.s + round * length, k.place + round * loop, 1};
      while (!blocks.empty() && blocks.back().place() >= block.place()) {
        block.s_sum += blocks.back().s_sum;
        block.place_sum += blocks.back().place_sum;
        block.count += blocks.back().count;
        blocks.pop_back();
      }
      blocks.push_back(block);
    }
  }
  return blocks;
}

} // namespace

BoundaryMap::BoundaryMap(const RegionMesh& region)
    : loop_size_(static_cast<int>(region.boundary().size())), length_(region.outline().length()) {
  const double loop = loop_size_;
  std::vector<Sample> samples = take_samples(region);
  unwrap(samples, length_, loop);
  for (const Block& block : regress(samples, length_, loop)) {
    if (block.s() < 0 || block.s() >= length_) continue;
    if (!places_.empty() && block.place() >= places_.front() + loop) continue;
    s_.push_back(block.s());
    places_.push_back(block.place());
  }
  if (s_.empty()) s_.push_back(samples.front().s), places_.push_back(samples.front().place);
  s_.push_back(s_.front() + length_);
  places_.push_back(places_.front() + loop);
}

double BoundaryMap::place_at(double s) const {
  const double rounds = std::floor((s - s_.front()) / length_);
  const double within = s - rounds * length_;
  const auto next = std::upper_bound(s_.begin() + 1, s_.end() - 1, within);
  const std::size_t k = static_cast<std::size_t>(next - s_.begin()) - 1;
  const double t = (within - s_[k]) / (s_[k + 1] - s_[k]);
  return rounds * loop_size_ + places_[k] + t * (places_[k + 1] - places_[k]);
}

} // namespace oversketch
