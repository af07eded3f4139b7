#include "ui/state/settings.h"

#include "core/base/file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMostBytes = 1'000'000;

template <class T>
struct Choice {
  const char* name;
  T value;
};
constexpr Choice<Theme> kThemes[] = {{"dark", Theme::kDark}, {"light", Theme::kLight}};
constexpr Choice<Smoothing> kSmoothings[] = {
    {"none", Smoothing::kNone}, {"basic", Smoothing::kBasic}, {"stabiliser", Smoothing::kStabiliser}};

void read(const Json& json, const char* key, double& value, double least, double most) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return;
  const double given = found->get<double>();
  if (given >= least && given <= most) value = given;
}

void read(const Json& json, const char* key, bool& value) {
  if (const auto found = json.find(key); found != json.end() && found->is_boolean()) value = found->get<bool>();
}

template <class T, std::size_t n>
void read(const Json& json, const char* key, T& value, const Choice<T> (&choices)[n]) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) return;
  for (const auto& choice : choices)
    if (found->get_ref<const std::string&>() == choice.name) value = choice.value;
}

template <class T, std::size_t n>
const char* name_of(T value, const Choice<T> (&choices)[n]) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.name;
  return choices[0].name;
}

Preferences read_preferences(const Json& json) {
  Preferences read_here;
  read(json, "theme", read_here.theme, kThemes);
  read(json, "ui_scale", read_here.ui_scale, 0.5, 3);
  read(json, "wheel_zooms", read_here.wheel_zooms);
  read(json, "smoothing", read_here.smoothing, kSmoothings);
  read(json, "tolerance_px", read_here.tolerance_px, 1, 100);
  read(json, "history_mib", read_here.history_mib, 1, 1 << 20);
  read(json, "pictures_mib", read_here.pictures_mib, 16, 1 << 20);
  read(json, "system_dialog", read_here.system_dialog);
  if (const auto recent = json.find("recent_files"); recent != json.end() && recent->is_array())
    for (const Json& file : *recent)
      if (file.is_string() && !file.get_ref<const std::string&>().empty())
        read_here.recent_files.emplace_back(file.get<std::string>());
  return put_in_range(std::move(read_here));
}

void write_into(Json& json, const Preferences& preferences) {
  json["theme"] = name_of(preferences.theme, kThemes);
  json["ui_scale"] = preferences.ui_scale;
  json["wheel_zooms"] = preferences.wheel_zooms;
  json["smoothing"] = name_of(preferences.smoothing, kSmoothings);
  json["tolerance_px"] = preferences.tolerance_px;
  json["history_mib"] = preferences.history_mib;
  json["pictures_mib"] = preferences.pictures_mib;
  json["system_dialog"] = preferences.system_dialog;
  json["recent_files"] = Json::array();
  for (const fs::path& file : preferences.recent_files)
    json["recent_files"].push_back(file.string());
}

/// The file's object; discarded where it holds none.
Json parse_object(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_object() ? json : Json(Json::value_t::discarded);
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

} // namespace

fs::path settings_path() {
  fs::path folder = variable("XDG_CONFIG_HOME");
  if (!folder.is_absolute()) {
    const fs::path home = variable("HOME");
    if (!home.is_absolute()) return {};
    folder = home / ".config";
  }
  return folder / "oversketch" / "settings.json";
}

double stepped_tolerance(double tolerance_px, bool greater) {
  const double step = std::max(1.0, std::round((greater ? 0.25 : 0.2) * tolerance_px));
  return std::clamp(tolerance_px + (greater ? step : -step), 1.0, 100.0);
}

Preferences put_in_range(Preferences preferences) {
  const auto clamp = [](double& value, double least, double most, double otherwise) {
    value = std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
  };
  clamp(preferences.ui_scale, 0.5, 3, 1);
  clamp(preferences.tolerance_px, 1, 100, 10);
  clamp(preferences.history_mib, 1, 1 << 20, 2048);
  clamp(preferences.pictures_mib, 16, 1 << 20, 8192);
  if (preferences.recent_files.size() > kMostRecent) preferences.recent_files.resize(kMostRecent);
  return preferences;
}

LoadedPreferences load_preferences(const fs::path& path) {
  std::error_code failure;
  if (path.empty() || !fs::exists(path, failure)) return {};
  const auto text = read_text_file(path, kMostBytes);
  if (!text) return {{}, text.error()};
  const Json json = parse_object(*text);
  if (json.is_discarded())
    return {{}, Error{"settings.damaged", "the preferences cannot be read; these are the defaults", path.string()}};
  return {read_preferences(json), std::nullopt};
}

Result<void> save_preferences(const Preferences& preferences, const fs::path& path) {
  std::error_code failure;
  fs::create_directories(path.parent_path(), failure);
  if (failure) return Error{"file.write", "the folder cannot be made: " + failure.message(), path.string()};
  Json json(Json::value_t::object);
  if (const auto text = read_text_file(path, kMostBytes))
    if (const Json old = parse_object(*text); !old.is_discarded()) json = old;
  write_into(json, preferences);
  return write_file(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

PreferencesKeeper::PreferencesKeeper(fs::path path) : path_(std::move(path)) {
  if (!path_.empty()) thread_ = std::jthread([this] { write_all(); });
}

PreferencesKeeper::~PreferencesKeeper() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
}

void PreferencesKeeper::keep(Preferences preferences) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(preferences);
  }
  changed_.notify_one();
}

std::optional<Error> PreferencesKeeper::take_problem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, std::nullopt);
}

void PreferencesKeeper::write_all() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return waiting_ || ending_; });
    if (!waiting_) return;
    const Preferences preferences = *std::exchange(waiting_, std::nullopt);
    lock.unlock();
    const auto written = save_preferences(preferences, path_);
    lock.lock();
    if (!written) problem_ = written.error();
  }
}

} // namespace oversketch
