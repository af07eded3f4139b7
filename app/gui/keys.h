#pragma once

#include "ui/canvas/input.h"

namespace oversketch::gui {

/// The editor's name for a key of GLFW's; letters by what the keyboard's layout writes on them.
/// @param scancode  the system's number of the key, for the layout.
Key to_key(int glfw_key, int scancode);

} // namespace oversketch::gui
