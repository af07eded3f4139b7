#include "core/io/project_text.h"

#include "core/document/command_specs.h"
#include "core/document/json_line.h"
#include "core/document/layer_settings.h"
#include "core/geometry/curve.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace oversketch {
namespace {

/// Beyond what commands can bring about: sketches are kept at up to a thousand times their size, shifts up to 2^20.
constexpr double kFurthest = 2e9;
constexpr int kFurthestShift = 1 << 21;
constexpr double kLeastScale = 0.9e-3, kMostScale = 1.1e3;

/// Thrown and caught within this file: what is wrong, in the words of a person.
struct Damage {
  std::string sentence;
};

[[noreturn]] void damage(std::string sentence) {
  throw Damage{std::move(sentence)};
}

Error damaged(const std::string& where, const std::string& sentence) {
  return {"project.damaged", "this part of the file is damaged: " + sentence, where};
}

const Json& member(const Json& object, const char* key) {
  if (!object.is_object()) damage("an object {…} is missing");
  const auto found = object.find(key);
  if (found == object.end()) damage(std::string("\"") + key + "\" is missing");
  return *found;
}

const Json& list(const Json& object, const char* key) {
  const Json& found = member(object, key);
  if (!found.is_array()) damage(std::string("\"") + key + "\" is no list");
  return found;
}

template <class T>
T value(const Json& json, const char* what) {
  T read{};
  if (const Mismatch wrong = read_value(json, read)) damage(std::string("\"") + what + "\" must be " + *wrong);
  return read;
}

template <class T>
T field(const Json& object, const char* key) {
  return value<T>(member(object, key), key);
}

/// A place in a table of `size` entries.
std::size_t index(const Json& json, std::size_t size, const char* what) {
  const int number = value<int>(json, what);
  if (number < 0 || static_cast<std::size_t>(number) >= size)
    damage(std::string("\"") + what + "\" names number " + std::to_string(number) + " of " + std::to_string(size));
  return static_cast<std::size_t>(number);
}

void expect(bool holds, const char* sentence) {
  if (!holds) damage(sentence);
}

Hash read_hash(const Json& json) {
  const auto text = value<std::string>(json, "hash");
  Hash hash;
  const char* begin = text.data();
  const bool good = text.size() == 32 && std::from_chars(begin, begin + 16, hash.high, 16).ptr == begin + 16 &&
                    std::from_chars(begin + 16, begin + 32, hash.low, 16).ptr == begin + 32;
  expect(good && to_string(hash) == text, "a picture's hash is none");
  return hash;
}

Points read_curve(const Json& flat) {
  expect(flat.is_array() && flat.size() % 2 == 0, "a curve is no list of coordinates");
  Points points(flat.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {value<double>(flat[2 * i], "x"), value<double>(flat[2 * i + 1], "y")};
    expect(std::abs(points[i].x) < kFurthest && std::abs(points[i].y) < kFurthest, "a curve reaches too far");
  }
  return points;
}

Placement read_placement(const Json& json) {
  expect(json.is_array() && json.size() == 6, "a placement has not six numbers");
  const auto number = [&](std::size_t i) { return value<double>(json[i], "placement"); };
  Placement placement;
  placement.factor = {number(0), number(1)};
  placement.offset = {number(2), number(3)};
  placement.dx = value<int>(json[4], "placement");
  placement.dy = value<int>(json[5], "placement");
  const double scale = std::abs(placement.factor);
  expect(scale >= kLeastScale && scale <= kMostScale, "a placement scales too much");
  expect(placement.offset.x >= 0 && placement.offset.x <= 1 && placement.offset.y >= 0 && placement.offset.y <= 1,
         "a placement's parts of pixels are none");
  expect(std::abs(placement.dx) <= kFurthestShift && std::abs(placement.dy) <= kFurthestShift,
         "a placement shifts too far");
  return placement;
}

LayerSettings read_settings(const Json& json) {
  expect(json.is_object(), "a layer's settings are no object {…}");
  const auto given = read_record<LayerSet>(json, "");
  if (!given) damage("a layer's settings: " + given.error().sentence);
  if (const auto good = check_ranges(*given); !good) damage("a layer's settings: " + good.error().sentence);
  LayerSettings settings;
  assign_settings(settings, *given);
  return settings;
}

} // namespace

struct ProjectText::Data {
  Json project;
  std::vector<Picture> pictures;
  std::size_t most_points = 0;

  void read_pictures() {
    for (const Json& json : list(project, "pictures")) {
      Picture picture{read_hash(member(json, "hash")), field<std::string>(json, "part"), field<int>(json, "width"),
                      field<int>(json, "height")};
      expect(picture.width > 0 && picture.height > 0, "a picture has no pixels");
      pictures.push_back(std::move(picture));
    }
  }

  NamedImage read_named(const Json& json, const std::vector<Image>& images) const {
    return {field<std::string>(json, "name"), images[index(member(json, "picture"), images.size(), "picture")]};
  }

  Layer read_layer(const Json& json, const std::vector<Points>& curves, const std::vector<Image>& images) const {
    Layer layer;
    layer.id = field<LayerId>(json, "id");
    layer.name = field<std::string>(json, "name");
    layer.source = read_named(member(json, "source"), images);
    layer.placement = read_placement(member(json, "placement"));
    layer.settings = read_settings(member(json, "settings"));
    std::set<PinId> ids;
    for (const Json& each : list(json, "pins")) {
      const Pin pin{field<PinId>(each, "id"), field<Point>(each, "outline"), field<Point>(each, "sketch")};
      expect(ids.insert(pin.id).second, "two pins have one id");
      expect(std::abs(pin.outline.x) < kFurthest && std::abs(pin.outline.y) < kFurthest &&
                 std::abs(pin.sketch.x) < kFurthest && std::abs(pin.sketch.y) < kFurthest,
             "a pin lies too far away");
      layer.pins.push_back(pin);
    }
    if (json.contains("outline")) {
      layer.outline = curves[index(json["outline"], curves.size(), "outline")];
      layer.sketch = curves[index(member(json, "sketch"), curves.size(), "sketch")];
      check_curves(layer);
    } else {
      expect(layer.pins.empty(), "a layer without a region has pins");
    }
    return layer;
  }

  static void check_curves(const Layer& layer) {
    const auto outline = check_closed_curve(layer.outline, "outline");
    if (!outline) damage(outline.error().sentence);
    expect(outline->size() == layer.outline.size(), "an outline repeats points");
    for (const Point p : layer.outline)
      expect(p.x >= 0 && p.y >= 0 && p.x <= layer.source.image.width() && p.y <= layer.source.image.height(),
             "an outline leaves its picture");
    // Crossings are the solver's to refuse: the sketch went through the placement's inverse, and rounding may have
    // brought two of its lines together.
    expect(layer.sketch.size() >= 3 && perimeter(layer.sketch) > 0, "a sketch is no curve");
  }

  SavedSession::Step read_step(const Json& json, const std::vector<Layer>& layers, std::size_t solves,
                               const std::vector<Image>& images) const {
    SavedSession::Step step;
    step.label = field<std::string>(json, "label");
    Document& document = step.document;
    document.target = read_named(member(json, "target"), images);
    document.next_layer = field<int>(json, "next_layer");
    document.next_pin = field<int>(json, "next_pin");
    std::set<LayerId> ids;
    std::set<PinId> pins;
    for (const Json& each : list(json, "layers")) {
      document.layers.push_back(layers[index(each, layers.size(), "layers")]);
      const Layer& layer = document.layers.back();
      expect(ids.insert(layer.id).second && layer.id.number < document.next_layer, "a layer's id is not its own");
      for (const Pin& pin : layer.pins)
        expect(pins.insert(pin.id).second && pin.id.number < document.next_pin, "a pin's id is not its own");
    }
    if (const Json& selected = member(json, "selected"); !selected.is_null()) {
      document.selected = value<LayerId>(selected, "selected");
      expect(ids.contains(*document.selected), "the selected layer is not there");
    }
    const Json& planned = member(json, "solves");
    expect(planned.is_object(), "\"solves\" is no object {…}");
    for (const auto& [id, solve] : planned.items())
      step.solves.emplace(value<LayerId>(id, "solves"), index(solve, solves, "solves"));
    step.command = read_command_of(member(json, "command"), document);
    return step;
  }

  /// The command with the pictures that it brought into the document.
  static Command read_command_of(const Json& json, const Document& after) {
    expect(json.is_object(), "a command is no object {…}");
    const auto name = read_do(json);
    if (!name) damage(name.error().sentence);
    const auto read = read_command(json, *name);
    if (!read) damage("there is no command \"" + name->substr(0, 60) + "\"");
    if (!read->ok()) damage(read->error().sentence);
    Command command = read->value();
    if (const auto good = check_values(command); !good) damage(good.error().sentence);
    const bool adds = std::holds_alternative<LayerAdd>(command);
    expect(!adds || !after.layers.empty(), "a layer was added that is not there");
    for (ImageRef* ref : images_of(command))
      ref->image = adds ? after.layers.back().source.image : after.target.image;
    return command;
  }

  SavedSession read(const std::vector<Image>& images) const {
    std::vector<Points> curves;
    for (const Json& flat : list(project, "curves"))
      curves.push_back(read_curve(flat));
    std::vector<Layer> layers;
    std::size_t points = 0;
    // A layer is copied wherever it stands: counted before any is.
    const auto count = [&](const Layer& layer) {
      constexpr std::size_t kBesides = 2 * sizeof(Layer) / sizeof(Point);
      points += layer.outline.size() + layer.sketch.size() + 4 * layer.pins.size() + kBesides;
      if (points > most_points) damage("its steps have more points than fit into memory");
    };
    for (const Json& json : list(project, "layers")) {
      layers.push_back(read_layer(json, curves, images));
      count(layers.back());
    }
    SavedSession saved;
    for (const Json& json : list(project, "solves")) {
      SavedSession::Solve solve{layers[index(member(json, "layer"), layers.size(), "layer")], std::nullopt};
      count(solve.layer);
      if (json.contains("warm")) solve.warm = index(json["warm"], saved.solves.size(), "warm");
      saved.solves.push_back(std::move(solve));
    }
    const Json& steps = list(project, "steps");
    for (const Json& json : steps)
      for (const Json& each : list(json, "layers"))
        count(layers[index(each, layers.size(), "layers")]);
    for (const Json& json : steps)
      saved.steps.push_back(read_step(json, layers, saved.solves.size(), images));
    expect(!saved.steps.empty(), "it has no steps");
    saved.cursor = index(member(project, "cursor"), saved.steps.size(), "cursor");
    return saved;
  }
};

ProjectText::ProjectText(std::unique_ptr<Data> data) : data_(std::move(data)) {}
ProjectText::~ProjectText() = default;
ProjectText::ProjectText(ProjectText&&) noexcept = default;
ProjectText& ProjectText::operator=(ProjectText&&) noexcept = default;

const std::vector<ProjectText::Picture>& ProjectText::pictures() const {
  return data_->pictures;
}

Result<int> peek_project_version(std::string_view start) {
  constexpr std::string_view kStart = "{\"version\":";
  const std::string_view head = start.substr(0, kVersionBytes);
  if (!head.starts_with(kStart)) return damaged("", "it does not begin with its version");
  const std::size_t number = std::min(head.find_first_not_of(' ', kStart.size()), head.size());
  int version = 0;
  const auto [end, failure] = std::from_chars(head.data() + number, head.data() + head.size(), version);
  const bool is_whole = end != head.data() + head.size() && (*end == ',' || *end == '}' || *end == ' ');
  if (failure != std::errc() || !is_whole || version < 1) return damaged("", "its version is no whole number");
  return version;
}

Result<ProjectText> ProjectText::parse(std::string_view text, const IoLimits& limits) {
  const auto version = peek_project_version(text);
  if (!version) return version.error();
  if (*version > kProjectVersion)
    return Error{"project.newer",
                 "the project was saved by a newer Oversketch (version " + std::to_string(*version) +
                     " of the file; this program knows up to " + std::to_string(kProjectVersion) + ")",
                 ""};
  auto data = std::make_unique<Data>();
  data->most_points = limits.memory_bytes / 4 / sizeof(Point);
  auto parsed = parse_json(text, limits.json_depth, limits.memory_bytes / 4);
  if (!parsed && parsed.error().code == "json.too-large")
    return Error{"project.too-large", parsed.error().sentence, ""};
  if (!parsed) return damaged("", parsed.error().sentence);
  data->project = std::move(*parsed);
  try {
    data->read_pictures();
  } catch (const Damage& found) {
    return damaged("", found.sentence);
  }
  return ProjectText(std::move(data));
}

Result<SavedSession> ProjectText::session(const std::vector<Image>& images) const {
  CHECK(images.size() == data_->pictures.size(), "one image for each picture");
  try {
    return data_->read(images);
  } catch (const Damage& found) {
    return damaged("", found.sentence);
  }
}

} // namespace oversketch
