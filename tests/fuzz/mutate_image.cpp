// How libFuzzer changes pictures: a PNG whose checksums are wrong is refused at once, so what was changed gets right
// ones.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

/// CRC-32 of a PNG's chunk (PNG specification, annex D).
std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = crc & 1 ? 0xedb88320 ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

/// Gives every whole chunk of a PNG its checksum, as far as the lengths lead from chunk to chunk.
void mend_png_checksums(std::span<std::uint8_t> file) {
  constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (file.size() < 8 || std::memcmp(file.data(), kSignature.data(), 8) != 0) return;
  for (std::size_t at = 8; file.size() - at >= 12;) {
    const std::size_t length = std::size_t{file[at]} << 24 | std::size_t{file[at + 1]} << 16 |
                               std::size_t{file[at + 2]} << 8 | std::size_t{file[at + 3]};
    if (length > file.size() - at - 12) return;
    const std::uint32_t crc = crc32_of(file.subspan(at + 4, length + 4));
    for (std::size_t k = 0; k < 4; ++k)
      file[at + 8 + length + k] = static_cast<std::uint8_t>(crc >> (24 - 8 * k));
    at += 12 + length;
  }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, most);
  // Now and then they stay wrong: that is an input, too.
  if (seed % 8 != 0) mend_png_checksums({data, mutated});
  return mutated;
}
