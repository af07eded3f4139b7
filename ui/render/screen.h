#pragma once

#include "core/image/display.h"
#include "ui/theme/theme.h"

namespace oversketch {

/// The window's own pixels; its OpenGL context is the thread's present one.
void clear_screen(PackedColor color, int width, int height);

/// What has been drawn, the top row first; to be read before it is shown.
Raster<Rgba8> read_screen(int width, int height);

} // namespace oversketch
