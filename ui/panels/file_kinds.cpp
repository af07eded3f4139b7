#include "ui/panels/file_kinds.h"

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/image/resample.h"
#include "core/io/project.h"
#include "ui/panels/file_listing.h"
#include "ui/state/file_jobs.h"

#include <algorithm>
#include <cmath>
#include <system_error>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using For = FileRequest::For;

constexpr int kPreview_px = 320;
constexpr std::uintmax_t kMostPreviewBytes = 64'000'000;

} // namespace

FilePreview read_preview(const fs::path& path) {
  FilePreview preview{path, nullptr, {}};
  std::error_code error;
  const bool project = kind_of_file(path) == FileKind::kProject;
  if (!is_picture(path) && !project) return preview;
  if (fs::file_size(path, error) > kMostPreviewBytes || error) return preview;
  const auto image = project ? load_project_picture(path) : load_image(path);
  if (!image) {
    preview.text = image.error().sentence;
    return preview;
  }
  preview.text = std::to_string(image->width()) + " × " + std::to_string(image->height()) + " px";
  const double scale = std::min(1.0, static_cast<double>(kPreview_px) / std::max(image->width(), image->height()));
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  preview.picture = std::make_shared<const Raster<Rgba8>>(
      to_display(downscaled(*image, side(image->width()), side(image->height()))));
  return preview;
}

fs::path with_saved_ending(const fs::path& path, For purpose, ExportFormat format) {
  if (path.has_extension()) return path;
  fs::path out = path;
  out += purpose == For::kSaveAs ? kProjectEnding : format == ExportFormat::kJpeg ? ".jpg" : ".png";
  return out;
}

ExportFormat format_of(const fs::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".jpg" || ending == ".jpeg" ? ExportFormat::kJpeg : ExportFormat::kPng;
}

} // namespace oversketch
