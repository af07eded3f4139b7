#include "core/io/picture_folder.h"

#include "core/base/file.h"
#include "core/base/text.h"
#include "core/image/exact.h"
#include "core/image/image_io.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

/// As long as it can be with what is put beside it while it is written.
constexpr std::size_t kLongestName = 200;

/// A file's name that any file system takes, its ending kept.
fs::path fitting(const fs::path& name) {
  std::string ending = name.extension().string(), stem = name.stem().string();
  if (ending.size() > kLongestName / 2) stem += std::exchange(ending, "");
  if (stem.size() + ending.size() <= kLongestName) return name;
  return std::string(head_of(stem, kLongestName - ending.size())) + ending;
}

/// Whether that picture can be read from the file; damage would go unseen otherwise.
bool holds(const fs::path& path, const Image& image) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) return false;
  const auto bytes = read_file(path);
  if (!bytes) return false;
  const auto there = decode_image(*bytes);
  return there.ok() && *there == image;
}

} // namespace

std::string clean_text(const std::string& text) {
  using Json = nlohmann::json;
  // Printing replaces what is no UTF-8.
  std::string clean = Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
  for (char& c : clean)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  // U+FFFE and U+FFFF, which XML does not allow.
  for (const char* none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = 0; (at = clean.find(none, at)) != std::string::npos;)
      clean.replace(at, 3, " ");
  return clean;
}

std::string portable_name(const std::string& name) {
  if (name == kTargetName) return name;
  std::string file = clean_text(fs::path(name).filename().string());
  return file == kTargetName ? "./" + file : file;
}

Result<std::string> PictureFolder::store(const ImageRef& ref) {
  const Hash hash = ref.image->content_hash();
  if (const auto known = stored_.find(hash); known != stored_.end()) return known->second;
  const fs::path inside = folder_ / to_string(hash);
  std::error_code failure;
  if (!lies_below(root_, root_ / inside) || !lies_below(root_, root_ / folder_))
    return Error{"file.write", "a link leads out of the session's folder", (root_ / inside).string()};
  fs::create_directories(root_ / inside, failure);
  if (failure) return Error{"file.write", "the folder cannot be made: " + failure.message(), (root_ / inside).string()};
  const fs::path original = fitting(portable_name(ref.name));
  const bool as_opened = form_ == Form::kAsOpened && !ref.image->file().empty();
  const bool keeps_ending = as_opened || (form_ == Form::kAsOpened && original.has_extension());
  const auto named = [&](std::string_view extension) {
    return inside / (keeps_ending ? original.filename().string() : original.stem().string() + std::string(extension));
  };
  for (const char* extension : {".png", ".osf"}) {
    if (holds(root_ / named(extension), *ref.image)) return stored_[hash] = named(extension).generic_string();
    if (keeps_ending) break;
  }
  ExactPicture packed;
  if (!as_opened) {
    auto done = encode_exact(*ref.image);
    if (!done) return at(ref.name, done.error());
    packed = std::move(*done);
  }
  const fs::path relative = named(packed.extension);
  if (!lies_below(root_, root_ / relative))
    return Error{"file.write", "a link leads out of the session's folder", (root_ / relative).string()};
  const std::span<const std::byte> bytes = as_opened ? ref.image->file() : std::span<const std::byte>(packed.bytes);
  if (auto saved = write_file(root_ / relative, bytes); !saved) return saved.error();
  return stored_[hash] = relative.generic_string();
}

Result<Command> PictureFolder::keep_pictures(Command command) {
  if (auto* add = std::get_if<LayerAdd>(&command); add && !add->name && add->source.name != kTargetName)
    add->name = clean_text(fs::path(add->source.name).stem().string());
  for (ImageRef* ref : images_of(command)) {
    if (!ref->image) continue;
    auto name = store(*ref);
    if (!name) return name.error();
    ref->name = *name;
  }
  return command;
}

} // namespace oversketch
