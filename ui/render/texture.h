#pragma once

#include "ui/render/mip_levels.h"

#include <cstdint>

namespace oversketch {

/// A picture on the graphics hardware; needs the window's OpenGL context for all its life.
class Texture {
public:
  Texture() = default;
  /// With room for all levels of `levels` and nothing in it.
  explicit Texture(const MipLevels& levels);
  /// A small picture without mip maps: to be drawn at half its size or larger.  (Mip maps made by the hardware cost a
  /// frame of 70 ms where it is a software rasteriser, which compiles a program for them.)
  explicit Texture(const Raster<Rgba8>& pixels);
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;

  bool empty() const { return name_ == 0; }
  std::uint32_t name() const { return name_; }
  /// Takes over what depends on `rect` of level 0.
  void update(const MipLevels& levels, const Rect& rect);

private:
  std::uint32_t name_ = 0;
};

/// How a texture is read between its pixels.
enum class Sampling {
  /// Hard pixels.
  kNearest,
  kLinear,
  /// Between the pixels, and between the mip maps.
  kTrilinear,
  /// Hard pixels, again and again.
  kTiled,
};
inline constexpr int kSamplings = 4;

/// The hardware's samplers.
class Samplers {
public:
  Samplers();
  ~Samplers();
  Samplers(const Samplers&) = delete;
  Samplers& operator=(const Samplers&) = delete;

  std::uint32_t name(Sampling sampling) const { return names_[static_cast<int>(sampling)]; }

private:
  std::uint32_t names_[kSamplings] = {};
};

/// From now on textures are read so; 0: as each texture itself says.
void bind_sampler(std::uint32_t name);

} // namespace oversketch
