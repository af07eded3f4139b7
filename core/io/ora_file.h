#pragma once

#include "core/base/rect.h"
#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/image/image.h"
#include "core/io/limits.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace oversketch {

class Archive;

/// An OpenRaster file as any program sees it: a picture, and the layers it is made of.
///
/// Opening reads the file into memory and looks at the pictures' headers; pixels are decoded when they are asked for.
/// @threads one at a time.
class OraFile {
public:
  struct Layer {
    std::string name;
    /// Where it lies in the whole picture; may hang out.
    Rect rect;
    /// False where a group round it is hidden, too.
    bool visible = true;
    double opacity = 1;
  };

  /// A layer whose picture is not there or cannot be read is left_out(), and no error: the merged picture may be good.
  /// @errors those of Archive::open; project.damaged, project.too-large, project.missing-part, each with the part.
  static Result<OraFile> open(const std::filesystem::path& path, const IoLimits& limits = {});
  ~OraFile();
  OraFile(OraFile&&) noexcept;
  OraFile& operator=(OraFile&&) noexcept;

  int width() const;
  int height() const;
  /// Lowest first; groups taken apart.
  const std::vector<Layer>& layers() const;
  /// What is wrong with each layer that is not among layers().
  const std::vector<Error>& left_out() const;
  /// The pixels of a layer, without its opacity.
  /// @param index  of layers() (CHECK).
  /// @errors project.damaged, project.too-large, those of decode_image.
  Result<Image> load_layer(std::size_t index) const;

  /// The whole picture: mergedimage.png, or where there is none the visible layers over each other.
  /// @errors as load_layer; project.unsupported (no merged picture, and a layer that is not simply laid over).
  Result<Image> load_picture(const Watch& watch = {}) const;

  const Archive& archive() const;

private:
  struct Data;
  explicit OraFile(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

/// The bytes of a picture in an archive: its size is read first, held against `memory_bytes` (16 a pixel), and bounds
/// what is unpacked.
/// @errors project.missing-part, project.damaged, project.too-large; `where` is the path and the part.
Result<std::vector<std::byte>> read_part_picture(const Archive& archive, const std::string& part,
                                                 std::size_t memory_bytes);

} // namespace oversketch
