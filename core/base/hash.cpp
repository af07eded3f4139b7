#include "core/base/hash.h"

#include "core/base/check.h"

#include <xxhash.h>

namespace oversketch {

struct Hasher::State {
  XXH3_state_t* stream = XXH3_createState();
  State() {
    CHECK(stream != nullptr, "out of memory for a hash");
    XXH3_128bits_reset(stream);
  }
  ~State() { XXH3_freeState(stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

std::string to_string(const Hash& hash) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(32, '0');
  for (int i = 0; i < 16; ++i) {
    text[static_cast<std::size_t>(i)] = digits[(hash.high >> (60 - 4 * i)) & 15];
    text[static_cast<std::size_t>(16 + i)] = digits[(hash.low >> (60 - 4 * i)) & 15];
  }
  return text;
}

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

Hasher& Hasher::add_bytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_->stream, data, size);
  return *this;
}

Hasher& Hasher::add(std::string_view text) {
  add(text.size());
  return add_bytes(text.data(), text.size());
}

Hasher& Hasher::add(const Hash& hash) {
  return add(hash.low).add(hash.high);
}

Hash Hasher::finish() const {
  const XXH128_hash_t digest = XXH3_128bits_digest(state_->stream);
  return {digest.low64, digest.high64};
}

} // namespace oversketch
