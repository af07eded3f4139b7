#include "app/cli/cli.h"

#include "core/document/field_values.h"
#include "core/io/ora_file.h"
#include "core/io/project.h"
#include "core/session/report.h"

#include <cstdio>
#include <memory>

namespace oversketch::cli {
namespace {

struct InfoArguments {
  std::string project;
  bool json = false;
};

Json size_json(const Image& image) {
  return Json::array({image.width(), image.height()});
}

Result<Json> describe_layer(Session& session, const Layer& layer, const Watch& watch) {
  Json json;
  json["id"] = to_string(layer.id);
  json["name"] = layer.name;
  json["visible"] = layer.settings.visible;
  json["source"] = layer.source.name;
  json["size"] = size_json(layer.source.image);
  json["method"] = write_value(layer.settings.method);
  json["mode"] = write_value(layer.settings.mode);
  json["opacity"] = layer.settings.opacity;
  json["pins"] = layer.pins.size();
  json["metrics"] = nullptr;
  if (layer.outline.empty()) return json;
  const auto metrics = session.metrics(layer.id, watch);
  if (!metrics) return metrics.error();
  json["metrics"] = metrics_json(*metrics);
  return json;
}

/// The layers of a file that is another program's: they are offered as sources.
Result<Json> describe_foreign(const std::string& path, const IoLimits& limits) {
  const auto file = OraFile::open(path, limits);
  if (!file) return file.error();
  Json layers = Json::array();
  for (const OraFile::Layer& layer : file->layers()) {
    Json json;
    json["name"] = layer.name;
    json["visible"] = layer.visible;
    json["rect"] = Json::array({layer.rect.x, layer.rect.y, layer.rect.width, layer.rect.height});
    json["opacity"] = layer.opacity;
    layers.push_back(std::move(json));
  }
  return layers;
}

Result<Json> describe(const std::string& path, const IoLimits& limits, const Watch& watch) {
  const auto version = read_project_version(path, {limits});
  if (!version) return version.error();
  auto loaded = load_project(path, {limits}, watch);
  if (!loaded) return loaded.error();
  const Document& document = loaded->session.document();
  Json json;
  json["project_version"] = *version;
  json["width"] = document.target.image.width();
  json["height"] = document.target.image.height();
  json["read_only"] = loaded->read_only;
  if (!loaded->message.empty()) json["message"] = loaded->message;
  json["layers"] = Json::array();
  for (const Layer& layer : document.layers) {
    auto described = describe_layer(loaded->session, layer, watch);
    if (!described) return described.error();
    json["layers"].push_back(std::move(*described));
  }
  if (loaded->foreign || loaded->read_only) {
    auto offered = describe_foreign(path, limits);
    if (!offered) return offered.error();
    json["offered"] = std::move(*offered);
  }
  json["history"] = loaded->session.history().entries().size();
  json["cursor"] = loaded->session.history().cursor();
  return json;
}

void print(const std::string& path, const Json& json) {
  const auto text = [](const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); };
  const int version = json["project_version"].get<int>();
  std::printf("%s: %s × %s px, %s\n", path.c_str(), text(json["width"]).c_str(), text(json["height"]).c_str(),
              version == 0 ? "another program's file" : ("project of version " + std::to_string(version)).c_str());
  if (json.contains("message")) std::printf("  %s\n", text(json["message"]).c_str());
  for (const Json& layer : json["layers"]) {
    std::printf("  %s \"%s\"%s: source %s, %s × %s px, method %s, mode %s", text(layer["id"]).c_str(),
                text(layer["name"]).c_str(), layer["visible"].get<bool>() ? "" : " (hidden)",
                text(layer["source"]).c_str(), text(layer["size"][0]).c_str(), text(layer["size"][1]).c_str(),
                text(layer["method"]).c_str(), text(layer["mode"]).c_str());
    if (const Json& metrics = layer["metrics"]; metrics.is_object())
      std::printf(", flipped cells %s, mean σ1/σ2 %.3f", text(metrics["flipped_cells"]).c_str(),
                  metrics["sigma_ratio_mean"].get<double>());
    std::printf("\n");
  }
  if (json.contains("offered"))
    for (const Json& layer : json["offered"])
      std::printf("  \"%s\"%s: %s × %s px at %s, %s\n", text(layer["name"]).c_str(),
                  layer["visible"].get<bool>() ? "" : " (hidden)", text(layer["rect"][2]).c_str(),
                  text(layer["rect"][3]).c_str(), text(layer["rect"][0]).c_str(), text(layer["rect"][1]).c_str());
  std::printf("  history: %s entries, at number %s\n", text(json["history"]).c_str(), text(json["cursor"]).c_str());
}

} // namespace

void add_info(Cli& cli) {
  const auto options = std::make_shared<InfoArguments>();
  CLI::App* sub = cli.add("info", "Say what is in a project.", "info work.ora --json");
  sub->add_option("project", options->project, "the project")->required()->type_name("PROJECT.ora");
  sub->add_flag("--json", options->json, "as JSON");
  cli.add_memory_option(sub);
  cli.on_run(sub, [options, &cli](const Watch& watch) -> Result<Json> {
    auto described = describe(options->project, cli.limits(), watch);
    if (!described) return described;
    if (options->json)
      std::printf("%s\n", described->dump(1, ' ', false, Json::error_handler_t::replace).c_str());
    else
      print(options->project, *described);
    return described;
  });
}

} // namespace oversketch::cli
