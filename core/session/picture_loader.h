#pragma once

#include "core/base/result.h"
#include "core/document/command.h"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

namespace oversketch {

/// Reads the pictures that commands name, each file once, and counts the memory that they take.
class PictureLoader {
public:
  /// @param folder        that names are relative to.
  /// @param memory_bytes  for all pictures together: 16 bytes a pixel, and their files' own.
  explicit PictureLoader(std::filesystem::path folder,
                         std::size_t memory_bytes = std::numeric_limits<std::size_t>::max())
      : folder_(std::move(folder)), memory_left_(memory_bytes) {}

  /// Fills in what the command still lacks; an empty canvas that it asks for is counted, too.
  /// @errors those of load_image; image.too-large.
  Result<void> load_into(Command& command);

private:
  Result<void> count_canvas(const Command& command);

  std::filesystem::path folder_;
  std::size_t memory_left_;
  std::map<std::string, Image> loaded_;
};

} // namespace oversketch
