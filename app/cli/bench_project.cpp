// Saving and opening a project: a target of 12 megapixels with two layers.

#include "app/cli/bench_cases.h"

#include "core/image/image_io.h"
#include "core/io/journal.h"
#include "core/io/project.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace oversketch::cli {
namespace {

namespace fs = std::filesystem;

/// Slopes, waves and grain at 8 bits, as a photograph has them.
Image make_photograph(int width, int height, std::uint32_t seed) {
  BenchRandom random(seed);
  const double wave = random.between(0.004, 0.02);
  Raster<Rgba> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double base = 0.5 + 0.3 * std::sin(wave * x) * std::cos(0.7 * wave * y);
      const auto level = [&](double by) {
        const double value = by * base + random.between(-0.01, 0.01);
        return static_cast<float>(std::round(255 * std::clamp(value, 0.0, 1.0))) / 255.0f;
      };
      picture.at(x, y) = {level(1.0), level(0.9), level(0.8), 1};
    }
  return Image(std::move(picture));
}

Points make_blob(Point centre, double radius) {
  Points points;
  for (int i = 0; i < 200; ++i) {
    const double a = 2 * std::numbers::pi * i / 200;
    points.push_back(centre + radius * (1 + 0.2 * std::sin(3 * a)) * Point{std::cos(a), std::sin(a)});
  }
  return points;
}

Result<Session> make_session() {
  Session session;
  DocumentNew begin;
  begin.target = ImageRef{"target.png", make_photograph(4000, 3000, 1)};
  if (auto done = session.execute(begin); !done) return done.error();
  for (const double x : {1200.0, 2800.0}) {
    const LayerAdd add{ImageRef{"source.png", make_photograph(2000, 1500, static_cast<std::uint32_t>(x))}, {}};
    const RegionSet region{{}, make_blob({1000, 750}, 500)};
    const SketchSet sketch{{}, make_blob({x, 1500}, 550)};
    for (const Command& command : {Command(add), Command(region), Command(sketch)})
      if (auto done = session.execute(command); !done) return done.error();
  }
  return session;
}

/// A folder for this run alone.
class Scratch {
public:
  Scratch() {
    std::string pattern = (fs::temp_directory_path() / "oversketch-bench-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Scratch() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

/// A step that brings a picture that was read from a file, until a crash cannot take it any more.
Result<void> run_journal(const BenchInput& input, BenchRecord& record) {
  const Scratch scratch;
  if (scratch.path().empty()) return Error{"file.write", "no temporary folder could be made", ""};
  const auto file = encode_jpeg(make_photograph(4000, 3000, 1));
  if (!file) return file.error();
  for (int run = -1; run < input.runs; ++run) {
    auto image = decode_file(*file);
    if (!image) return image.error();
    DocumentNew begin;
    begin.target = ImageRef{"target.jpg", std::move(*image)};
    auto journal = Journal::begin(scratch.path(), "bench");
    if (!journal) return journal.error();
    const Stopwatch watch;
    if (auto written = journal->append(Command(begin)); !written) return written;
    const Spent spent = watch.spent();
    if (run >= 0) record.add("project.journal", "12 megapixels, JPEG", spent);
    journal->discard();
  }
  return {};
}

Result<void> run_project(const BenchInput& input, BenchRecord& record) {
  const Scratch scratch;
  if (scratch.path().empty()) return Error{"file.write", "no temporary folder could be made", ""};
  auto session = make_session();
  if (!session) return session.error();
  if (auto picture = session->composite(); !picture) return picture.error();
  const fs::path path = scratch.path() / "bench.ora";
  const std::string item = "12 megapixels, 2 layers";
  const auto save = [&] { return save_project(*session, path); };
  if (auto done = record.repeat("project.save", item, input.runs, save); !done) return done;
  const auto open = [&] { return load_project(path); };
  if (auto done = record.repeat("project.open", item, input.runs, open); !done) return done;
  const auto show = [&] { return load_project_picture(path); };
  if (auto done = record.repeat("project.picture", item, input.runs, show); !done) return done;
  std::error_code ignored;
  record.add_value("project.size", item, static_cast<double>(fs::file_size(path, ignored)) / 1e6);
  return run_journal(input, record);
}

} // namespace

std::vector<BenchGroup> project_benches() {
  BenchGroup group;
  group.rows = {
      {"project.save", "ms", "save a project of 12 megapixels with two layers",
       BenchGoal{1500, BenchStatistic::kClock}},
      {"project.open", "ms", "open it: all pictures and the history", {}},
      {"project.picture", "ms", "its picture alone, the first that is shown", BenchGoal{1000, BenchStatistic::kClock}},
      {"project.size", "MB", "its file", {}},
      {"project.journal", "ms", "a step that brings a photograph of 12 megapixels, until it is in the journal", {}}};
  group.uses_cases = false;
  group.run = run_project;
  return {group};
}

} // namespace oversketch::cli
