#include "core/image/decoded.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace oversketch {

namespace {

constexpr std::string_view kFormat = "HDR";

using Quad = std::array<std::uint8_t, 4>;

/// Scanlines as stored, and how they lie on the screen.
struct Layout {
  int width = 0;
  int height = 0;
  int orientation = 1;
};

/// The next line without its end; nothing when the file ends first.
std::optional<std::string_view> read_line(std::span<const std::byte> file, std::size_t& at) {
  const std::string_view rest(reinterpret_cast<const char*>(file.data()) + at, file.size() - at);
  const auto end = rest.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  at += end + 1;
  return rest.substr(0, end);
}

std::optional<int> read_number(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// "-Y 480 +X 640": the slow axis first; −Y runs down the screen and +X to the right.
std::optional<Layout> read_layout(std::string_view line) {
  struct Order {
    std::string_view slow;
    std::string_view fast;
    int orientation;
  };
  constexpr std::array<Order, 8> kOrders{{{"-Y ", " +X ", 1},
                                          {"-Y ", " -X ", 2},
                                          {"+Y ", " -X ", 3},
                                          {"+Y ", " +X ", 4},
                                          {"+X ", " -Y ", 5},
                                          {"-X ", " -Y ", 6},
                                          {"-X ", " +Y ", 7},
                                          {"+X ", " +Y ", 8}}};
  for (const Order& order : kOrders) {
    if (!line.starts_with(order.slow)) continue;
    std::string_view rest = line.substr(order.slow.size());
    const auto height = read_number(rest);
    if (!height || !rest.starts_with(order.fast)) continue;
    rest.remove_prefix(order.fast.size());
    const auto width = read_number(rest);
    if (width && rest.find_first_not_of(" \r") == std::string_view::npos)
      return Layout{*width, *height, order.orientation};
  }
  return std::nullopt;
}

Result<Layout> read_header(std::span<const std::byte> file, std::size_t& at) {
  for (bool first = true;; first = false) {
    const auto line = read_line(file, at);
    if (!line) return image_truncated(kFormat);
    if (line->empty() || *line == "\r") break;
    if (!first && line->starts_with("FORMAT=") && !line->starts_with("FORMAT=32-bit_rle_rgbe"))
      return image_unsupported(kFormat, "colours other than RGBE");
  }
  const auto line = read_line(file, at);
  if (!line) return image_truncated(kFormat);
  const auto layout = read_layout(*line);
  if (!layout) return image_damaged(kFormat, "its size line cannot be read");
  if (const auto size = check_size(layout->width, layout->height, kFormat); !size) return size.error();
  return *layout;
}

/// The four bytes of every pixel one after the other, each as runs (Radiance 2 and later).
Result<void> read_planes(ByteReader& reader, std::vector<Quad>& row) {
  for (std::size_t plane = 0; plane < 4; ++plane)
    for (std::size_t x = 0; x < row.size();) {
      const unsigned code = reader.u8();
      const std::size_t count = code > 128 ? code - 128 : code;
      const auto content = reader.take(code > 128 ? 1 : count);
      if (reader.past_end()) return image_truncated(kFormat);
      if (count == 0 || count > row.size() - x)
        return image_damaged(kFormat, "a run of pixels goes past its line's end");
      for (std::size_t i = 0; i < count; ++i)
        row[x++][plane] = std::to_integer<std::uint8_t>(content[code > 128 ? 0 : i]);
    }
  return {};
}

/// Pixel by pixel; (1, 1, 1, n) repeats the one before, and several such in a row are the digits of a longer count.
Result<void> read_pixels(ByteReader& reader, Quad first, std::vector<Quad>& row) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    const Quad pixel = x == 0 && shift == 0 ? first : Quad{reader.u8(), reader.u8(), reader.u8(), reader.u8()};
    if (reader.past_end()) return image_truncated(kFormat);
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = pixel;
      shift = 0;
      continue;
    }
    const std::size_t count = shift < 24 ? std::size_t{pixel[3]} << shift : row.size() + 1;
    if (x == 0 || count > row.size() - x) return image_damaged(kFormat, "a run of pixels goes past its line's end");
    for (std::size_t i = 0; i < count; ++i, ++x)
      row[x] = row[x - 1];
    shift += 8;
  }
  return {};
}

Result<void> read_row(ByteReader& reader, std::vector<Quad>& row) {
  const Quad first{reader.u8(), reader.u8(), reader.u8(), reader.u8()};
  if (reader.past_end()) return image_truncated(kFormat);
  const bool planes = row.size() >= 8 && row.size() < 32768 && first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!planes) return read_pixels(reader, first, row);
  if ((std::size_t{first[2]} << 8 | first[3]) != row.size())
    return image_damaged(kFormat, "a line is not as long as the picture is wide");
  return read_planes(reader, row);
}

/// RGBE to encoded values.  A value is m · 2^(e − 136), so its power 1/2.4 is the product of two that are tabulated.
class Encoder {
public:
  Encoder() {
    for (int i = 0; i < 256; ++i) {
      const auto n = static_cast<std::size_t>(i);
      mantissa_power_[n] = 1.055 * std::pow(i, 1 / 2.4);
      exponent_power_[n] = i == 0 ? 0.0 : std::pow(2.0, (i - 136) / 2.4);
      exponent_[n] = i == 0 ? 0.0 : std::ldexp(1.0, i - 136);
    }
  }
  float operator()(std::uint8_t mantissa, std::uint8_t exponent) const {
    const double linear = mantissa * exponent_[exponent];
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : mantissa_power_[mantissa] * exponent_power_[exponent] - 0.055;
    return static_cast<float>(encoded);
  }

private:
  std::array<double, 256> mantissa_power_{};
  std::array<double, 256> exponent_power_{};
  std::array<double, 256> exponent_{};
};

} // namespace

Result<Decoded> decode_hdr(std::span<const std::byte> file) {
  std::size_t at = 0;
  const Result<Layout> layout = read_header(file, at);
  if (!layout) return layout.error();
  ByteReader reader(file, at);
  Decoded decoded = make_decoded(layout->width, layout->height, 3, Samples::kFloat);
  decoded.orientation = layout->orientation;
  const Encoder encode;
  std::vector<Quad> row(static_cast<std::size_t>(layout->width));
  for (int y = 0; y < layout->height; ++y) {
    if (const auto read = read_row(reader, row); !read) return read.error();
    auto* out = reinterpret_cast<float*>(decoded.row(y));
    for (const Quad& p : row)
      for (std::size_t c = 0; c < 3; ++c)
        *out++ = encode(p[c], p[3]);
  }
  return decoded;
}

} // namespace oversketch
