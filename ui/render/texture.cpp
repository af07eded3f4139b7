#include "ui/render/texture.h"

#include <epoxy/gl.h>

#include <utility>

namespace oversketch {
namespace {

GLuint make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return name;
}

void allocate(int level, const Raster<Rgba8>& size, const void* pixels) {
  glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, size.width(), size.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

} // namespace

Texture::Texture(const MipLevels& levels) : name_(make_texture()) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, MipLevels::kCount - 1);
  for (int k = 0; k < MipLevels::kCount; ++k)
    allocate(k, levels.level(k), nullptr);
}

Texture::Texture(const Raster<Rgba8>& pixels) : name_(make_texture()) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  allocate(0, pixels, pixels.values().data());
}

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

Texture::Texture(Texture&& other) noexcept : name_(std::exchange(other.name_, 0)) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(name_, other.name_);
  return *this;
}

void Texture::update(const MipLevels& levels, const Rect& rect) {
  glBindTexture(GL_TEXTURE_2D, name_);
  for (int k = 0; k < MipLevels::kCount; ++k) {
    const Raster<Rgba8>& level = levels.level(k);
    const Rect part = shrunk(rect, k);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, level.width());
    glTexSubImage2D(GL_TEXTURE_2D, k, part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    &level.at(part.x, part.y));
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

Samplers::Samplers() {
  glGenSamplers(kSamplings, names_);
  const auto set = [&](Sampling sampling, GLint smaller, GLint larger, GLint beyond) {
    const GLuint sampler = name(sampling);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, smaller);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, larger);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, beyond);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, beyond);
  };
  set(Sampling::kNearest, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  set(Sampling::kLinear, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
  set(Sampling::kTrilinear, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
  set(Sampling::kTiled, GL_NEAREST, GL_NEAREST, GL_REPEAT);
}

Samplers::~Samplers() {
  glDeleteSamplers(kSamplings, names_);
}

void bind_sampler(std::uint32_t name) {
  glBindSampler(0, name);
}

} // namespace oversketch
