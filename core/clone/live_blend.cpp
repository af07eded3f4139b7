#include "core/clone/live_blend.h"

#include <algorithm>

namespace oversketch {
namespace {

Float4 lanes(float r, float g, float b, float a) {
  return {Float4::Lanes{r, g, b, a}};
}

std::uint8_t to_level(float value) {
  return static_cast<std::uint8_t>(std::clamp(255 * value, 0.0F, 255.0F) + 0.5F);
}

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
    const float alpha = static_cast<float>(g.a - 32) / LivePixel::kOpaque;
    const float w = alpha * opacity_ * (pastes_ ? inside : 1);
    if (w <= 0) return below;
    const Float4 colour = pastes_ ? encoded(g) : blended(g, below, u, inside);
    if (w >= 1) return {to_level(colour[0]), to_level(colour[1]), to_level(colour[2]), 255};
    return over(colour, w, below);
  }

private:
  static Float4 encoded(const LivePixel& g) {
    constexpr float kUnit = 1 / LivePixel::kOpaque;
    return kUnit * lanes(static_cast<float>(g.r - 32), static_cast<float>(g.g - 32), static_cast<float>(g.b - 32), 0);
  }
  static Float4 encoded(const Rgba8& p) {
    constexpr float kUnit = 1.0F / 255;
    return kUnit * lanes(p.r, p.g, p.b, 0);
  }

  Float4 to_domain(const LivePixel& g) const {
    if (tables_ == nullptr) return encoded(g);
    return lanes(tables_->to_domain(g.r), tables_->to_domain(g.g), tables_->to_domain(g.b), 0);
  }
  Float4 to_domain(const Rgba8& p) const {
    if (tables_ == nullptr) return encoded(p);
    const auto value = [this](std::uint8_t level) {
      return tables_->to_domain(static_cast<std::int16_t>(64 * level + 32));
    };
    return lanes(value(p.r), value(p.g), value(p.b), 0);
  }
  Float4 from_domain(const Float4& f) const {
    if (tables_ == nullptr) return f;
    return lanes(tables_->from_domain(f[0]), tables_->from_domain(f[1]), tables_->from_domain(f[2]), 0);
  }

  Float4 blended(const LivePixel& g, const Rgba8& below, const Float4& u, float inside) const {
    Float4 values = to_domain(g);
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
    const float under = (1 - w) * static_cast<float>(below.a) / 255, alpha = w + under;
    const Float4 mixed = (w / alpha) * colour + (under / alpha) * encoded(below);
    return {to_level(mixed[0]), to_level(mixed[1]), to_level(mixed[2]), to_level(alpha)};
  }

  const BlendOptions& options_;
  const DomainTables* tables_;
  bool pastes_;
  float opacity_, strength_, average_;
};

/// u of a whole run.
void read_run(const BlendPainting& painting, const LiveRow& row, std::vector<Float4>& u) {
  u.clear();
  if (painting.membrane != nullptr) {
    painting.membrane->walk(
        *painting.values, row.run, row.y, [&](const Float4* at, int count) { u.insert(u.end(), at, at + count); },
        [&](Float4 value, const Float4& step, int count) {
          for (int i = 0; i < count; ++i, value += step)
            u.push_back(value);
        });
    return;
  }
  u.resize(static_cast<std::size_t>(row.skipped + row.count));
  if (painting.correction.empty()) return;
  const std::size_t first = row.pixel - static_cast<std::size_t>(row.skipped);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Channels& c = painting.correction[first + i];
    u[i] = lanes(static_cast<float>(c.v[0]), static_cast<float>(c.v[1]), static_cast<float>(c.v[2]), 0);
  }
}

} // namespace

void paint_blended(const BlendPainting& painting, std::span<const LiveRow> rows) {
  const Blender blender(painting);
  const auto per_px = static_cast<float>(1 / (painting.options.feather_px + 1));
  std::vector<Float4> u;
  for (const LiveRow& row : rows) {
    read_run(painting, row, u);
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
