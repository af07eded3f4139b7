#pragma once

#include "core/base/result.h"

#include <filesystem>

namespace oversketch {

/// The folder `assets` of the program that is running: beside the program or in a folder above it, the nearest one.
/// Follows links to the program.  A build outside the project's folder has a link to it.
/// @errors assets.missing; `where` is the program.
/// @threads safe.
[[nodiscard]] Result<std::filesystem::path> find_assets();

/// The same for a program at `program` (an absolute path).
[[nodiscard]] Result<std::filesystem::path> find_assets_of(const std::filesystem::path& program);

} // namespace oversketch
