#pragma once

#include "core/clone/correction.h"
#include "core/clone/live_pixel.h"
#include "core/image/display.h"

#include <cstdint>
#include <span>

namespace oversketch {

/// Rounded to 1/64 of a level and clamped to what 16 bits hold.
/// @returns whether all are opaque.
bool pack_pixels(const Rgba* from, std::size_t count, LivePixel* to);

/// A run of the mask as far as it lies on the target.
struct LiveRow {
  /// Its number in the mask, its row there, and how many of its pixels come before the target's left edge.
  std::size_t run = 0;
  int y = 0;
  int skipped = 0;
  int count = 0;
  /// Of its first pixel on the target: its number, what is there, and where it is painted.
  std::size_t pixel = 0;
  const Rgba8* below = nullptr;
  Rgba8* out = nullptr;
};

/// Paints g + u on opaque pixels: u of a membrane in units of LivePixel, else 1 for level 255.
/// @param source  by pixel number.
struct RowPainting {
  const Correction& correction;
  const LivePixel* source;
};

/// On any processor, and on those that can do so by AVX2 (CHECK, see has_avx2): the same bits.
void paint_rows(const RowPainting& painting, std::span<const LiveRow> rows);
void paint_rows_avx2(const RowPainting& painting, std::span<const LiveRow> rows);

} // namespace oversketch
