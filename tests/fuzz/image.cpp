// Bytes as a picture, through the reader that all programs here use, with a small limit of pixels.

#include "core/image/exact.h"
#include "core/image/image_io.h"

#include "tests/fuzz/fuzz.h"

#include <cmath>
#include <cstring>
#include <span>

namespace oversketch::fuzz {
namespace {

constexpr std::int64_t kMostPixels = 1 << 16;

bool same_bits(const Image& a, const Image& b) {
  return a.rect() == b.rect() &&
         std::memcmp(a.pixels().values().data(), b.pixels().values().data(), a.pixels().values().size_bytes()) == 0;
}

void run(std::span<const std::byte> bytes) {
  const auto size = read_image_size(bytes, kMostPixels);
  const auto image = decode_image(bytes, kMostPixels);
  if (!image) {
    MUST_HOLD(!image.error().code.empty() && !image.error().sentence.empty(), "an error says why");
    return;
  }
  MUST_HOLD(image->width() > 0 && image->height() > 0, "a picture has pixels");
  const std::int64_t count = std::int64_t{image->width()} * image->height();
  MUST_HOLD(count <= kMostPixels, "no more than were allowed");
  // An orientation may have turned it.
  MUST_HOLD(!size || count == std::int64_t{size->width} * size->height, "as many as the header said");
  if (!check_exportable(*image)) return;
  const auto packed = encode_exact(*image);
  MUST_HOLD(packed.ok(), "what was read can be written");
  const auto again = decode_image(packed->bytes);
  MUST_HOLD(again.ok() && same_bits(*image, *again), "to the bit");
}

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  oversketch::fuzz::run(std::as_bytes(std::span(data, size)));
  return 0;
}
