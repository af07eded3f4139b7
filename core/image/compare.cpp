#include "core/image/compare.h"

#include "core/image/levels.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

namespace oversketch {

namespace {

std::string size_text(const Image& image) {
  return std::to_string(image.width()) + " × " + std::to_string(image.height());
}

/// Two rows as levels, the same buffers used for every row.
struct LevelRows {
  explicit LevelRows(int width) : a(static_cast<std::size_t>(width) * 4), b(a.size()) {}
  void load(const Image& first, const Image& second, int y) {
    to_levels8(first.pixels().row(y), a);
    to_levels8(second.pixels().row(y), b);
  }
  int difference(std::size_t i) const { return std::abs(int{a[i]} - int{b[i]}); }

  std::vector<std::uint8_t> a;
  std::vector<std::uint8_t> b;
};

} // namespace

Result<Difference> compare(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height())
    return Error{"image.size-differs",
                 "The pictures differ in size: " + size_text(a) + " and " + size_text(b) + " pixels.", ""};
  Difference found;
  std::int64_t sum = 0;
  int largest = 0;
  LevelRows rows(a.width());
  for (int y = 0; y < a.height(); ++y) {
    rows.load(a, b, y);
    if (rows.a == rows.b) continue;
    for (int x = 0; x < a.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(x) * 4;
      const std::array d{rows.difference(i), rows.difference(i + 1), rows.difference(i + 2), rows.difference(i + 3)};
      const int total = d[0] + d[1] + d[2] + d[3];
      if (total == 0) continue;
      sum += total;
      ++found.differing;
      const int most = *std::max_element(d.begin(), d.end());
      if (most > largest) largest = most, found.x = x, found.y = y;
    }
  }
  found.max_levels = largest;
  const double count = 4.0 * a.width() * a.height();
  found.mean_levels = count > 0 ? static_cast<double>(sum) / count : 0.0;
  return found;
}

Image difference_image(const Image& a, const Image& b, double gain) {
  CHECK(a.width() == b.width() && a.height() == b.height(), "difference of pictures of different sizes");
  Raster<Rgba> out(a.width(), a.height());
  LevelRows rows(a.width());
  const auto scale = static_cast<float>(gain / 255.0);
  for (int y = 0; y < a.height(); ++y) {
    rows.load(a, b, y);
    for (int x = 0; x < a.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(x) * 4;
      const auto value = [&](std::size_t c) {
        return scale * static_cast<float>(rows.difference(i + c) + rows.difference(i + 3));
      };
      out.at(x, y) = {value(0), value(1), value(2), 1.0f};
    }
  }
  return Image(std::move(out));
}

} // namespace oversketch
