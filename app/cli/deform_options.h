#pragma once

#include "app/cli/cli.h"

#include "core/deform/deformation.h"

namespace oversketch::cli {

/// The options that `deform`, `evaluate` and `warp` share; `options` must outlive the parsing.
void add_deform_options(CLI::App* sub, DeformOptions& options);

} // namespace oversketch::cli
