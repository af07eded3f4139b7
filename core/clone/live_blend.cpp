#include "core/clone/live_blend.h"

#include <algorithm>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace oversketch {
namespace {

Float4 lanes(float r, float g, float b, float a) {
  return {Float4::Lanes{r, g, b, a}};
}

// Between pixels and encoded values, alpha last; values are rounded and clamped.
#if defined(__SSE2__)

Float4 unpack(const LivePixel& pixel) {
  const __m128i packed = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&pixel));
  const __m128i wide = _mm_srai_epi32(_mm_unpacklo_epi16(packed, packed), 16);
  return {(_mm_cvtepi32_ps(wide) - 32) * (1 / LivePixel::kOpaque)};
}

Float4 unpack(const Rgba8& pixel) {
  const __m128i packed = _mm_loadu_si32(&pixel), zero = _mm_setzero_si128();
  const __m128i wide = _mm_unpacklo_epi16(_mm_unpacklo_epi8(packed, zero), zero);
  return {_mm_cvtepi32_ps(wide) * (1 / 255.0F)};
}

Rgba8 to_levels(const Float4& colour) {
  // Far above the largest level the conversion to whole numbers would not be defined.
  const __m128 levels = _mm_min_ps(255 * colour.v, _mm_set1_ps(1000));
  const __m128i whole = _mm_cvtps_epi32(levels), half = _mm_packs_epi32(whole, whole);
  Rgba8 out;
  _mm_storeu_si32(&out, _mm_packus_epi16(half, half));
  return out;
}

#else

Float4 unpack(const LivePixel& pixel) {
  const auto value = [](std::int16_t v) { return static_cast<float>(v - 32) / LivePixel::kOpaque; };
  return lanes(value(pixel.r), value(pixel.g), value(pixel.b), value(pixel.a));
}

Float4 unpack(const Rgba8& pixel) {
  return (1 / 255.0F) * lanes(pixel.r, pixel.g, pixel.b, pixel.a);
}

Rgba8 to_levels(const Float4& colour) {
  const auto level = [&](std::size_t k) {
    return static_cast<std::uint8_t>(std::clamp(255 * colour[k], 0.0F, 255.0F) + 0.5F);
  };
  return {level(0), level(1), level(2), level(3)};
}

#endif

class Blender {
public:
  explicit Blender(const BlendPainting& painting)
      : options_(painting.options),
        tables_(painting.tables),
        pastes_(painting.options.mode == BlendMode::kNone),
        opacity_(static_cast<float>(painting.options.opacity)),
        strength_(static_cast<float>(painting.options.strength)),
        average_(static_cast<float>(painting.options.average)) {}

  Rgba8 operator()(const LivePixel& g, const Rgba8& below, const Float4& u, float inside) const {
    const Float4 source = unpack(g);
    const float w = source[3] * opacity_ * (pastes_ ? inside : 1);
    if (w <= 0) return below;
    const Float4 colour = pastes_ ? source : blended(g, source, below, u, inside);
    if (w < 1) return over(colour, w, below);
    Rgba8 out = to_levels(colour);
    out.a = 255;
    return out;
  }

private:
  Float4 to_domain(const LivePixel& g, const Float4& encoded) const {
    if (tables_ == nullptr) return encoded;
    return lanes(tables_->to_domain(g.r), tables_->to_domain(g.g), tables_->to_domain(g.b), 0);
  }
  Float4 to_domain(const Rgba8& p) const {
    if (tables_ == nullptr) return unpack(p);
    const auto value = [this](std::uint8_t level) {
      return tables_->to_domain(static_cast<std::int16_t>(64 * level + 32));
    };
    return lanes(value(p.r), value(p.g), value(p.b), 0);
  }
  Float4 from_domain(const Float4& f) const {
    if (tables_ == nullptr) return f;
    return lanes(tables_->from_domain(f[0]), tables_->from_domain(f[1]), tables_->from_domain(f[2]), 0);
  }

  Float4 blended(const LivePixel& g, const Float4& source, const Rgba8& below, const Float4& u, float inside) const {
    Float4 values = to_domain(g, source);
    if (options_.mode == BlendMode::kMonochrome) {
      const float grey = 0.2126F * values[0] + 0.7152F * values[1] + 0.0722F * values[2];
      values = lanes(grey, grey, grey, 0);
    }
    values += (1 - (1 - strength_) * inside) * u;
    if (options_.mode == BlendMode::kAverage) {
      const Float4 under = to_domain(below);
      values = under + average_ * (values - under);
    }
    return from_domain(values);
  }

  static Rgba8 over(const Float4& colour, float w, const Rgba8& below) {
    const Float4 there = unpack(below);
    Rgba8 out;
    if (below.a == 255) {
      out = to_levels(there + w * (colour - there));
      out.a = 255;
      return out;
    }
    const float under = (1 - w) * there[3], alpha = w + under;
    out = to_levels((1 / alpha) * (w * colour + under * there));
    out.a = to_levels({Float4::Lanes{alpha, 0, 0, 0}}).r;
    return out;
  }

  const BlendOptions& options_;
  const DomainTables* tables_;
  bool pastes_;
  float opacity_, strength_, average_;
};

} // namespace

void paint_blended(const BlendPainting& painting, std::span<const LiveRow> rows) {
  const Blender blender(painting);
  const auto per_px = static_cast<float>(1 / (painting.options.feather_px + 1));
  const std::vector<Mask::Run>& runs = painting.region.system.mask().runs();
  std::vector<Float4> u;
  for (const LiveRow& row : rows) {
    painting.correction.read(row.run, runs[row.run], u);
    const Float4* const correction = u.data() + row.skipped;
    const LivePixel* const source = painting.region.pixels.data() + row.pixel;
    for (int i = 0; i < row.count; ++i) {
      float inside = 1;
      if (painting.depths != nullptr) {
        const float t = std::min(1.0F, (*painting.depths)[row.pixel + static_cast<std::size_t>(i)] * per_px);
        inside = t * t * (3 - 2 * t);
      }
      row.out[i] = blender(source[i], row.below[i], correction[i], inside);
    }
  }
}

} // namespace oversketch
