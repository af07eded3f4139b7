#pragma once

#include "core/base/result.h"
#include "ui/theme/theme.h"

#include <filesystem>

namespace oversketch {

/// Replaces the fonts of the present Dear ImGui context by those for the look's scale, and enters them into the look:
/// Inter for text (Latin, Greek, Cyrillic), Fork Awesome for icons.  The texture is the caller's: with Dear ImGui
/// before 1.92 it has to be made anew.
///
/// @param assets  the project's folder of that name.
/// @errors fonts.missing, with the file.
/// @cost about 30 ms.
Result<void> load_fonts(ThemeLook& look, const std::filesystem::path& assets);

} // namespace oversketch
