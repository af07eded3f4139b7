#pragma once

#include "core/image/image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace oversketch {

/// What export does to values, and the only place where it is done: value · 255 (or 65535) rounded to the nearest
/// level, below 0 to the lowest and above 1 to the highest.  A picture read from 8 (16) bits gives the same bits back.
///
/// Values must be finite: see is_finite(); NaN gives level 0 here.
/// @param levels  4 numbers a pixel, r g b a; as long as `pixels` · 4 (CHECK).
/// @cost about 5 ns a pixel, memory bound.
void to_levels8(std::span<const Rgba> pixels, std::span<std::uint8_t> levels);
void to_levels16(std::span<const Rgba> pixels, std::span<std::uint16_t> levels);

/// The whole picture, r g b a r g b a …, row by row without padding: what a screen texture or a comparison takes.
std::vector<std::uint8_t> to_rgba8(const Raster<Rgba>& pixels);
std::vector<std::uint8_t> to_rgba8(const Image& image);

/// True when no value is NaN or infinite.
bool is_finite(std::span<const Rgba> pixels);

/// A picture of one colour; sizes must not be negative (CHECK).
Image filled(int width, int height, Rgba color);

} // namespace oversketch
