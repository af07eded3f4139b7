#include "core/io/archive.h"

#include "core/base/file.h"

#include <zip.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

struct ErrorText {
  zip_error_t error;
  ErrorText() { zip_error_init(&error); }
  ~ErrorText() { zip_error_fini(&error); }
  ErrorText(const ErrorText&) = delete;
  ErrorText& operator=(const ErrorText&) = delete;
  std::string sentence() { return zip_error_strerror(&error); }
};

using Zip = std::unique_ptr<zip_t, void (*)(zip_t*)>;
using ZipFile = std::unique_ptr<zip_file_t, int (*)(zip_file_t*)>;

/// Why no part may be called so, or "".
std::string find_fault(std::string_view name, const IoLimits& limits) {
  if (name.empty()) return "has no name";
  if (name.size() > limits.name_bytes) return "has a name of more than " + std::to_string(limits.name_bytes) + " bytes";
  if (name.front() == '/') return "has an absolute name";
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':' || c == 0x7f)
      return "has a name with a backslash, a colon or a control character";
  // Folders have entries of their own: "data/".
  const fs::path path(name.back() == '/' ? name.substr(0, name.size() - 1) : name);
  for (const fs::path& piece : path)
    if (piece == ".." || piece == ".") return "has a name that leads elsewhere";
  if (name.find("//") != std::string_view::npos) return "has a name with an empty folder";
  return "";
}

bool is_link(zip_t* zip, zip_uint64_t index) {
  constexpr unsigned kKind = 0170000, kLink = 0120000;
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_file_get_external_attributes(zip, index, 0, &system, &attributes) != 0) return false;
  return system == ZIP_OPSYS_UNIX && (attributes >> 16 & kKind) == kLink;
}

} // namespace

struct Archive::Data {
  fs::path path;
  IoLimits limits;
  /// What the zip is read from.
  std::vector<std::byte> bytes;
  Zip zip{nullptr, zip_discard};

  Error error(const std::string& part, const char* code, std::string sentence) const {
    return {code, std::move(sentence), part.empty() ? path.string() : path.string() + ": " + part};
  }
  Error damaged(const std::string& part, const std::string& why) const {
    return error(part, "project.damaged", "this part of the file is damaged: " + why);
  }

  Result<void> check_entries() const {
    const zip_int64_t count = zip_get_num_entries(zip.get(), 0);
    if (count > limits.entries)
      return error("", "project.too-large", "the archive has more than " + std::to_string(limits.entries) + " parts");
    std::set<std::string_view> names;
    for (zip_int64_t i = 0; i < count; ++i) {
      const auto index = static_cast<zip_uint64_t>(i);
      const char* raw = zip_get_name(zip.get(), index, ZIP_FL_ENC_RAW);
      const std::string_view name = raw == nullptr ? "" : raw;
      const std::string number = "part number " + std::to_string(i + 1);
      if (const std::string fault = find_fault(name, limits); !fault.empty())
        return error(number, "project.bad-name", "a part of the archive " + fault);
      if (!names.insert(name).second)
        return error(std::string(name), "project.bad-name", "the archive has this part twice");
      if (is_link(zip.get(), index))
        return error(std::string(name), "project.bad-name", "a part of the archive is a link");
    }
    return {};
  }

  /// The part opened, and what the directory says of it.
  Result<ZipFile> open_part(const std::string& name, zip_stat_t& stat) const {
    zip_stat_init(&stat);
    const zip_int64_t index = zip_name_locate(zip.get(), name.c_str(), ZIP_FL_ENC_RAW);
    if (index < 0) return error(name, "project.missing-part", "the file lacks this part");
    if (zip_stat_index(zip.get(), static_cast<zip_uint64_t>(index), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) ||
        !(stat.valid & ZIP_STAT_COMP_SIZE))
      return damaged(name, "its size is not told");
    if (stat.encryption_method != ZIP_EM_NONE)
      return error(name, "project.encrypted", "this part of the file is encrypted, which is not read");
    ZipFile file(zip_fopen_index(zip.get(), static_cast<zip_uint64_t>(index), 0), zip_fclose);
    if (!file) return damaged(name, zip_strerror(zip.get()));
    return file;
  }
};

Archive::Archive(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Archive::~Archive() = default;
Archive::Archive(Archive&&) noexcept = default;
Archive& Archive::operator=(Archive&&) noexcept = default;

Result<Archive> Archive::open(const fs::path& path, const IoLimits& limits) {
  std::error_code ignored;
  const auto kind = fs::status(path, ignored).type();
  if (kind != fs::file_type::regular && kind != fs::file_type::not_found && kind != fs::file_type::directory)
    return Error{"file.unreadable", "the file cannot be read: it is no regular file", path.string()};
  auto bytes = read_file(path, std::min<std::uintmax_t>(limits.file_bytes, limits.memory_bytes));
  if (!bytes) return bytes.error();
  auto data = std::make_unique<Data>();
  data->path = path;
  data->limits = limits;
  data->bytes = std::move(*bytes);
  const Error no_archive{"project.not-an-archive", "this is no OpenRaster file", path.string()};
  constexpr std::string_view kSignature = "PK";
  if (data->bytes.size() < 22 || !std::equal(kSignature.begin(), kSignature.end(), data->bytes.begin(),
                                             [](char a, std::byte b) { return a == static_cast<char>(b); }))
    return no_archive;
  ErrorText why;
  zip_source_t* source = zip_source_buffer_create(data->bytes.data(), data->bytes.size(), 0, &why.error);
  if (source == nullptr) return no_archive;
  data->zip.reset(zip_open_from_source(source, ZIP_RDONLY, &why.error));
  if (!data->zip) {
    zip_source_free(source);
    return data->damaged("its directory at the end", why.sentence());
  }
  if (auto good = data->check_entries(); !good) return good.error();
  return Archive(std::move(data));
}

bool Archive::has(const std::string& name) const {
  return zip_name_locate(data_->zip.get(), name.c_str(), ZIP_FL_ENC_RAW) >= 0;
}

const IoLimits& Archive::limits() const {
  return data_->limits;
}

std::string Archive::place(const std::string& name) const {
  return data_->path.string() + ": " + name;
}

Result<std::vector<std::byte>> Archive::read(const std::string& name, std::size_t most_bytes) const {
  zip_stat_t stat;
  auto file = data_->open_part(name, stat);
  if (!file) return file.error();
  const std::uint64_t most = std::min<std::uint64_t>(most_bytes, data_->limits.memory_bytes);
  // No byte of a deflate stream stands for more than 1032 (RFC 1951).
  constexpr std::uint64_t kMostInflation = 1032;
  if (stat.size > most)
    return data_->error(name, "project.too-large",
                        "this part says it has " + std::to_string(stat.size) + " bytes, more than " +
                            std::to_string(most));
  if (stat.size / kMostInflation > stat.comp_size) return data_->damaged(name, "it cannot have the size it tells");
  std::vector<std::byte> bytes(static_cast<std::size_t>(stat.size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const zip_int64_t got = zip_fread(file->get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0) return data_->damaged(name, zip_file_strerror(file->get()));
    if (got == 0) return data_->damaged(name, "it ends too early");
    filled += static_cast<std::size_t>(got);
  }
  // Reading past the end is what tests the checksum.
  std::byte more{};
  const zip_int64_t got = zip_fread(file->get(), &more, 1);
  if (got < 0) return data_->damaged(name, zip_file_strerror(file->get()));
  if (got > 0) return data_->damaged(name, "it is longer than it tells");
  return bytes;
}

Result<std::vector<std::byte>> Archive::read_start(const std::string& name, std::size_t count) const {
  zip_stat_t stat;
  auto file = data_->open_part(name, stat);
  if (!file) return file.error();
  std::vector<std::byte> bytes(count);
  const zip_int64_t got = zip_fread(file->get(), bytes.data(), bytes.size());
  if (got < 0) return data_->damaged(name, zip_file_strerror(file->get()));
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

Result<std::vector<std::byte>> make_archive(std::vector<ArchivePart> parts) {
  ErrorText why;
  const auto failed = [&](const std::string& sentence) {
    return Error{"project.archive", "the file could not be put together: " + sentence, ""};
  };
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &why.error);
  if (target == nullptr) return failed(why.sentence());
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> keep(target, zip_source_free);
  Zip zip(zip_open_from_source(target, ZIP_TRUNCATE, &why.error), zip_discard);
  if (!zip) return failed(why.sentence());
  zip_source_keep(target);
  for (const ArchivePart& part : parts) {
    zip_source_t* source = zip_source_buffer(zip.get(), part.bytes.data(), part.bytes.size(), 0);
    if (source == nullptr) return failed(zip_strerror(zip.get()));
    const zip_int64_t index = zip_file_add(zip.get(), part.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      return failed(zip_strerror(zip.get()));
    }
    const auto at = static_cast<zip_uint64_t>(index);
    // Level 1 of deflate: the texts here pack nearly as well, five times as fast.
    zip_set_file_compression(zip.get(), at, part.packed ? ZIP_CM_STORE : ZIP_CM_DEFLATE, part.packed ? 0 : 1);
    constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;
    zip_file_set_dostime(zip.get(), at, 0, kFirstDay, 0);
  }
  if (zip_close(zip.get()) != 0) return failed(zip_strerror(zip.get()));
  (void)zip.release();
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(target, &stat) != 0 || zip_source_open(target) != 0) return failed("it cannot be read back");
  std::vector<std::byte> bytes(static_cast<std::size_t>(stat.size));
  const zip_int64_t got = zip_source_read(target, bytes.data(), bytes.size());
  zip_source_close(target);
  if (got != static_cast<zip_int64_t>(bytes.size())) return failed("it cannot be read back");
  return bytes;
}

} // namespace oversketch
