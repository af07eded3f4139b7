#include "core/io/project_text.h"

#include "core/document/command_specs.h"
#include "core/document/json_line.h"
#include "core/document/layer_settings.h"
#include "core/io/picture_folder.h"

namespace oversketch {
namespace {

/// Curves and layers stand in tables, each once, since most steps leave most of them as they were.
class Printer {
public:
  explicit Printer(const std::map<Hash, StoredPicture>& pictures) {
    for (const auto& [hash, picture] : pictures) {
      picture_index_.emplace(hash, pictures_.size());
      Json json;
      json["hash"] = to_string(hash);
      json["part"] = picture.part;
      json["width"] = picture.image.width();
      json["height"] = picture.image.height();
      pictures_.push_back(std::move(json));
    }
  }

  Json print(const SavedSession& saved) {
    Json solves = Json::array(), steps = Json::array();
    for (const SavedSession::Solve& solve : saved.solves) {
      Json json;
      json["layer"] = layer(solve.layer);
      if (solve.warm) json["warm"] = *solve.warm;
      solves.push_back(std::move(json));
    }
    for (const SavedSession::Step& step : saved.steps)
      steps.push_back(print_step(step));
    Json project;
    project["version"] = kProjectVersion;
    project["pictures"] = std::move(pictures_);
    project["curves"] = std::move(curves_);
    project["layers"] = std::move(layers_);
    project["solves"] = std::move(solves);
    project["steps"] = std::move(steps);
    project["cursor"] = saved.cursor;
    return project;
  }

private:
  Json print_step(const SavedSession::Step& step) {
    const Document& document = step.document;
    Json json;
    json["label"] = step.label;
    json["command"] = print_command_portably(step.command);
    json["target"] = named(document.target);
    json["layers"] = Json::array();
    for (const Layer& each : document.layers)
      json["layers"].push_back(layer(each));
    json["selected"] = document.selected ? Json(to_string(*document.selected)) : Json();
    json["next_layer"] = document.next_layer;
    json["next_pin"] = document.next_pin;
    json["solves"] = Json::object();
    for (const auto& [id, solve] : step.solves)
      json["solves"][to_string(id)] = solve;
    return json;
  }

  static Json print_command_portably(Command command) {
    if (auto* add = std::get_if<LayerAdd>(&command); add && !add->name && add->source.name != kTargetName)
      add->name = std::filesystem::path(add->source.name).stem().string();
    for (ImageRef* ref : images_of(command))
      ref->name = portable_name(ref->name);
    return command_json(command);
  }

  Json named(const NamedImage& image) const {
    Json json;
    json["name"] = portable_name(image.name);
    json["picture"] = picture_index_.at(image.image.content_hash());
    return json;
  }

  std::size_t curve(const Points& points) {
    const Hash hash = Hasher().add(std::span<const Point>(points)).finish();
    const auto [known, is_new] = curve_index_.emplace(hash, curves_.size());
    if (is_new) {
      Json flat = Json::array();
      for (const Point p : points) {
        flat.push_back(write_value(p.x));
        flat.push_back(write_value(p.y));
      }
      curves_.push_back(std::move(flat));
    }
    return known->second;
  }

  std::size_t layer(const Layer& layer) {
    Json json;
    json["id"] = to_string(layer.id);
    json["name"] = layer.name;
    json["source"] = named(layer.source);
    if (!layer.outline.empty()) {
      json["outline"] = curve(layer.outline);
      json["sketch"] = curve(layer.sketch);
    }
    json["pins"] = Json::array();
    for (const Pin& pin : layer.pins) {
      Json end;
      end["id"] = to_string(pin.id);
      end["outline"] = write_value(pin.outline);
      end["sketch"] = write_value(pin.sketch);
      json["pins"].push_back(std::move(end));
    }
    const Placement& p = layer.placement;
    json["placement"] = Json::array({write_value(p.factor.real()), write_value(p.factor.imag()),
                                     write_value(p.offset.x), write_value(p.offset.y), p.dx, p.dy});
    json["settings"] = Json::object();
    write_record(all_settings(layer.settings), json["settings"]);
    const auto [known, is_new] = layer_index_.emplace(print_json_line(json), layers_.size());
    if (is_new) layers_.push_back(std::move(json));
    return known->second;
  }

  Json pictures_ = Json::array(), curves_ = Json::array(), layers_ = Json::array();
  std::map<Hash, std::size_t> picture_index_, curve_index_;
  std::map<std::string, std::size_t> layer_index_;
};

} // namespace

std::map<Hash, StoredPicture> pictures_of(const SavedSession& saved) {
  std::map<Hash, StoredPicture> pictures;
  const auto add = [&](const Image& image) { pictures.try_emplace(image.content_hash(), StoredPicture{image, ""}); };
  for (const SavedSession::Solve& solve : saved.solves)
    add(solve.layer.source.image);
  for (const SavedSession::Step& step : saved.steps) {
    add(step.document.target.image);
    for (const Layer& layer : step.document.layers)
      add(layer.source.image);
  }
  return pictures;
}

std::string print_project(const SavedSession& saved, const std::map<Hash, StoredPicture>& pictures) {
  return print_json_line(Printer(pictures).print(saved)) + "\n";
}

} // namespace oversketch
