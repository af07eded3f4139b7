#include "core/io/project.h"

#include "core/image/exact.h"
#include "core/io/archive.h"
#include "core/io/jobs.h"
#include "core/io/ora_file.h"
#include "core/io/picture_folder.h"
#include "core/io/project_text.h"

#include <functional>
#include <mutex>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDocument = "oversketch/document.json";

Result<ProjectText> read_text(const Archive& archive) {
  const auto bytes = archive.read(kDocument, archive.limits().json_bytes);
  if (!bytes) return bytes.error();
  auto text = ProjectText::parse({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, archive.limits());
  if (!text) return at(archive.place(kDocument), text.error());
  return text;
}

/// Its size is known before it is decoded.
Result<Image> decode_picture(std::span<const std::byte> bytes, const ProjectText::Picture& wanted) {
  const auto size = read_image_size(bytes);
  if (!size) return size.error();
  if (size->width != wanted.width || size->height != wanted.height)
    return Error{"project.damaged", "this picture has another size than the project says", ""};
  return decode_image(bytes);
}

/// Held against the memory there is before the first is decoded.
Result<void> check_memory(const Archive& archive, const std::vector<ProjectText::Picture>& pictures) {
  double bytes = 0;
  for (const auto& picture : pictures)
    bytes += static_cast<double>(picture.width) * picture.height * sizeof(Rgba);
  if (bytes <= static_cast<double>(archive.limits().memory_bytes)) return {};
  return Error{"project.too-large",
               "its pictures need " + std::to_string(static_cast<std::int64_t>(bytes / (1 << 20))) +
                   " MB of memory, more than the program may take",
               archive.place(kDocument)};
}

Result<std::vector<Image>> load_pictures(const Archive& archive, const std::vector<ProjectText::Picture>& pictures,
                                         int threads, const Watch& watch) {
  if (auto fits = check_memory(archive, pictures); !fits) return fits.error();
  std::vector<Image> images(pictures.size());
  std::vector<std::function<Result<void>()>> jobs;
  std::mutex reading;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    jobs.push_back([&, i]() -> Result<void> {
      const ProjectText::Picture& wanted = pictures[i];
      const auto bytes = [&] {
        const std::lock_guard lock(reading);
        return read_part_picture(archive, wanted.part, archive.limits().memory_bytes);
      }();
      if (!bytes) return bytes.error();
      auto image = decode_picture(*bytes, wanted);
      if (!image) return at(archive.place(wanted.part), image.error());
      if (image->content_hash() != wanted.hash)
        return Error{"project.damaged", "this picture is not the one that was saved", archive.place(wanted.part)};
      images[i] = std::move(*image);
      return {};
    });
  if (auto done = run_jobs(jobs, threads, watch, "unpacking pictures"); !done) return done.error();
  return images;
}

/// The file's picture as the target of a new document.
Result<LoadedProject> open_as_picture(const fs::path& path, const LoadOptions& options, const Watch& watch) {
  const auto file = OraFile::open(path, options.limits);
  if (!file) return file.error();
  auto picture = file->load_picture(watch);
  if (!picture) return picture.error();
  LoadedProject loaded;
  DocumentNew begin;
  begin.target = ImageRef{portable_name(path.filename().string()), std::move(*picture)};
  if (auto done = loaded.session.execute(begin, watch); !done) return done.error();
  loaded.foreign = true;
  if (const auto& left_out = file->left_out(); !left_out.empty())
    loaded.message = std::to_string(left_out.size()) + (left_out.size() == 1 ? " layer" : " layers") +
                     " cannot be read, the whole picture can: " + left_out.front().where + ": " +
                     left_out.front().sentence;
  return loaded;
}

} // namespace

Result<LoadedProject> load_project(const fs::path& path, const LoadOptions& options, const Watch& watch) {
  const StageTimer timer(watch.times, "open");
  auto archive = Archive::open(path, options.limits);
  if (!archive) return archive.error();
  if (!archive->has(kDocument)) return open_as_picture(path, options, watch);
  const auto text = read_text(*archive);
  if (!text && text.error().code == "project.newer") {
    auto loaded = open_as_picture(path, options, watch);
    if (!loaded) return loaded;
    loaded->foreign = false;
    loaded->read_only = true;
    loaded->message = text.error().sentence + ": it is shown as a picture, without its layers";
    return loaded;
  }
  if (!text) return text.error();
  const auto images = load_pictures(*archive, text->pictures(),
                                    choose_threads(options.threads > 0 ? options.threads : watch.threads), watch);
  if (!images) return images.error();
  auto saved = text->session(*images);
  if (!saved) return at(archive->place(kDocument), saved.error());
  auto session = Session::restore(std::move(*saved));
  if (!session) return at(archive->place(kDocument), session.error());
  LoadedProject loaded;
  loaded.session = std::move(*session);
  return loaded;
}

Result<Image> load_project_picture(const fs::path& path, const LoadOptions& options) {
  const auto file = OraFile::open(path, options.limits);
  if (!file) return file.error();
  return file->load_picture();
}

Result<int> read_project_version(const fs::path& path, const LoadOptions& options) {
  const auto archive = Archive::open(path, options.limits);
  if (!archive) return archive.error();
  if (!archive->has(kDocument)) return 0;
  const auto start = archive->read_start(kDocument, kVersionBytes);
  if (!start) return start.error();
  const auto version = peek_project_version({reinterpret_cast<const char*>(start->data()), start->size()});
  if (!version) return at(archive->place(kDocument), version.error());
  return *version;
}

} // namespace oversketch
