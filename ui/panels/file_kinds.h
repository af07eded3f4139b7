#pragma once

#include "core/image/display.h"
#include "ui/state/editor_state.h"

#include <filesystem>
#include <memory>
#include <string>

namespace oversketch {

/// What is seen of a picture before it is opened.
struct FilePreview {
  std::filesystem::path path;
  std::shared_ptr<const Raster<Rgba8>> picture;
  /// "1440 × 1080", or why there is nothing to see.
  std::string text;
};
/// Reads a picture and makes it small; files above 64 MB are not read for that.  For a worker.
FilePreview read_preview(const std::filesystem::path& path);

enum class ExportFormat { kPng, kPng16, kJpeg };
/// Of the name's ending; PNG where it has none.
ExportFormat format_of(const std::filesystem::path& path);

/// The path with the ending that belongs to the request when it has none.
std::filesystem::path with_saved_ending(const std::filesystem::path& path, FileRequest::For purpose,
                                        ExportFormat format);

} // namespace oversketch
