#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/io/limits.h"
#include "core/session/script.h"
#include "core/session/session.h"

#include <filesystem>
#include <vector>

namespace oversketch {

/// Where a script reads and writes, and how much what it opens may ask for.
struct ScriptFolders {
  /// Pictures are named relative to it.
  std::filesystem::path script;
  /// Everything that is written lies below it.
  std::filesystem::path out;
  IoLimits limits{};
};

struct RunSummary {
  int steps = 0;
  /// In the order in which they were written.
  std::vector<std::filesystem::path> written;
};

/// Runs the steps one after the other and stops at the first that fails, with "name:line" as the place.
///
/// @param lines  as parse_script gives them; `name` is the script's, for errors.
/// @errors those of the commands, of reading and writing files, and
///   script.path (an output path that is absolute, has "..", or leads out of the output folder), script.depth,
///   expect.failed, open.not-a-session, save.unknown-kind; the session stays as the last good step left it.
Result<RunSummary> run_script(Session& session, const std::vector<ScriptLine>& lines, const std::string& name,
                              const ScriptFolders& folders, const Watch& watch);

/// Reads, parses and runs a script file.
Result<RunSummary> run_script_file(Session& session, const std::filesystem::path& script,
                                   const std::filesystem::path& out, const Watch& watch, const IoLimits& limits = {});

} // namespace oversketch
