#include "core/io/project.h"

#include "core/base/file.h"
#include "core/image/exact.h"
#include "core/image/resample.h"
#include "core/io/archive.h"
#include "core/io/jobs.h"
#include "core/io/picture_folder.h"
#include "core/io/project_text.h"
#include "core/io/stack_xml.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>

namespace oversketch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBackground = "data/background.png";

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

/// Whether its alpha is the highest level once it is rounded.
bool is_opaque(const Rgba& pixel) {
  return pixel.a * 255.0f + 0.5f >= 255.0f;
}

/// The layer as it is laid over what lies below.
ProjectContents::LayerPicture show_layer(const Layer& layer, WarpedRegion region) {
  if (region.rect.empty()) return {layer.name, {0, 0, 1, 1}, Image(Raster<Rgba>(1, 1, {0, 0, 0, 0}))};
  for (Rgba& pixel : region.pixels.values())
    pixel = is_opaque(pixel) ? Rgba{pixel.r, pixel.g, pixel.b, 1} : Rgba{0, 0, 0, 0};
  return {layer.name, region.rect, Image(std::move(region.pixels))};
}

/// The target, with the composite's pixels where layers painted and it is translucent all the same.
Image make_background(const Image& target, const ProjectContents& contents) {
  std::optional<Raster<Rgba>> changed;
  for (const auto& layer : contents.layers)
    for (int y = layer.rect.y; y < layer.rect.bottom(); ++y)
      for (int x = layer.rect.x; x < layer.rect.right(); ++x) {
        const Rgba& pixel = contents.merged.at(x, y);
        if (is_opaque(pixel) || pixel == target.at(x, y)) continue;
        if (!changed) changed = target.pixels();
        changed->at(x, y) = pixel;
      }
  return changed ? Image(std::move(*changed)) : target;
}

Stack make_stack(const ProjectContents& contents, const std::vector<std::string>& parts) {
  Stack stack;
  stack.width = contents.merged.width();
  stack.height = contents.merged.height();
  StackNode background;
  background.name = "target";
  background.source = kBackground;
  stack.layers.push_back(std::move(background));
  for (std::size_t i = 0; i < contents.layers.size(); ++i) {
    const auto& layer = contents.layers[i];
    StackNode node;
    node.name = clean_text(layer.name);
    node.source = parts[i];
    node.x = layer.rect.x;
    node.y = layer.rect.y;
    stack.layers.push_back(std::move(node));
  }
  return stack;
}

Image make_thumbnail(const Image& image) {
  const int longest = std::max(image.width(), image.height());
  if (longest <= kThumbnailSide) return image;
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(std::int64_t{side} * kThumbnailSide / longest));
  };
  return downscaled(image, scaled(image.width()), scaled(image.height()));
}

/// What is encoded, and the part it becomes.
class Encoder {
public:
  void add_png(const std::string& part, const Image& image, PngAlpha alpha) {
    add(part, [image, alpha] { return encode_png(image, BitDepth::k8, alpha); });
  }
  void add_thumbnail(const Image& image) {
    add("Thumbnails/thumbnail.png", [image] { return encode_png(make_thumbnail(image)); });
  }
  /// Names the picture's part when it is done.
  void add_exact(StoredPicture& picture, const Hash& hash) {
    ArchivePart& part = parts_.emplace_back();
    jobs_.push_back([&picture, &part, hash]() -> Result<void> {
      auto encoded = encode_exact(picture.image);
      if (!encoded) return encoded.error();
      picture.part = "oversketch/images/" + to_string(hash) + std::string(encoded->extension);
      part = {picture.part, std::move(encoded->bytes), encoded->extension == ".png"};
      return {};
    });
  }
  Result<std::vector<ArchivePart>> run(int threads, const Watch& watch) {
    if (auto done = run_jobs(jobs_, threads, watch, "packing pictures"); !done) return done.error();
    return std::vector<ArchivePart>(std::make_move_iterator(parts_.begin()), std::make_move_iterator(parts_.end()));
  }

private:
  void add(const std::string& name, std::function<Result<std::vector<std::byte>>()> encode) {
    ArchivePart& part = parts_.emplace_back();
    jobs_.push_back([&part, name, encode = std::move(encode)]() -> Result<void> {
      auto bytes = encode();
      if (!bytes) return at(name, bytes.error());
      part = {name, std::move(*bytes), true};
      return {};
    });
  }

  /// A deque: the jobs point into it.
  std::deque<ArchivePart> parts_;
  std::vector<std::function<Result<void>()>> jobs_;
};

/// Of what could be written and never be read again.
Error too_large(const std::string& what, std::uintmax_t most) {
  return {"project.too-large", what + ", and no more than " + std::to_string(most) + " can be opened again", ""};
}

/// document.json with as many of the steps as it may have bytes for.
Result<std::string> print_what_fits(const SavedSession& saved, const std::map<Hash, StoredPicture>& pictures,
                                    std::size_t most_bytes) {
  std::string text = print_project(saved, pictures);
  for (std::size_t steps = saved.steps.size(); text.size() > most_bytes && steps > 1;) {
    steps /= 2;
    text = print_project(shortened(saved, steps), pictures);
  }
  if (text.size() > most_bytes)
    return too_large("its curves and names take " + std::to_string(text.size()) + " bytes", most_bytes);
  return text;
}

Result<std::vector<ArchivePart>> make_parts(const ProjectContents& contents, const SaveOptions& options,
                                            const Watch& watch) {
  Encoder encoder;
  encoder.add_png(kMergedPart, contents.merged, PngAlpha::kWhereNeeded);
  encoder.add_png(kBackground, contents.background, PngAlpha::kWhereNeeded);
  std::map<Hash, StoredPicture> pictures = pictures_of(contents.saved);
  const Hash background = contents.background.content_hash();
  for (auto& [hash, picture] : pictures) {
    // The target is there already where it has 8 bits.
    if (hash == background && exact_depth(picture.image) == BitDepth::k8)
      picture.part = kBackground;
    else
      encoder.add_exact(picture, hash);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < contents.layers.size(); ++i) {
    names.push_back("data/layer" + std::to_string(i + 1) + ".png");
    encoder.add_png(names.back(), contents.layers[i].pixels, PngAlpha::kAlways);
  }
  encoder.add_thumbnail(contents.merged);
  auto encoded = encoder.run(choose_threads(options.threads > 0 ? options.threads : watch.threads), watch);
  if (!encoded) return encoded.error();

  const auto text = print_what_fits(contents.saved, pictures, options.limits.json_bytes);
  if (!text) return text.error();
  const std::string stack = print_stack(make_stack(contents, names));
  if (stack.size() > options.limits.xml_bytes)
    return too_large("its layers' names take " + std::to_string(stack.size()) + " bytes", options.limits.xml_bytes);
  std::vector<ArchivePart> parts;
  parts.push_back({"mimetype", bytes_of("image/openraster"), true});
  parts.push_back({"stack.xml", bytes_of(stack), false});
  parts.push_back({"oversketch/document.json", bytes_of(*text), false});
  for (ArchivePart& part : *encoded)
    parts.push_back(std::move(part));
  if (std::cmp_greater(parts.size(), options.limits.entries))
    return too_large("it has " + std::to_string(parts.size()) + " pictures",
                     static_cast<std::uintmax_t>(options.limits.entries));
  return parts;
}

} // namespace

Result<ProjectContents> gather_project(Session& session, const KeptHistory& kept, const Watch& watch) {
  const Document& document = session.document();
  if (document.empty()) return Error{"document.none", "there is no document yet: begin with document.new", ""};
  session.drop_preview();
  ProjectContents contents;
  // Lowest first, so that each finds the picture below it made.
  for (const Layer& layer : document.layers) {
    if (!layer.settings.visible) continue;
    auto region = session.layer_pixels(layer.id, watch);
    if (!region) return region.error();
    contents.layers.push_back(show_layer(layer, std::move(*region)));
  }
  auto merged = session.composite(watch);
  if (!merged) return merged.error();
  contents.merged = std::move(*merged);
  contents.background = make_background(document.target.image, contents);
  contents.saved = session.saved(kept);
  return contents;
}

Result<void> write_project(const ProjectContents& contents, const fs::path& path, const SaveOptions& options,
                           const Watch& watch) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored))
    if (const auto there = read_project_version(path); there && *there > kProjectVersion)
      return Error{"project.newer", "the file there was saved by a newer Oversketch: save under another name",
                   path.string()};
  StageTimer packing(watch.times, "save.pack");
  auto parts = make_parts(contents, options, watch);
  if (!parts) return at(path.string(), parts.error());
  packing.stop();
  StageTimer archiving(watch.times, "save.archive");
  const auto archive = make_archive(std::move(*parts));
  if (!archive) return at(path.string(), archive.error());
  archiving.stop();
  if (archive->size() > options.limits.file_bytes)
    return at(path.string(),
              too_large("it has " + std::to_string(archive->size()) + " bytes", options.limits.file_bytes));
  if (watch.stopped()) return cancelled();
  const StageTimer writing(watch.times, "save.write");
  WriteOptions how;
  how.keep_previous = true;
  how.clean_folder = true;
  how.watch = watch;
  return write_file(path, *archive, how);
}

Result<void> save_project(Session& session, const fs::path& path, const SaveOptions& options, const Watch& watch) {
  const auto contents = gather_project(session, options.history, watch);
  if (!contents) return contents.error();
  return write_project(*contents, path, options, watch);
}

} // namespace oversketch
