// Every length, so that whole fours and the rest are met in any mixture; nothing beside what is asked for is written.

#include "core/clone/pixel_planes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace oversketch {
namespace {

constexpr std::size_t kMost = 23;
constexpr float kMark = -77;

std::vector<Rgba8> random_levels(std::size_t count) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::vector<Rgba8> pixels(count);
  const auto level = [&] { return static_cast<std::uint8_t>(random()); };
  for (Rgba8& p : pixels)
    p = {level(), level(), level(), 255};
  return pixels;
}

/// Three planes with a mark after each.
struct Planes {
  std::size_t stride;
  std::vector<float> values;

  explicit Planes(std::size_t count) : stride(count + 1), values(3 * stride, kMark) {}
  float at(std::size_t plane, std::size_t i) const { return values[plane * stride + i]; }
  void expect_marks() const {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(at(k, stride - 1), kMark);
  }
};

TEST(PixelPlanes, HoldWhatThePixelsHold) {
  for (std::size_t count = 0; count < kMost; ++count) {
    const std::vector<Rgba8> levels = random_levels(count);
    std::vector<Rgba> encoded;
    std::vector<LivePixel> live;
    for (const Rgba8& p : levels) {
      encoded.push_back({p.r / 255.0F, p.g / 255.0F, p.b / 255.0F, 1});
      const auto packed = [](int level) { return static_cast<std::int16_t>(64 * level + 32); };
      live.push_back({packed(p.r), packed(p.g), packed(p.b), packed(255)});
    }
    Planes of_levels(count), of_encoded(count), of_live(count);
    EXPECT_TRUE(to_planes(levels.data(), count, of_levels.values.data(), of_levels.stride));
    EXPECT_TRUE(to_planes(encoded.data(), count, of_encoded.values.data(), of_encoded.stride));
    to_planes(live.data(), count, of_live.values.data(), of_live.stride);
    for (std::size_t i = 0; i < count; ++i) {
      const float expected[] = {encoded[i].r, encoded[i].g, encoded[i].b};
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(of_encoded.at(k, i), expected[k]);
        EXPECT_FLOAT_EQ(of_levels.at(k, i), expected[k]);
        // Equal pictures differ by nothing, whatever they are stored as.
        EXPECT_EQ(of_live.at(k, i), of_levels.at(k, i));
      }
    }
    for (const Planes* planes : {&of_levels, &of_encoded, &of_live})
      planes->expect_marks();
  }
}

TEST(PixelPlanes, TellOneTranslucentPixel) {
  for (std::size_t at = 0; at < kMost; ++at) {
    std::vector<Rgba8> levels = random_levels(kMost);
    std::vector<Rgba> encoded(kMost, {0, 0, 0, 1});
    levels[at].a = 254;
    encoded[at].a = 0.999F;
    Planes planes(kMost);
    EXPECT_FALSE(to_planes(levels.data(), kMost, planes.values.data(), planes.stride)) << at;
    EXPECT_FALSE(to_planes(encoded.data(), kMost, planes.values.data(), planes.stride)) << at;
  }
}

TEST(PixelPlanes, GoIntoSlotsAndOut) {
  for (std::size_t count = 0; count < kMost; ++count) {
    Planes planes(count);
    std::vector<Float4> pixels;
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<float>(i);
      pixels.push_back({Float4::Lanes{x, 100 + x, 200 + x, 300 + x}});
      for (std::size_t k = 0; k < 3; ++k)
        planes.values[k * planes.stride + i] = pixels[i][k];
    }
    std::vector<float> slots(3 * count + 1, kMark), same = slots;
    const auto slots_in = [&](std::vector<float>& values) {
      return GridSlots<float>{values.data(), values.data() + 3 * ((count + 1) / 2)};
    };
    to_slots(pixels, slots_in(slots));
    to_slots(planes.values.data(), planes.stride, count, slots_in(same));
    EXPECT_EQ(slots, same) << count;
    EXPECT_EQ(slots.back(), kMark) << count;
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(slots_in(slots).at(i)[0], pixels[i][0]) << count;
    std::vector<Float4> back(count);
    from_slots({slots_in(slots).even, slots_in(slots).odd}, back);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(back[i][k], pixels[i][k]) << count;
      EXPECT_EQ(back[i][3], 0) << count;
    }
  }
}

} // namespace
} // namespace oversketch
