#pragma once

#include <cstddef>
#include <string_view>

namespace oversketch {

/// At most so many bytes from the beginning of UTF-8, no character cut in two.
inline std::string_view head_of(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return text;
  while (most_bytes > 0 && (static_cast<unsigned char>(text[most_bytes]) & 0xC0) == 0x80)
    --most_bytes;
  return text.substr(0, most_bytes);
}

} // namespace oversketch
