#include "core/clone/live_rows.h"

#include "core/base/check.h"
#include "core/base/processor.h"
#include "core/clone/read_ahead.h"

#include <algorithm>
#include <cmath>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace oversketch {
namespace {

static_assert(sizeof(LivePixel) == 8 && sizeof(Rgba8) == 4);

// A painter writes `count` pixels, four at a time.  Of the up to three that this is too many, those within `room` are
// painted over by the next call.

#if defined(__x86_64__)

struct SsePainter {
  static void store(Rgba8* out, const LivePixel* g, __m128 a, __m128 b, __m128 c, __m128 d) {
    const auto* from = reinterpret_cast<const __m128i*>(g);
    const __m128i low = _mm_packs_epi32(_mm_cvtps_epi32(a), _mm_cvtps_epi32(b));
    const __m128i high = _mm_packs_epi32(_mm_cvtps_epi32(c), _mm_cvtps_epi32(d));
    const __m128i first = _mm_srai_epi16(_mm_adds_epi16(low, _mm_loadu_si128(from)), 6);
    const __m128i second = _mm_srai_epi16(_mm_adds_epi16(high, _mm_loadu_si128(from + 1)), 6);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_packus_epi16(first, second));
  }

  static void store_one(Rgba8* out, const LivePixel* g, __m128 u) {
    const __m128i low = _mm_packs_epi32(_mm_cvtps_epi32(u), _mm_setzero_si128());
    const __m128i sum = _mm_adds_epi16(low, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(g)));
    const __m128i levels = _mm_packus_epi16(_mm_srai_epi16(sum, 6), _mm_setzero_si128());
    _mm_storeu_si32(out, levels);
  }

  static void pack(LivePixel* to, __m128 units) {
    const __m128 inside = _mm_min_ps(_mm_max_ps(units, _mm_set1_ps(-32768)), _mm_set1_ps(32767));
    const __m128i whole = _mm_cvtps_epi32(inside);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packs_epi32(whole, whole));
  }

  static void pixels(Rgba8* out, const LivePixel* g, const Float4* u, int count, int) {
    int i = 0;
    for (; i + 4 <= count; i += 4)
      store(out + i, g + i, u[i].v, u[i + 1].v, u[i + 2].v, u[i + 3].v);
    for (; i < count; ++i)
      store_one(out + i, g + i, u[i].v);
  }

  /// A slot's colour in units, without what follows it.
  static __m128 colour(const float* slot) {
    const __m128 colours = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
    return _mm_and_ps(_mm_loadu_ps(slot), colours) * LivePixel::kOpaque;
  }

  static void slots(Rgba8* out, const LivePixel* g, GridSlots<const float> u, int count) {
    int i = 0;
    for (; i + 4 <= count; i += 4, u = u.from(4)) {
      read_ahead(u.even);
      read_ahead(u.odd);
      store(out + i, g + i, colour(u.even), colour(u.odd), colour(u.even + 3), colour(u.odd + 3));
    }
    for (; i < count; ++i, u = u.from(1))
      store_one(out + i, g + i, colour(u.even));
  }

  static void ramp(Rgba8* out, const LivePixel* g, const Float4& first, const Float4& step, int count, int room) {
    const __m128 two = step.v + step.v, four = two + two;
    __m128 a = first.v, b = first.v + step.v, c = first.v + two, d = b + two;
    int i = 0;
    for (; i < count && i + 4 <= room; i += 4, a += four, b += four, c += four, d += four)
      store(out + i, g + i, a, b, c, d);
    for (; i < count; ++i, a = b, b = c, c = d)
      store_one(out + i, g + i, a);
  }
};

struct AvxPainter {
  [[gnu::target("avx2")]] static void store(Rgba8* out, const LivePixel* g, __m256i levels) {
    const __m256i from = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(g));
    const __m256i sum = _mm256_srai_epi16(_mm256_adds_epi16(levels, from), 6);
    const __m256i packed = _mm256_permute4x64_epi64(_mm256_packus_epi16(sum, sum), 0x08);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm256_castsi256_si128(packed));
  }

  [[gnu::target("avx2")]] static void pixels(Rgba8* out, const LivePixel* g, const Float4* u, int count, int) {
    int i = 0;
    for (; i + 4 <= count; i += 4) {
      const auto* at = reinterpret_cast<const float*>(u + i);
      const __m256i ab = _mm256_cvtps_epi32(_mm256_loadu_ps(at)), cd = _mm256_cvtps_epi32(_mm256_loadu_ps(at + 8));
      store(out + i, g + i, _mm256_permute4x64_epi64(_mm256_packs_epi32(ab, cd), 0xD8));
    }
    for (; i < count; ++i)
      SsePainter::store_one(out + i, g + i, u[i].v);
  }

  /// Of a slot and the next, in units.
  [[gnu::target("avx2")]] static __m256i two(const float* slot) {
    return _mm256_cvtps_epi32(_mm256_loadu2_m128(slot + 3, slot) * LivePixel::kOpaque);
  }

  [[gnu::target("avx2")]] static void slots(Rgba8* out, const LivePixel* g, GridSlots<const float> u, int count) {
    const __m256i colours = _mm256_set1_epi64x(0x0000'FFFF'FFFF'FFFF);
    int i = 0;
    for (; i + 4 <= count; i += 4, u = u.from(4)) {
      read_ahead(u.even);
      read_ahead(u.odd);
      // Of each half first the even one, then the odd one: the order of the pixels.
      store(out + i, g + i, _mm256_and_si256(_mm256_packs_epi32(two(u.even), two(u.odd)), colours));
    }
    SsePainter::slots(out + i, g + i, u, count - i);
  }

  [[gnu::target("avx2")]] static void ramp(Rgba8* out, const LivePixel* g, const Float4& first, const Float4& step,
                                           int count, int room) {
    const __m128 two = step.v + step.v, b = first.v + step.v;
    // The lower half of one and of the other, then the upper halves: the order in which they are packed.
    __m256 ac = _mm256_set_m128(first.v + two, first.v), bd = _mm256_set_m128(b + two, b);
    const __m256 four = _mm256_set_m128(two + two, two + two);
    int i = 0;
    for (; i < count && i + 4 <= room; i += 4, ac += four, bd += four)
      store(out + i, g + i, _mm256_packs_epi32(_mm256_cvtps_epi32(ac), _mm256_cvtps_epi32(bd)));
    if (i >= count) return;
    const __m128 rest[] = {_mm256_castps256_ps128(ac), _mm256_castps256_ps128(bd), _mm256_extractf128_ps(ac, 1)};
    for (int k = 0; i < count; ++i, ++k)
      SsePainter::store_one(out + i, g + i, rest[k]);
  }
};

using PlainPainter = SsePainter;

#else

struct PlainPainter {
  static void store_one(Rgba8* out, const LivePixel* g, const Float4& u) {
    const auto level = [](std::int16_t source, float more) {
      const float low = -32768, high = 32767;
      const auto sum = source + static_cast<int>(std::nearbyint(std::clamp(more, low, high)));
      return static_cast<std::uint8_t>(std::clamp(sum >> 6, 0, 255));
    };
    *out = {level(g->r, u[0]), level(g->g, u[1]), level(g->b, u[2]), level(g->a, u[3])};
  }

  static void pack(LivePixel* to, const Float4::Lanes& units) {
    const auto whole = [](float v) {
      return static_cast<std::int16_t>(std::nearbyint(v > -32768 ? std::min(v, 32767.0F) : -32768.0F));
    };
    *to = {whole(units[0]), whole(units[1]), whole(units[2]), whole(units[3])};
  }

  static void pixels(Rgba8* out, const LivePixel* g, const Float4* u, int count, int) {
    for (int i = 0; i < count; ++i)
      store_one(out + i, g + i, u[i]);
  }

  static void slots(Rgba8* out, const LivePixel* g, GridSlots<const float> u, int count) {
    for (int i = 0; i < count; ++i, u = u.from(1)) {
      read_ahead(u.even);
      read_ahead(u.odd);
      store_one(out + i, g + i, {LivePixel::kOpaque * Float4::Lanes{u.even[0], u.even[1], u.even[2], 0}});
    }
  }

  static void ramp(Rgba8* out, const LivePixel* g, const Float4& first, const Float4& step, int count, int) {
    const Float4 two = step + step, four = two + two;
    Float4 lanes[] = {first, first + step, first + two, first + step + two};
    for (int i = 0; i < count; ++i) {
      Float4& lane = lanes[i % 4];
      store_one(out + i, g + i, lane);
      lane += four;
    }
  }
};

#endif

template <class Painter>
[[gnu::always_inline]] inline void paint_row(const RowPainting& painting, const LiveRow& row) {
  const Correction& correction = painting.correction;
  if (correction.pixels) {
    const GridSlots<const float> u = correction.pixels->slots(row.run);
    Painter::slots(row.out, painting.source + row.pixel, u.from(static_cast<std::size_t>(row.skipped)), row.count);
    return;
  }
  int skipped = row.skipped, room = row.count;
  const LivePixel* g = painting.source + row.pixel;
  Rgba8* out = row.out;
  // What is left of a piece between the target's edges.
  const auto clip = [&](int& count) {
    const int cut = std::min(skipped, count);
    skipped -= cut;
    count = std::min(count - cut, room);
    return cut;
  };
  const auto go_on = [&](int count) {
    g += count;
    out += count;
    room -= count;
  };
  correction.membrane->walk(
      correction.values, row.run, row.y,
      [&](const Float4* at, int count) {
        at += clip(count);
        if (count > 0) Painter::pixels(out, g, at, count, room);
        go_on(count);
      },
      [&](const Float4& first, const Float4& step, int count) {
        const int cut = clip(count);
        if (count > 0)
          Painter::ramp(out, g, cut == 0 ? first : first + static_cast<float>(cut) * step, step, count, room);
        go_on(count);
      });
}

} // namespace

bool pack_pixels(const Rgba* from, std::size_t count, LivePixel* to) {
  bool opaque = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Float4 pixel{Float4::Lanes{from[i].r, from[i].g, from[i].b, from[i].a}};
    PlainPainter::pack(to + i, LivePixel::kOpaque * pixel.v + 32);
    opaque &= to[i].is_opaque();
  }
  return opaque;
}

void paint_rows(const RowPainting& painting, std::span<const LiveRow> rows) {
  for (const LiveRow& row : rows)
    paint_row<PlainPainter>(painting, row);
}

#if defined(__x86_64__)

[[gnu::target("avx2")]] void paint_rows_avx2(const RowPainting& painting, std::span<const LiveRow> rows) {
  CHECK(has_avx2(), "a processor with AVX2");
  for (const LiveRow& row : rows)
    paint_row<AvxPainter>(painting, row);
}

#else

void paint_rows_avx2(const RowPainting&, std::span<const LiveRow>) {
  CHECK(has_avx2(), "a processor with AVX2");
}

#endif

} // namespace oversketch
