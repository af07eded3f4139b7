#include "core/image/exact.h"

#include "core/image/decoded.h"
#include "core/image/levels.h"

#include <array>
#include <bit>
#include <cstring>

namespace oversketch {
namespace {

constexpr std::string_view kFloatSignature = "OSFLOAT1";
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kFloatHeaderBytes = 16, kPixelBytes = sizeof(Rgba);

static_assert(std::endian::native == std::endian::little, "floats are copied as they lie in memory");

/// Whether every value has the bits that its level of 1/kTop has.
template <int kTop>
bool is_exact(std::span<const Rgba> pixels) {
  // In blocks, so that the test is vector code and the first picture part that is not exact ends it.
  constexpr std::size_t kBlock = 256;
  std::array<float, 4 * kBlock> values;
  for (std::size_t at = 0; at < pixels.size(); at += kBlock) {
    const std::size_t count = std::min(kBlock, pixels.size() - at);
    std::memcpy(values.data(), pixels.data() + at, count * kPixelBytes);
    std::uint32_t differing = 0;
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const float value = values[i], inside = value > 0 ? (value < 1 ? value : 1) : 0;
      const float level = static_cast<float>(static_cast<int>(inside * static_cast<float>(kTop) + 0.5f));
      differing |= std::bit_cast<std::uint32_t>(level / static_cast<float>(kTop)) ^ std::bit_cast<std::uint32_t>(value);
    }
    if (differing != 0) return false;
  }
  return true;
}

/// Calls visit(byte of the pixels, byte of the planes) for each of them, in blocks of pixels that stay in the cache.
template <class Visit>
void for_each_plane_byte(std::size_t pixels, const Visit& visit) {
  constexpr std::size_t kBlock = 1024;
  for (std::size_t at = 0; at < pixels; at += kBlock)
    for (std::size_t k = 0; k < kPixelBytes; ++k)
      for (std::size_t i = at; i < std::min(pixels, at + kBlock); ++i)
        visit(i * kPixelBytes + k, k * pixels + i);
}

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t at) {
  ByteReader reader(bytes, at);
  return reader.u32();
}

} // namespace

std::optional<BitDepth> exact_depth(const Image& image) {
  if (is_exact<255>(image.pixels().values())) return BitDepth::k8;
  if (is_exact<65535>(image.pixels().values())) return BitDepth::k16;
  return std::nullopt;
}

Result<ExactPicture> encode_exact(const Image& image) {
  const auto depth = exact_depth(image);
  auto bytes = depth ? encode_png(image, *depth) : encode_floats(image);
  if (!bytes) return bytes.error();
  return ExactPicture{std::move(*bytes), depth ? ".png" : ".osf"};
}

Result<std::vector<std::byte>> encode_floats(const Image& image) {
  if (auto checked = check_exportable(image); !checked) return checked.error();
  const std::size_t count = image.pixels().values().size();
  std::vector<std::byte> bytes(kFloatHeaderBytes + count * kPixelBytes);
  std::memcpy(bytes.data(), kFloatSignature.data(), kFloatSignature.size());
  const std::array<std::int32_t, 2> size{image.width(), image.height()};
  std::memcpy(bytes.data() + kFloatSignature.size(), size.data(), sizeof size);
  const auto* pixels = reinterpret_cast<const std::byte*>(image.pixels().values().data());
  std::byte* planes = bytes.data() + kFloatHeaderBytes;
  for_each_plane_byte(count, [&](std::size_t pixel, std::size_t plane) { planes[plane] = pixels[pixel]; });
  return bytes;
}

Result<Decoded> decode_floats(std::span<const std::byte> file, std::int64_t most_pixels) {
  const auto size = read_image_size(file, most_pixels);
  if (!size) return size.error();
  const std::size_t count = static_cast<std::size_t>(size->width) * static_cast<std::size_t>(size->height);
  if (file.size() < kFloatHeaderBytes + count * kPixelBytes) return image_truncated("float");
  Decoded decoded = make_decoded(size->width, size->height, 4, Samples::kFloat);
  std::byte* pixels = decoded.data.get();
  const std::byte* planes = file.data() + kFloatHeaderBytes;
  for_each_plane_byte(count, [&](std::size_t pixel, std::size_t plane) { pixels[pixel] = planes[plane]; });
  const auto* values = reinterpret_cast<const float*>(pixels);
  if (!std::all_of(values, values + 4 * count, [](float value) { return value - value == 0; }))
    return image_damaged("float", "it holds values that are no numbers");
  return decoded;
}

Result<ImageSize> read_image_size(std::span<const std::byte> bytes, std::int64_t most_pixels) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::uint32_t width = 0, height = 0;
  std::string_view format = "float";
  if (text.starts_with(kFloatSignature)) {
    if (bytes.size() < kFloatHeaderBytes) return image_truncated(format);
    width = read_u32(bytes, 8), height = read_u32(bytes, 12);
  } else if (text.starts_with(kPngSignature)) {
    format = "PNG";
    if (bytes.size() < kSizeHeaderBytes) return image_truncated(format);
    ByteReader reader(bytes, 16);
    width = reader.u32_big(), height = reader.u32_big();
  } else {
    return Error{"image.unknown-format", "This is no PNG picture.", ""};
  }
  if (auto good = check_size(width, height, format, most_pixels); !good) return good.error();
  return ImageSize{static_cast<int>(width), static_cast<int>(height)};
}

} // namespace oversketch
