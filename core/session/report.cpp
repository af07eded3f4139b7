#include "core/session/report.h"

#include "core/document/field_values.h"

#include <algorithm>
#include <complex>
#include <iterator>
#include <numbers>
#include <vector>

namespace oversketch {
namespace {

Json stages_json(const StageTimes& times) {
  Json stages = Json::object();
  for (const auto& [stage, ms] : times.stages_ms)
    stages[stage] = ms;
  return stages;
}

Json placement_json(const Placement& placement) {
  const Similarity map = placement.to_target();
  Json json;
  json["rotate_deg"] = std::arg(map.factor) * 180 / std::numbers::pi;
  json["scale"] = std::abs(map.factor);
  json["offset"] = write_value(to_point(map.offset));
  return json;
}

Json pins_json(const Layer& layer) {
  Json pins = Json::array();
  for (const Pin& pin : layer.pins) {
    Json json;
    json["id"] = to_string(pin.id);
    json["outline"] = write_value(pin.outline);
    json["sketch"] = write_value(layer.placement.to_target()(pin.sketch));
    pins.push_back(std::move(json));
  }
  return pins;
}

/// Null where nothing is seen that is blended in.
Json bleed_json(const BleedForecast& forecast) {
  std::vector<BleedSample> samples;
  std::ranges::copy_if(forecast.samples, std::back_inserter(samples), &BleedSample::is_seen);
  if (samples.empty()) return nullptr;
  double sum = 0;
  for (const BleedSample& sample : samples)
    sum += static_cast<double>(sample.norm);
  const auto worst = std::ranges::max_element(samples, {}, &BleedSample::norm);
  const auto steepest = std::ranges::max_element(samples, {}, &BleedSample::jump);
  Json json;
  json["mean"] = sum / static_cast<double>(samples.size());
  json["shift"] = forecast.mean;
  json["worst"] = worst->norm;
  json["worst_at"] = write_value(worst->at);
  json["jump"] = steepest->jump;
  json["jump_at"] = write_value(steepest->at);
  return json;
}

Json counters_json(const Counters& counters) {
  Json json;
  json["meshings"] = counters.deform.meshings;
  json["symbolic_factorizations"] = counters.deform.symbolic_factorizations;
  json["numeric_factorizations"] = counters.deform.numeric_factorizations;
  json["matches"] = counters.deform.matches;
  json["mask_setups"] = counters.mask_setups;
  json["clone_solves"] = counters.clone_solves;
  return json;
}

} // namespace

Json metrics_json(const Metrics& metrics) {
  Json json;
  json["flipped_cells"] = metrics.distortion.flipped_cells;
  json["sigma_ratio_mean"] = metrics.distortion.sigma_ratio_mean;
  json["sigma_ratio_p95"] = metrics.distortion.sigma_ratio_p95;
  json["sigma_ratio_max"] = metrics.distortion.sigma_ratio_max;
  json["area_spread"] = metrics.distortion.area_spread;
  json["sketch_distance_mean"] = metrics.sketch_distance.mean;
  json["sketch_distance_max"] = metrics.sketch_distance.max;
  if (metrics.truth_error) json["truth_error"] = *metrics.truth_error;
  json["energy"] = metrics.energy;
  json["iterations"] = metrics.iterations;
  json["match_cost"] = metrics.match_cost ? Json(*metrics.match_cost) : Json();
  json["vertices"] = metrics.vertices;
  json["handles"] = metrics.handles;
  json["order_violations"] = metrics.order_violations;
  json["cpu_ms"] = metrics.cpu_ms;
  json["stages_ms"] = stages_json(metrics.times);
  return json;
}

Result<Json> make_report(Session& session, const Watch& watch) {
  Json report;
  report["layers"] = Json::array();
  for (const Layer& layer : session.document().layers) {
    Json json;
    json["id"] = to_string(layer.id);
    json["name"] = layer.name;
    json["outline"] = write_value(layer.outline);
    json["sketch"] = write_value(layer.sketch_in_target());
    json["pins"] = pins_json(layer);
    json["placement"] = placement_json(layer.placement);
    json["metrics"] = nullptr;
    json["pixels"] = 0;
    json["bleed"] = nullptr;
    if (!layer.outline.empty()) {
      const auto metrics = session.metrics(layer.id, watch);
      if (!metrics) return metrics.error();
      json["metrics"] = metrics_json(*metrics);
      const auto pixels = session.painted_pixels(layer.id, watch);
      if (!pixels) return pixels.error();
      json["pixels"] = *pixels;
      const auto bleed = session.bleed(layer.id, watch);
      if (!bleed) return bleed.error();
      json["bleed"] = bleed_json(*bleed);
    }
    report["layers"].push_back(std::move(json));
  }
  report["history"] = Json::array();
  for (const History::Entry& entry : session.history().entries())
    report["history"].push_back(entry.label);
  report["cursor"] = session.history().cursor();
  report["modified"] = session.history().modified();
  report["counters"] = counters_json(session.counters());
  return report;
}

} // namespace oversketch
