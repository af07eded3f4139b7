#pragma once

#include "core/clone/float4.h"
#include "core/clone/grid_kernels.h"
#include "core/clone/live_pixel.h"
#include "core/image/display.h"
#include "core/image/image.h"

#include <cstddef>
#include <span>

namespace oversketch {

// Pixels between the ways in which they are stored: channel by channel in planes (red, green, blue, `stride` floats
// apart); pixel by pixel; and in the slots of a grid's run.  Four pixels at once, the same bits on every processor.

/// Encoded values.  @returns whether all pixels are opaque.
bool to_planes(const Rgba* from, std::size_t count, float* planes, std::size_t stride);
bool to_planes(const Rgba8* from, std::size_t count, float* planes, std::size_t stride);
/// Alpha is not looked at.
void to_planes(const LivePixel* from, std::size_t count, float* planes, std::size_t stride);

void to_slots(const float* planes, std::size_t stride, std::size_t count, GridSlots<float> slots);
void to_slots(std::span<const Float4> from, GridSlots<float> slots);
/// The fourth number becomes 0.
/// @param slots  one float more than the slots can be read.
void from_slots(GridSlots<const float> slots, std::span<Float4> to);

} // namespace oversketch
