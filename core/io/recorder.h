#pragma once

#include "core/base/result.h"
#include "core/io/limits.h"
#include "core/session/session.h"

#include <filesystem>

namespace oversketch {

/// Writes the session's log as a script that replays to the same document and history, and the pictures it needs as PNG
/// files beside it, each content once: FOLDER/NAME.files/HASH/picture.png for FOLDER/NAME.jsonl.
///
/// @errors save.needs-jsonl, save.no-beginning (a session restored from a history that was cut), file.write.
Result<void> save_session(const Session& session, const std::filesystem::path& path);

/// Replaces `session` by the one in the file.  Its counters go on.
/// @errors those of parse_script, open.not-a-session (steps other than commands, undo and redo), and those of the
/// commands;
///   the session stays as it was then.
Result<void> open_session(Session& session, const std::filesystem::path& path, const Watch& watch,
                          const IoLimits& limits = {});

} // namespace oversketch
