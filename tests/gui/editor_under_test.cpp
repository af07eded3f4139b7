#include "tests/gui/editor_under_test.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace oversketch::testing {
namespace {

using Clock = std::chrono::steady_clock;

/// Until something in the watched folder has changed, or some milliseconds are over.
void wait_for_change(int watch, int most_ms) {
  pollfd wanted = {watch, POLLIN, 0};
  char events[4096];
  if (poll(&wanted, 1, most_ms) == 1 && read(watch, events, sizeof events) < 0) ADD_FAILURE() << "inotify";
}

} // namespace

EditorUnderTest::EditorUnderTest(Setup setup) : setup_(std::move(setup)) {
  std::filesystem::create_directories(folder_ / "config/oversketch");
  std::filesystem::create_directories(folder_ / "map");
  folder_.write("config/oversketch/settings.json", setup_.preferences.dump());
  watch_ = inotify_init1(IN_CLOEXEC);
  inotify_add_watch(watch_, (folder_ / "map").c_str(), IN_MOVED_TO);
  screen_ = std::make_unique<VirtualScreen>(1600, 1000, folder_ / "screen");
  std::vector<std::string> command = {OVERSKETCH_BUILD_DIR "/bin/oversketch", "--ui-map",
                                      (folder_ / "map/map.json").string(), "--size",
                                      std::to_string(setup_.width) + "x" + std::to_string(setup_.height)};
  command.insert(command.end(), setup_.arguments.begin(), setup_.arguments.end());
  std::map<std::string, std::string> environment = {{"DISPLAY", screen_->name()},
                                                    {"LIBGL_ALWAYS_SOFTWARE", "1"},
                                                    {"XDG_CONFIG_HOME", (folder_ / "config").string()},
                                                    {"XDG_STATE_HOME", (folder_ / "state").string()},
                                                    {"XDG_DATA_HOME", (folder_ / "data").string()},
                                                    {"XDG_CACHE_HOME", (folder_ / "cache").string()},
                                                    // The graphics driver's own, of which there are some.
                                                    {"ASAN_OPTIONS", "detect_leaks=0"}};
  for (const auto& [name, value] : setup_.environment)
    environment[name] = value;
  program_ = std::make_unique<Process>(command, environment, folder_ / "printed");
}

EditorUnderTest::~EditorUnderTest() {
  if (::testing::Test::HasFailure() && program_) {
    GTEST_LOG_(INFO) << "the program said: " << printed();
    GTEST_LOG_(INFO) << "the last map: " << map().dump(1).substr(0, 4000);
  }
  ::close(watch_);
}

Json EditorUnderTest::map() const {
  return Json::parse(folder_.read("map/map.json"), nullptr, false);
}

bool EditorUnderTest::wait_for(const std::string& what, const std::function<bool(const Json&)>& holds) {
  const auto end = Clock::now() + std::chrono::seconds(kPatience_s);
  while (true) {
    const Json now = map();
    if (!now.is_discarded() && holds(now)) return true;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (!program_->running() || left <= 0) {
      ADD_FAILURE() << "waited in vain for: " << what;
      return false;
    }
    // Not for ever: the program's end changes nothing in the folder.
    wait_for_change(watch_, static_cast<int>(std::min<long>(left, 500)));
  }
}

bool EditorUnderTest::start() {
  if (screen_->name().empty()) {
    ADD_FAILURE() << "Xvfb did not start (Debian's package xvfb): " << folder_.read("screen");
    return false;
  }
  hand_ = std::make_unique<Hand>(screen_->name());
  if (!wait_for("the window", [](const Json& map) { return !map.at("busy"); })) return false;
  if (!hand_->find_window()) {
    ADD_FAILURE() << "there is no window";
    return false;
  }
  hand_->move({setup_.width / 2.0, setup_.height - 2.0});
  return rest();
}

bool EditorUnderTest::rest() {
  // Events are taken in their order: when the last move has been, everything before it has been too.
  // Inside the window, that is: what moves outside of it is not told.
  const Json window = map().at("window");
  Point marker = hand_->place();
  marker.y = std::clamp(marker.y, 1.0, std::max(1.0, window[3].get<double>() - 2));
  const double inside = std::clamp(marker.x, 1.0, std::max(1.0, window[2].get<double>() - 2));
  // One to the side; a hand that was at the edge, and would stand still so, moves inside.
  const double beside = inside + (static_cast<int>(inside) % 2 == 0 ? 1 : -1);
  marker.x = beside == hand_->place().x ? inside : beside;
  hand_->move(marker);
  return wait_for("rest", [&](const Json& map) {
    return !map.at("busy") && map.at("pointer")[0] == marker.x && map.at("pointer")[1] == marker.y;
  });
}

std::optional<Point> EditorUnderTest::widget(const std::string& id) const {
  const Json now = map();
  const auto found = now.at("widgets").find(id);
  if (found == now.at("widgets").end()) return std::nullopt;
  const Json& box = *found;
  return Point{box[0].get<double>() + box[2].get<double>() / 2, box[1].get<double>() + box[3].get<double>() / 2};
}

bool EditorUnderTest::click(const std::string& id) {
  const auto at = widget(id);
  if (!at) {
    ADD_FAILURE() << "no widget " << id;
    return false;
  }
  hand_->click(*at);
  return rest();
}

bool EditorUnderTest::press(const std::string& chord) {
  hand_->key(chord);
  return rest();
}

Point EditorUnderTest::to_window(const std::string& side, Point picture) const {
  const Json now = map();
  const Json& canvas = now.at("canvases").at(side);
  const double zoom = canvas.at("zoom");
  const Json &origin = canvas.at("origin"), &rect = canvas.at("rect");
  return {rect[0].get<double>() + zoom * (picture.x - origin[0].get<double>()),
          rect[1].get<double>() + zoom * (picture.y - origin[1].get<double>())};
}

bool EditorUnderTest::draw(const std::string& side, const Points& picture) {
  Points points;
  for (const Point p : picture)
    points.push_back(to_window(side, p));
  hand_->draw(points);
  return rest();
}

bool EditorUnderTest::resize(int width, int height) {
  hand_->resize(width, height);
  return wait_for("the new size",
                  [&](const Json& map) { return map.at("window")[2] == width && map.at("window")[3] == height; }) &&
         rest();
}

std::optional<int> EditorUnderTest::close() {
  hand_->ask_to_close();
  return program_->wait();
}

} // namespace oversketch::testing
