// Every sample script is a test: what it shows is held by relations, and its picture by a small one kept beside this
// file. OVERSKETCH_REWRITE_GOLDEN=1 writes those anew.

#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/image/resample.h"
#include "core/io/recorder.h"
#include "core/io/runner.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

const fs::path kProject = OVERSKETCH_SOURCE_DIR;
constexpr int kGoldenWidth = 360;
/// Compilers may round differently: one level, and one more from the shrinking.
constexpr double kGoldenLevels = 2;

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kProject / "assets/samples"))
    if (entry.path().extension() == ".jsonl") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Sample : public ::testing::TestWithParam<std::string> {};

void expect_golden(const Image& shown, const std::string& name) {
  const fs::path golden = kProject / "tests/golden" / (name + ".png");
  const Image small = downscaled(shown, kGoldenWidth, kGoldenWidth * shown.height() / shown.width());
  if (std::getenv("OVERSKETCH_REWRITE_GOLDEN") != nullptr) ASSERT_TRUE(save_image(small, golden).ok());
  const auto wanted = load_image(golden);
  ASSERT_TRUE(wanted.ok()) << to_string(wanted.error());
  const auto difference = compare(small, *wanted);
  ASSERT_TRUE(difference.ok());
  if (difference->max_levels <= kGoldenLevels) return;
  const fs::path actual = fs::path(OVERSKETCH_BUILD_DIR) / "golden";
  fs::create_directories(actual);
  (void)save_image(small, actual / (name + ".png")).ok();
  (void)save_image(difference_image(small, *wanted, 10), actual / (name + ".difference.png")).ok();
  ADD_FAILURE() << "differs by " << difference->max_levels << " levels at (" << difference->x << ", " << difference->y
                << "); see " << actual;
}

void expect_sound(Session& session) {
  for (const Layer& layer : session.document().layers) {
    const auto metrics = session.metrics(layer.id);
    ASSERT_TRUE(metrics.ok());
    EXPECT_EQ(metrics->distortion.flipped_cells, 0) << to_string(layer.id);
    EXPECT_EQ(metrics->order_violations, 0) << to_string(layer.id);
    EXPECT_LT(metrics->distortion.sigma_ratio_mean, 1.5) << to_string(layer.id);
  }
}

void expect_changes_only_inside(Session& session, const Image& shown) {
  const Image target = session.document().target.image;
  std::vector<Image> layers;
  for (const Layer& layer : session.document().layers)
    layers.push_back(*session.layer_picture(layer.id));
  std::int64_t changed = 0;
  for (int y = 0; y < target.height(); ++y)
    for (int x = 0; x < target.width(); ++x) {
      const bool covered =
          std::any_of(layers.begin(), layers.end(), [&](const Image& layer) { return layer.at(x, y).a > 0; });
      if (!covered) ASSERT_EQ(shown.at(x, y), target.at(x, y)) << x << ", " << y;
      changed += shown.at(x, y) != target.at(x, y) ? 1 : 0;
    }
  EXPECT_GT(changed, 1000);
}

TEST_P(Sample, shows_its_picture_and_gives_the_same_bits_from_its_saved_session) {
  const TempFolder folder;
  Session session;
  const auto done = run_script_file(session, kProject / "assets/samples" / (GetParam() + ".jsonl"), folder.path(), {});
  ASSERT_TRUE(done.ok()) << to_string(done.error());
  EXPECT_TRUE(fs::exists(folder / (GetParam() + ".png")));
  const Image shown = *session.composite();
  expect_golden(shown, GetParam());
  expect_sound(session);
  expect_changes_only_inside(session, shown);

  ASSERT_TRUE(save_session(session, folder / "kept.jsonl").ok());
  Session opened;
  const auto again = open_session(opened, folder / "kept.jsonl", {});
  ASSERT_TRUE(again.ok()) << to_string(again.error());
  EXPECT_EQ(opened.document(), session.document());
  EXPECT_EQ(*opened.composite(), shown);
}

INSTANTIATE_TEST_SUITE_P(Samples, Sample, ::testing::ValuesIn(sample_names()),
                         [](const auto& sample) { return sample.param; });

} // namespace
} // namespace oversketch
