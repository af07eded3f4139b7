#include "core/image/decoded.h"
#include "core/image/stb_load.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>

namespace oversketch {

namespace {

constexpr std::string_view kHdr = "HDR";

struct HdrHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::size_t pixels_at = 0;
};

/// "-Y 480 ": the name of an axis, the way along it and its length.
struct Axis {
  std::string_view name;
  std::int64_t length = 0;
};

std::optional<Axis> take_axis(std::string_view& text) {
  Axis axis{text.substr(0, 3), 0};
  if (axis.name != "-Y " && axis.name != "+Y " && axis.name != "-X " && axis.name != "+X ") return std::nullopt;
  const auto [end, error] = std::from_chars(text.data() + 3, text.data() + text.size(), axis.length);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return axis;
}

/// The lines up to an empty one are read by stb_image; the one behind it holds the size, the slow axis first.
Result<HdrHeader> read_header(std::string_view text, std::int64_t most_pixels) {
  const std::size_t empty = text.find("\n\n");
  const std::size_t end = empty == std::string_view::npos ? empty : text.find('\n', empty + 2);
  if (end == std::string_view::npos) return image_truncated(kHdr);
  std::string_view line = text.substr(empty + 2, end - empty - 2);
  const auto slow = take_axis(line), fast = take_axis(line);
  if (!slow || !fast || !line.empty() || slow->name[1] == fast->name[1])
    return image_damaged(kHdr, "its size line cannot be read");
  if (const auto size = check_size(fast->length, slow->length, kHdr, most_pixels); !size) return size.error();
  if (slow->name != "-Y " || fast->name != "+X ")
    return image_unsupported(kHdr, "pixels in another order than rows from the top");
  return HdrHeader{fast->length, slow->length, end + 1};
}

/// Whether the pixels can be as many as the header says, before memory is taken for them.
Result<void> check_pixels(const HdrHeader& h, std::span<const std::byte> pixels) {
  const auto width = static_cast<std::uint64_t>(h.width), height = static_cast<std::uint64_t>(h.height);
  const auto byte = [&](std::size_t i) { return i < pixels.size() ? std::to_integer<int>(pixels[i]) : -1; };
  const bool planes = width >= 8 && width < 32768 && byte(0) == 2 && byte(1) == 2 && byte(2) < 128;
  if (planes) {
    // A run is two bytes for 127 values at most, and there are four of each pixel.
    if (pixels.size() < height * (4 + 4 * 2 * ((width + 126) / 127))) return image_truncated(kHdr);
    return {};
  }
  for (std::size_t i = 0; i + 3 < std::min<std::uint64_t>(pixels.size(), width * height * 4); i += 4)
    if (byte(i) == 1 && byte(i + 1) == 1 && byte(i + 2) == 1)
      return image_unsupported(kHdr, "run-length coding as Radiance wrote it before 1991");
  if (pixels.size() < width * height * 4) return image_truncated(kHdr);
  return {};
}

/// Linear values to encoded ones, IEC 61966-2-1 (srgb.h).  A value's binary fraction has eight digits at most, being
/// an RGBE mantissa: its power 1/2.4 is the product of one of 128 powers and one of its exponent.
class Encoder {
public:
  Encoder() {
    for (std::size_t i = 0; i < fraction_power_.size(); ++i)
      fraction_power_[i] = 1.055 * std::pow(1 + static_cast<double>(i) / 128, 1 / 2.4);
    for (std::size_t i = 0; i < exponent_power_.size(); ++i)
      exponent_power_[i] = std::pow(2.0, (static_cast<double>(i) - 127) / 2.4);
  }
  float operator()(float linear) const {
    if (linear <= 0.0031308f) return static_cast<float>(12.92 * linear);
    const auto bits = std::bit_cast<std::uint32_t>(linear);
    return static_cast<float>(fraction_power_[bits >> 16 & 127] * exponent_power_[bits >> 23 & 255] - 0.055);
  }

private:
  std::array<double, 128> fraction_power_{};
  std::array<double, 256> exponent_power_{};
};

} // namespace

Result<Decoded> decode_hdr(std::span<const std::byte> file, std::int64_t most_pixels) {
  const auto header = read_header({reinterpret_cast<const char*>(file.data()), file.size()}, most_pixels);
  if (!header) return header.error();
  if (const auto pixels = check_pixels(*header, file.subspan(header->pixels_at)); !pixels) return pixels.error();
  Result<Decoded> decoded = load_with_stb(file, {kHdr, header->width, header->height, 3, Samples::kFloat});
  if (!decoded) return decoded;
  const Encoder encode;
  for (int y = 0; y < decoded->height; ++y) {
    auto* const row = reinterpret_cast<float*>(decoded->row(y));
    for (std::size_t i = 0; i < static_cast<std::size_t>(decoded->width) * 3; ++i)
      row[i] = encode(row[i]);
  }
  return decoded;
}

} // namespace oversketch
