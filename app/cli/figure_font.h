#pragma once

#include "core/base/result.h"
#include "core/geometry/point.h"

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace oversketch::cli {

/// The shapes of a typeface's letters.  Immutable; copies share everything.
/// @threads safe to read from several threads.
class Font {
public:
  /// Reads an OpenType or TrueType font.
  /// @errors font.unreadable, file.*; `where` is the path.
  static Result<Font> load(const std::filesystem::path& path);

  /// How far a line of text runs, px, letters kerned by pairs.
  /// @param text  UTF-8; what is none, and what the font does not have, shows as the font's mark for that.
  /// @param size  px from one line to the next, as designers count: the em.
  double width(std::string_view text, double size) const;

  /// Outlines to be filled by the nonzero-winding rule; curves are cut into straight pieces within about 1/20 px.
  /// @param start  of the baseline, px.
  std::vector<Points> outlines(std::string_view text, double size, Point start) const;

private:
  struct Data;
  explicit Font(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

} // namespace oversketch::cli
