#pragma once

#include "core/base/result.h"
#include "core/deform/deformation.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace oversketch {

/// One pair of curves to try a method on, without pictures.
struct DeformCase {
  std::string name;
  Points outline;
  Points sketch;
  /// Where each outline point belongs; empty when that is not known.
  Points truth;
  std::vector<PinPair> pins;
};

/// Reads {"name", "outline", "sketch", "truth"?, "pins"?}.  The outline must be simple, the sketch as clean_sketch()
/// takes it; coordinates may be negative.
/// @errors case.syntax, case.missing-key, case.type, case.truth (another number of points than the outline), those of
///   check_closed_curve, file.*; `where` begins with the path.
Result<DeformCase> read_case(const std::filesystem::path& path);

/// Reads a list of points [[x, y], …], or an object with such a list under one of `keys`.
Result<Points> read_points(const std::filesystem::path& path, const std::vector<std::string>& keys);

struct DeformedCase {
  Deformation deformation;
  Metrics metrics;
};

/// Solves one case from nothing.
Result<DeformedCase> solve_case(const DeformCase& given, const DeformOptions& options, const Watch& watch);

/// The contract's RESULT.json.
nlohmann::ordered_json result_json(const DeformedCase& solved);

} // namespace oversketch
