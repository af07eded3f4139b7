#pragma once

#include "ui/widgets/frame_reply.h"

#include <vector>

namespace oversketch::gui {

/// A square picture of a pointer, its hot spot in the middle; RGBA, 4 bytes a pixel.
struct CursorImage {
  int side = 0;
  std::vector<unsigned char> rgba;
};

/// Pointers that not every system has: arrows in four directions for kMove and kGrab, along a diagonal for the corners;
/// white in a dark rim, to be seen on everything.
CursorImage draw_cursor(CursorShape shape, float scale);

} // namespace oversketch::gui
