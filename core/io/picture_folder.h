#pragma once

#include "core/base/hash.h"
#include "core/base/result.h"
#include "core/document/command.h"

#include <filesystem>
#include <map>
#include <string>

namespace oversketch {

/// Pictures beside a script, each content once: ROOT/FOLDER/HASH/NAME.
/// @threads one at a time.
class PictureFolder {
public:
  /// Packed to the bit, .png or .osf (exact.h), which takes a second for 54 megapixels; or the file that the picture
  /// was read from, byte for byte and under its own name, which takes as long as the disk.  One that was read from no
  /// file is packed, and has the name that the person knows all the same.
  enum class Form { kPacked, kAsOpened };

  PictureFolder(std::filesystem::path root, std::filesystem::path folder, Form form = Form::kPacked)
      : root_(std::move(root)), folder_(std::move(folder)), form_(form) {}

  /// The command with its loaded pictures in the folder, named relative to ROOT; written where they are not there yet.
  /// @errors file.write (a link that leads out of ROOT too), those of encode_exact.
  Result<Command> keep_pictures(Command command);

private:
  Result<std::string> store(const ImageRef& ref);

  std::filesystem::path root_;
  std::filesystem::path folder_;
  Form form_;
  std::map<Hash, std::string> stored_;
};

/// Names a picture by its file alone, without the folders of this machine; "@target" stays.
std::string portable_name(const std::string& name);

/// The text in UTF-8 without control characters and what XML does not allow: what is neither is replaced.
std::string clean_text(const std::string& text);

} // namespace oversketch
