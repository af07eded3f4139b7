#include "core/image/resample.h"

#include "core/base/check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace oversketch {

namespace {

/// Colour times alpha times covered area, and alpha times covered area.
struct Sum {
  double r = 0;
  double g = 0;
  double b = 0;
  double a = 0;

  void add(const Sum& other, double weight) {
    r += weight * other.r;
    g += weight * other.g;
    b += weight * other.b;
    a += weight * other.a;
  }
};

/// The one or two new pixels that an old one falls on: `part` of it on `first`, the rest on the one after.
struct Share {
  int first = 0;
  double part = 1;
};

/// Old pixel i covers [i, i + 1) · to / from of the new ones; in integers, so that no pixel is lost to rounding.
std::vector<Share> shares(int from, int to) {
  std::vector<Share> all(static_cast<std::size_t>(from));
  for (int i = 0; i < from; ++i) {
    const std::int64_t begin = std::int64_t{i} * to, end = begin + to;
    const std::int64_t first = begin / from, border = (first + 1) * from;
    const double part = end <= border ? 1.0 : static_cast<double>(border - begin) / to;
    all[static_cast<std::size_t>(i)] = {static_cast<int>(first), part};
  }
  return all;
}

void add_row(std::span<const Rgba> row, const std::vector<Share>& columns, std::vector<Sum>& sums) {
  for (std::size_t x = 0; x < row.size(); ++x) {
    const Rgba& p = row[x];
    const Sum value{double{p.r} * p.a, double{p.g} * p.a, double{p.b} * p.a, p.a};
    const auto first = static_cast<std::size_t>(columns[x].first);
    sums[first].add(value, columns[x].part);
    if (columns[x].part < 1) sums[first + 1].add(value, 1 - columns[x].part);
  }
}

Rgba straight(const Sum& sum, double area) {
  if (sum.a == 0) return {0, 0, 0, 0};
  return {static_cast<float>(sum.r / sum.a), static_cast<float>(sum.g / sum.a), static_cast<float>(sum.b / sum.a),
          static_cast<float>(sum.a / area)};
}

} // namespace

Image downscaled(const Image& image, int width, int height) {
  CHECK(width >= 1 && height >= 1 && width <= image.width() && height <= image.height(), "downscaled() only shrinks");
  if (width == image.width() && height == image.height()) return image;
  const std::vector<Share> columns = shares(image.width(), width), rows = shares(image.height(), height);
  // How much a new pixel sums up, in old pixels.
  const double area = static_cast<double>(image.width()) / width * (static_cast<double>(image.height()) / height);
  Raster<Rgba> out(width, height);
  std::vector<Sum> line(static_cast<std::size_t>(width)), now(line.size()), next(line.size());
  for (int y = 0; y < image.height(); ++y) {
    std::fill(line.begin(), line.end(), Sum{});
    add_row(image.pixels().row(y), columns, line);
    const Share& share = rows[static_cast<std::size_t>(y)];
    for (std::size_t x = 0; x < line.size(); ++x)
      now[x].add(line[x], share.part);
    const bool last_of_row = y + 1 == image.height() || rows[static_cast<std::size_t>(y) + 1].first != share.first;
    if (!last_of_row) continue;
    for (std::size_t x = 0; x < line.size(); ++x) {
      if (share.part < 1) next[x].add(line[x], 1 - share.part);
      out.at(static_cast<int>(x), share.first) = straight(now[x], area);
    }
    now.swap(next);
    std::fill(next.begin(), next.end(), Sum{});
  }
  return Image(std::move(out));
}

} // namespace oversketch
