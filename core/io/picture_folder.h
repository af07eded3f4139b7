#pragma once

#include "core/base/hash.h"
#include "core/base/result.h"
#include "core/document/command.h"

#include <filesystem>
#include <map>
#include <string>

namespace oversketch {

/// Pictures beside a script, each content once: ROOT/FOLDER/HASH/NAME.png (or .osf, see exact.h).
/// @threads one at a time.
class PictureFolder {
public:
  /// How a file is called: by what it holds now, for other programs; or as the person knows it, "sea.jpg", whatever it
  /// holds, so that a history names what was opened.
  enum class Ending { kOfContent, kOfOriginal };

  PictureFolder(std::filesystem::path root, std::filesystem::path folder, Ending ending = Ending::kOfContent)
      : root_(std::move(root)), folder_(std::move(folder)), ending_(ending) {}

  /// The command with its loaded pictures in the folder, named relative to ROOT; written where they are not there yet.
  /// @errors file.write (a link that leads out of ROOT too), those of encode_exact.
  Result<Command> keep_pictures(Command command);

private:
  Result<std::string> store(const ImageRef& ref);

  std::filesystem::path root_;
  std::filesystem::path folder_;
  Ending ending_;
  std::map<Hash, std::string> stored_;
};

/// Names a picture by its file alone, without the folders of this machine; "@target" stays.
std::string portable_name(const std::string& name);

/// The text in UTF-8 without control characters and what XML does not allow: what is neither is replaced.
std::string clean_text(const std::string& text);

} // namespace oversketch
