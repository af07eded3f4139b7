#include "core/image/decoded.h"

#include "core/image/image_io.h"

#include <algorithm>
#include <array>

namespace oversketch {

namespace {

std::string say_pixels(std::int64_t count) {
  constexpr std::int64_t kMega = 1'000'000;
  return count < kMega ? std::to_string(count) + " pixels" : std::to_string(count / kMega) + " megapixels";
}

std::size_t sample_bytes(Samples samples) {
  switch (samples) {
  case Samples::kU8:
    return 1;
  case Samples::kU16:
    return 2;
  case Samples::kFloat:
    return 4;
  }
  return 0;
}

/// Where stored pixel (x, y) goes: index = origin + x · step_x + y · step_y.
struct Placement {
  int width;
  int height;
  std::ptrdiff_t origin;
  std::ptrdiff_t step_x;
  std::ptrdiff_t step_y;
};

Placement place(const Decoded& d) {
  const bool turned = d.orientation >= 5;
  Placement p{turned ? d.height : d.width, turned ? d.width : d.height, 0, 1, 0};
  // EXIF 2.32, tag 0x0112: which edges of the picture the stored first row and first column are.
  const bool from_right = d.orientation == 2 || d.orientation == 3 || d.orientation == 6 || d.orientation == 7;
  const bool from_bottom = d.orientation == 3 || d.orientation == 4 || d.orientation == 7 || d.orientation == 8;
  const std::ptrdiff_t across = from_right ? -1 : 1;
  const std::ptrdiff_t down = from_bottom ? -std::ptrdiff_t{p.width} : std::ptrdiff_t{p.width};
  p.origin = (from_right ? p.width - 1 : 0) + std::ptrdiff_t{from_bottom ? p.height - 1 : 0} * p.width;
  p.step_x = turned ? down : across;
  p.step_y = turned ? across : down;
  return p;
}

/// Samples as values.  Of 8 bits by table, which is several times as fast as dividing.
template <class Sample>
struct Values {
  float operator()(Sample sample) const {
    if constexpr (sizeof(Sample) == 2) return static_cast<float>(sample) / 65535.0f;
    if constexpr (sizeof(Sample) == 4) return sample;
  }
};

template <>
struct Values<std::uint8_t> {
  Values() {
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(i) / 255.0f;
  }
  float operator()(std::uint8_t sample) const { return table[sample]; }
  std::array<float, 256> table;
};

template <class Sample, int kChannels>
Rgba to_pixel(const Sample* s, const Values<Sample>& value) {
  const float first = value(s[0]);
  if constexpr (kChannels == 1) return {first, first, first, 1};
  if constexpr (kChannels == 2) return {first, first, first, value(s[1])};
  if constexpr (kChannels == 3) return {first, value(s[1]), value(s[2]), 1};
  if constexpr (kChannels == 4) return {first, value(s[1]), value(s[2]), value(s[3])};
}

template <class Sample, int kChannels>
Image convert(const Decoded& d) {
  const Placement p = place(d);
  const Values<Sample> value;
  Raster<Rgba> out(p.width, p.height);
  Rgba* const pixels = out.values().data();
  const auto row = [&](int y) { return reinterpret_cast<const Sample*>(d.row(y)); };
  if (p.step_x == 1) {
    for (int y = 0; y < d.height; ++y) {
      const Sample* in = row(y);
      Rgba* const to = pixels + p.origin + y * p.step_y;
      for (int x = 0; x < d.width; ++x, in += kChannels)
        to[x] = to_pixel<Sample, kChannels>(in, value);
    }
    return Image(std::move(out));
  }
  // In tiles, so that the columns written by a turn stay in the cache.
  constexpr int kTile = 32;
  for (int top = 0; top < d.height; top += kTile)
    for (int left = 0; left < d.width; left += kTile)
      for (int y = top; y < std::min(top + kTile, d.height); ++y)
        for (int x = left; x < std::min(left + kTile, d.width); ++x)
          pixels[p.origin + x * p.step_x + y * p.step_y] = to_pixel<Sample, kChannels>(row(y) + x * kChannels, value);
  return Image(std::move(out));
}

template <class Sample>
Image convert_channels(const Decoded& d) {
  switch (d.channels) {
  case 1:
    return convert<Sample, 1>(d);
  case 2:
    return convert<Sample, 2>(d);
  case 3:
    return convert<Sample, 3>(d);
  default:
    return convert<Sample, 4>(d);
  }
}

} // namespace

std::size_t Decoded::row_bytes() const {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * sample_bytes(samples);
}

Decoded make_decoded(int width, int height, int channels, Samples samples) {
  Decoded d{.width = width, .height = height, .channels = channels, .samples = samples};
  d.data = PixelMemory(new std::byte[d.row_bytes() * static_cast<std::size_t>(height)],
                       [](void* pixels) { delete[] static_cast<std::byte*>(pixels); });
  return d;
}

Image to_image(const Decoded& decoded) {
  CHECK(decoded.orientation >= 1 && decoded.orientation <= 8, "no such orientation");
  CHECK(decoded.channels >= 1 && decoded.channels <= 4, "1 to 4 samples a pixel");
  switch (decoded.samples) {
  case Samples::kU8:
    return convert_channels<std::uint8_t>(decoded);
  case Samples::kU16:
    return convert_channels<std::uint16_t>(decoded);
  case Samples::kFloat:
    return convert_channels<float>(decoded);
  }
  return {};
}

Result<void> check_size(std::int64_t width, std::int64_t height, std::string_view format, std::int64_t most_pixels) {
  if (width <= 0 || height <= 0) return image_damaged(format, "its header says that it has no pixels");
  const std::int64_t most = std::min(most_pixels, kMaxPixels);
  if (width > most || height > most || width * height > most)
    return image_too_large(format, "it says it has " + std::to_string(width) + " × " + std::to_string(height) +
                                       " pixels; at most " + say_pixels(most) + " are opened");
  return {};
}

Error image_truncated(std::string_view format) {
  return {"image.truncated",
          "The " + std::string(format) + " file ends before the picture does. Copy or download it again.", ""};
}

Error image_damaged(std::string_view format, std::string_view reason) {
  return {"image.damaged", "The " + std::string(format) + " file is damaged: " + std::string(reason) + ".", ""};
}

Error image_unsupported(std::string_view format, std::string_view what) {
  return {"image.unsupported",
          "The " + std::string(format) + " file uses " + std::string(what) +
              ", which is not read. Save it as an ordinary PNG or JPEG with another program.",
          ""};
}

Error image_too_large(std::string_view format, std::string_view why) {
  return {"image.too-large", "The " + std::string(format) + " picture is too large: " + std::string(why) + ".", ""};
}

} // namespace oversketch
