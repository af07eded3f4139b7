#pragma once

#include "core/base/result.h"
#include "core/document/command.h"

#include <filesystem>
#include <map>
#include <string>

namespace oversketch {

/// Reads the pictures that commands name, each file once.
class PictureLoader {
public:
  /// @param folder  that names are relative to.
  explicit PictureLoader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Fills in what the command still lacks.
  /// @errors those of load_image.
  Result<void> load_into(Command& command);

private:
  std::filesystem::path folder_;
  std::map<std::string, Image> loaded_;
};

} // namespace oversketch
