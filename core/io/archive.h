#pragma once

#include "core/base/result.h"
#include "core/io/limits.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace oversketch {

/// A zip archive that is read from memory and never unpacked to the disk.
///
/// What its directory says is held against the limits before anything is allocated, and against what is really read.
/// Names that are absolute, have "..", a backslash, a colon or control characters, names that stand there twice, links,
/// and encrypted parts are refused, whether anybody asks for them or not.
/// @threads one at a time.
class Archive {
public:
  /// @errors those of read_file, project.not-an-archive, project.damaged, project.too-large, project.bad-name; `where`
  ///   begins with the path.
  static Result<Archive> open(const std::filesystem::path& path, const IoLimits& limits);
  ~Archive();
  Archive(Archive&&) noexcept;
  Archive& operator=(Archive&&) noexcept;

  bool has(const std::string& name) const;
  /// The whole part, its checksum tested.
  /// @errors project.missing-part, project.damaged, project.too-large (more than `most_bytes`); `where` is the path and
  ///   the part.
  Result<std::vector<std::byte>> read(const std::string& name, std::size_t most_bytes) const;
  /// The first bytes alone, without test; fewer where the part is shorter.
  Result<std::vector<std::byte>> read_start(const std::string& name, std::size_t bytes) const;
  /// What errors call the place: path and part.
  std::string place(const std::string& name) const;
  const IoLimits& limits() const;

private:
  struct Data;
  explicit Archive(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

/// One part of an archive to be.
struct ArchivePart {
  std::string name;
  std::vector<std::byte> bytes;
  /// Pictures are packed already.
  bool packed = false;
};

/// The archive's bytes: the parts in their order, without times, so that equal parts give equal archives.
/// @errors project.archive (no memory).
Result<std::vector<std::byte>> make_archive(std::vector<ArchivePart> parts);

} // namespace oversketch
