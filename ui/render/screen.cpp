#include "ui/render/screen.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace oversketch {

void clear_screen(PackedColor color, int width, int height) {
  const auto level = [&](int shift) { return static_cast<float>(color >> shift & 255) / 255.0f; };
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(level(0), level(8), level(16), 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

Raster<Rgba8> read_screen(int width, int height) {
  Raster<Rgba8> upside_down(width, height), picture(width, height);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.values().data());
  for (int y = 0; y < height; ++y) {
    const auto from = upside_down.row(height - 1 - y);
    std::ranges::transform(from, picture.row(y).begin(), [](const Rgba8& p) { return Rgba8{p.r, p.g, p.b, 255}; });
  }
  return picture;
}

} // namespace oversketch
