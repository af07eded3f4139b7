#pragma once

#include <cstddef>
#include <cstdint>

namespace oversketch {

/// What a file from elsewhere may ask of this machine; THREATS.md says why.  Each is checked before what it bounds is
/// allocated.
struct IoLimits {
  /// Of the archive as it lies on the disk.
  std::uintmax_t file_bytes = 4'000'000'000;
  std::int64_t entries = 10'000;
  std::size_t name_bytes = 512;
  /// Of stack.xml, unpacked, and groups in groups.
  std::size_t xml_bytes = 4 << 20;
  int xml_depth = 32;
  /// Of oversketch/document.json, unpacked, and of values in values.
  std::size_t json_bytes = 256 << 20;
  int json_depth = 16;
  /// Memory for all pictures that are open at once, 16 bytes a pixel and the files they were read from, and for a part
  /// while it is unpacked.
  std::size_t memory_bytes = std::size_t{8} << 30;
};

} // namespace oversketch
