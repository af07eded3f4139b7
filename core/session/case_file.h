#pragma once

#include "core/base/result.h"
#include "core/deform/deformation.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <span>
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
/// takes it; coordinates may be negative.  Keys of other programs are passed over, but not what looks like one of these
/// misspelt.
/// @errors case.syntax, case.missing-key, case.unknown-key, case.type, case.truth (another number of points than the
/// outline), those of
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

/// The same with runners-up of the match, each solved: the best first, `count` ≥ 1 (CHECK) at most.  Symmetric shapes
/// have such, unlike ones too; with pins, and with the paper's methods, there is the best alone.
Result<std::vector<DeformedCase>> solve_case_alternatives(const DeformCase& given, const DeformOptions& options,
                                                          int count, const Watch& watch);

/// The contract's RESULT.json of the first; of the others "alternatives": [{"positions", "correspondence", "metrics",
/// "match_cost"}…].
/// @param solved  at least one (CHECK).
/// @param with_alternatives  whether the key "alternatives" is there, even where there are none.
nlohmann::ordered_json result_json(std::span<const DeformedCase> solved, bool with_alternatives = false);

} // namespace oversketch
