#pragma once

#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/io/limits.h"
#include "core/session/session.h"

#include <filesystem>
#include <string>

namespace oversketch {

// What the editor does with files, as work on a session: run on its worker, never on the window's thread.

/// Of a project's name.
inline constexpr const char* kProjectEnding = ".ora";

enum class FileKind { kProject, kScript, kPicture };
/// By the name's ending: .ora, .jsonl, anything else.
FileKind kind_of_file(const std::filesystem::path& path);

/// What is to be known of a file that was opened.
struct OpenedFile {
  /// Cannot be saved over it.
  bool read_only = false;
  /// For the person; may be empty.
  std::string message;
};

/// Makes the session what the file holds: a project, a script's commands (what it saves, exports and expects is left
/// out: a window's document is no batch run), or a new document with the picture.
/// @errors those of the readers and of the commands, with the file and line; the session stays as it was.
Result<OpenedFile> open_file(Session& session, const std::filesystem::path& path, const IoLimits& limits,
                             const Watch& watch);

/// A new document, as DocumentNew has it.
/// @errors image.too-large, those of the command.
Result<void> make_document(Session& session, const DocumentNew& what, const IoLimits& limits, const Watch& watch);

/// Runs a script as the command line does, its output into `out`.
Result<void> run_whole_script(Session& session, const std::filesystem::path& path, const std::filesystem::path& out,
                              const IoLimits& limits, const Watch& watch);

/// A new layer from a picture, or from the target itself ("@target").
/// @errors image.too-large (more than the document's other pictures leave of the memory), those of the readers.
Result<void> add_source(Session& session, const std::filesystem::path& path, const IoLimits& limits,
                        const Watch& watch);
Result<void> set_target(Session& session, const std::filesystem::path& path, const IoLimits& limits,
                        const Watch& watch);

/// Saves the whole session; marks it as saved.
/// @errors save.unknown-extension, those of the writers.
Result<void> save_file(Session& session, const std::filesystem::path& path, const Watch& watch);

/// Writes the session as a script with its pictures beside it; unlike saving, that leaves it as modified as it was.
Result<void> record_session(const Session& session, const std::filesystem::path& path);

/// The finished picture, as PNG or JPEG by the name's ending.
Result<void> export_picture(Session& session, const std::filesystem::path& path, int depth, const Watch& watch);

} // namespace oversketch
