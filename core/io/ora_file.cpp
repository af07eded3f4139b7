#include "core/io/ora_file.h"

#include "core/image/exact.h"
#include "core/io/archive.h"
#include "core/io/stack_xml.h"

#include <algorithm>
#include <string_view>

namespace oversketch {
namespace {

constexpr std::string_view kMimeType = "image/openraster";

std::string_view text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<ImageSize> read_part_size(const Archive& archive, const std::string& part) {
  const auto start = archive.read_start(part, kSizeHeaderBytes);
  if (!start) return start.error();
  auto size = read_image_size(*start);
  if (!size) return at(archive.place(part), size.error());
  return size;
}

std::size_t memory_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(Rgba);
}

/// `top` laid over `below` with that opacity.
Rgba over(const Rgba& top, double opacity, const Rgba& below) {
  const double w = top.a * opacity, under = below.a * (1 - w), alpha = w + under;
  if (!(alpha > 0)) return below;
  const auto mix = [&](float a, float b) { return static_cast<float>((w * a + under * b) / alpha); };
  return {mix(top.r, below.r), mix(top.g, below.g), mix(top.b, below.b), static_cast<float>(alpha)};
}

Result<Image> load_part_picture(const Archive& archive, const std::string& part, std::size_t memory_bytes) {
  auto bytes = read_part_picture(archive, part, memory_bytes);
  if (!bytes) return bytes.error();
  auto image = decode_file(std::move(*bytes));
  if (!image) return at(archive.place(part), image.error());
  return image;
}

void lay_over(Raster<Rgba>& canvas, const Raster<Rgba>& top, int x, int y, double opacity) {
  const Rect box = intersect({x, y, top.width(), top.height()}, canvas.rect());
  for (int row = box.y; row < box.bottom(); ++row)
    for (int column = box.x; column < box.right(); ++column) {
      Rgba& below = canvas.at(column, row);
      below = over(top.at(column - x, row - y), opacity, below);
    }
}

} // namespace

struct OraFile::Data {
  Archive archive;
  Stack stack;
  std::vector<Layer> layers;
  /// The part that holds each layer.
  std::vector<std::string> sources;
  std::vector<Error> left_out;

  void add_layers(const std::vector<StackNode>& nodes, int x, int y, bool visible) {
    for (const StackNode& node : nodes) {
      const bool shown = visible && node.visible;
      if (node.is_group) {
        add_layers(node.children, x + node.x, y + node.y, shown);
        continue;
      }
      const auto size = read_part_size(archive, node.source);
      if (!size) {
        left_out.push_back(size.error());
        continue;
      }
      layers.push_back({node.name, {x + node.x, y + node.y, size->width, size->height}, shown, node.opacity});
      sources.push_back(node.source);
    }
  }

  /// @param canvases  that are there already, each of the whole picture's size.
  Result<Raster<Rgba>> composite(const std::vector<StackNode>& nodes, int x, int y, std::size_t canvases,
                                 const Watch& watch) const {
    const std::size_t budget = archive.limits().memory_bytes, canvas_bytes = memory_of(stack.width, stack.height);
    if (canvas_bytes > budget / (canvases + 1))
      return Error{"project.too-large", "there is not enough memory for its groups", archive.place("stack.xml")};
    Raster<Rgba> canvas(stack.width, stack.height, {0, 0, 0, 0});
    for (const StackNode& node : nodes) {
      if (watch.stopped()) return cancelled();
      if (!node.visible) continue;
      if (node.composite_op != "svg:src-over")
        return Error{"project.unsupported",
                     "layer \"" + node.name.substr(0, 60) + "\" is blended by \"" + node.composite_op.substr(0, 60) +
                         "\", and the file has no merged picture: save it again with the program it is from",
                     archive.place("stack.xml")};
      if (node.is_group) {
        const auto group = composite(node.children, x + node.x, y + node.y, canvases + 1, watch);
        if (!group) return group.error();
        lay_over(canvas, *group, 0, 0, node.opacity);
      } else {
        const auto picture = load_part_picture(archive, node.source, budget - (canvases + 1) * canvas_bytes);
        if (!picture) return picture.error();
        lay_over(canvas, picture->pixels(), x + node.x, y + node.y, node.opacity);
      }
    }
    return canvas;
  }
};

OraFile::OraFile(std::unique_ptr<Data> data) : data_(std::move(data)) {}
OraFile::~OraFile() = default;
OraFile::OraFile(OraFile&&) noexcept = default;
OraFile& OraFile::operator=(OraFile&&) noexcept = default;

Result<OraFile> OraFile::open(const std::filesystem::path& path, const IoLimits& limits) {
  auto archive = Archive::open(path, limits);
  if (!archive) return archive.error();
  const auto type = archive->read("mimetype", 1000);
  if (!type) return type.error();
  if (!text_of(*type).starts_with(kMimeType))
    return Error{"project.not-an-archive", "this is no OpenRaster file: its \"mimetype\" is another", path.string()};
  const auto xml = archive->read("stack.xml", limits.xml_bytes);
  if (!xml) return xml.error();
  auto stack = parse_stack(text_of(*xml), limits);
  if (!stack) return at(archive->place("stack.xml"), stack.error());
  auto data = std::make_unique<Data>(Data{std::move(*archive), std::move(*stack), {}, {}, {}});
  data->add_layers(data->stack.layers, 0, 0, true);
  return OraFile(std::move(data));
}

int OraFile::width() const {
  return data_->stack.width;
}
int OraFile::height() const {
  return data_->stack.height;
}
const std::vector<OraFile::Layer>& OraFile::layers() const {
  return data_->layers;
}
const std::vector<Error>& OraFile::left_out() const {
  return data_->left_out;
}
const Archive& OraFile::archive() const {
  return data_->archive;
}

Result<Image> OraFile::load_layer(std::size_t index) const {
  CHECK(index < data_->sources.size(), "one of the layers");
  return load_part_picture(data_->archive, data_->sources[index], data_->archive.limits().memory_bytes);
}

Result<Image> OraFile::load_picture(const Watch& watch) const {
  if (data_->archive.has(kMergedPart))
    return load_part_picture(data_->archive, kMergedPart, data_->archive.limits().memory_bytes);
  auto canvas = data_->composite(data_->stack.layers, 0, 0, 0, watch);
  if (!canvas) return canvas.error();
  return Image(std::move(*canvas));
}

Result<std::vector<std::byte>> read_part_picture(const Archive& archive, const std::string& part,
                                                 std::size_t memory_bytes) {
  const auto size = read_part_size(archive, part);
  if (!size) return size.error();
  const std::size_t memory = memory_of(size->width, size->height);
  if (memory > memory_bytes)
    return Error{"project.too-large",
                 "this picture of " + std::to_string(size->width) + " × " + std::to_string(size->height) +
                     " pixels needs more memory than the program may take",
                 archive.place(part)};
  // Pixels that do not pack at all, with room for what else a PNG may hold.
  constexpr std::size_t kBesides = 16 << 20;
  return archive.read(part, memory + memory / 16 + kBesides);
}

} // namespace oversketch
