#pragma once

// What the fuzzers share.  Each is one source file with LLVMFuzzerTestOneInput; linked with libFuzzer it searches,
// linked with replay.cpp it is a test of every build that runs the inputs kept under corpus/.

#include "core/geometry/point.h"
#include "core/image/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

/// A property that must hold for every input: the fuzzer keeps an input for which it does not.
#define MUST_HOLD(condition, why)                                                                                      \
  do {                                                                                                                 \
    if (!(condition)) ::oversketch::fuzz::fail(__FILE__, __LINE__, #condition, why);                                   \
  } while (false)

namespace oversketch::fuzz {

[[noreturn]] inline void fail(const char* file, int line, const char* condition, std::string_view why) {
  std::fprintf(stderr, "%s:%d: must hold: %s: %.*s\n", file, line, condition, static_cast<int>(why.size()), why.data());
  std::abort();
}

/// The input, value by value; when it is used up, zeros.
class Input {
public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  int byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /// 0…count − 1.
  int below(int count) { return byte() % count; }
  bool chance() { return (byte() & 1) != 0; }
  /// Of 256 equally spaced values, both ends among them.
  double real(double low, double high) { return low + (high - low) * byte() / 255; }
  /// Of 65536 values.
  double fine(double low, double high) {
    const int coarse = byte();
    return low + (high - low) * (256 * coarse + byte()) / 65535;
  }

private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// 8-bit levels made of whole numbers alone, so that every machine makes the same picture.
inline Image striped_image(int width, int height, int kind) {
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto level = [&](int a, int b) { return static_cast<float>((a * x + b * y + 37 * kind) % 256) / 255.0f; };
      pixels.at(x, y) = {level(5, 3), level(2, 7), level(11, 1), kind % 3 == 2 && (x + y) % 5 == 0 ? 0.0f : 1.0f};
    }
  return Image(std::move(pixels));
}

} // namespace oversketch::fuzz
