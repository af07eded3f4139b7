#pragma once

// Documents, curves and random commands that tests of several rooms use.

#include "core/document/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace oversketch::testing {

inline Image plain_image(int width, int height, Rgba color = {0.5f, 0.25f, 0.75f, 1}) {
  return Image(Raster<Rgba>(width, height, color));
}

/// Smooth waves, so that blending has something to do.
inline Image wavy_image(int width, int height, double phase) {
  Raster<Rgba> pixels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto wave = [&](double k) {
        return static_cast<float>(0.5 + 0.4 * std::sin(k * (0.05 * x + 0.03 * y) + phase));
      };
      pixels.at(x, y) = {wave(1), wave(1.7), wave(0.6), 1};
    }
  return Image(std::move(pixels));
}

inline ImageRef loaded_ref(std::string name, Image image) {
  return {std::move(name), std::move(image)};
}

/// A smooth closed curve round `centre`, never crossing itself.
inline Points blob(Point centre, double radius, double wobble = 0.2, int count = 40, double phase = 0) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double r = radius * (1 + wobble * std::sin(3 * angle + phase));
    points.push_back(centre + r * Point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

/// An ellipse, which is like its half turn: it can be laid along itself in two ways.
inline Points bar(Point centre, double half_length, double half_width) {
  Points points;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / 48;
    points.push_back(centre + Point{half_length * std::cos(angle), half_width * std::sin(angle)});
  }
  return points;
}

inline DocumentNew new_document(int width, int height) {
  DocumentNew command;
  command.width = width;
  command.height = height;
  return command;
}

/// The document after a command that must be taken.
inline Document applied(const Document& document, const Command& command) {
  auto after = apply(document, command);
  EXPECT_TRUE(after.ok()) << (after.ok() ? "" : to_string(after.error()));
  return after.ok() ? *after : document;
}

/// The code with which a command is refused, or "accepted".
inline std::string refusal(const Document& document, const Command& command) {
  const auto after = apply(document, command);
  return after.ok() ? "accepted" : after.error().code;
}

/// One random command; many are refused by a given document, as a person's would be.
class RandomCommands {
public:
  explicit RandomCommands(unsigned seed) : random_(seed) {}

  Command next() {
    switch (below(18)) {
    case 0:
      return TargetSet{loaded_ref("target.png", wavy_image(90, 80, below(3)))};
    case 1:
      return LayerAdd{loaded_ref("source.png", wavy_image(100, 90, below(4))), std::nullopt};
    case 2:
      return LayerAdd{{std::string(kTargetName), std::nullopt}, "copy"};
    case 3:
      return LayerRemove{layer()};
    case 4:
      return LayerSelect{layer()};
    case 5:
      return LayerRename{layer(), "name " + std::to_string(below(9))};
    case 6:
      return LayerOrder{layer(), below(4)};
    case 7:
      return RegionSet{layer(), blob({real(30, 60), real(30, 60)}, real(15, 28), real(0, 0.3))};
    case 8:
      return SketchSet{layer(), blob({real(0, 90), real(0, 80)}, real(12, 30), real(0, 0.3), 40, real(0, 6))};
    case 9:
      return SketchReset{layer()};
    case 10:
      return PinAdd{layer(), point(), point()};
    case 11:
      return PinMove{layer(), {1 + below(5)}, chance() ? std::optional(point()) : std::nullopt, point()};
    case 12:
      return PinRemove{layer(), {1 + below(5)}};
    case 13:
      return LayerMove{layer(), {below(41) - 20, below(41) - 20}};
    case 14:
      return LayerTransform{layer(), real(-40, 40), real(0.7, 1.4), chance() ? std::optional(point()) : std::nullopt};
    case 15:
      return RegionEdit{layer(), stroke(), side(), real(2, 20), chance()};
    case 16:
      return SketchEdit{layer(), stroke(), side(), real(2, 20), chance()};
    default: {
      LayerSet set;
      set.layer = layer();
      if (chance()) set.cell_px = real(5, 12);
      if (chance()) set.opacity = real(0, 1);
      if (chance()) set.mode = static_cast<CloneMode>(below(5));
      if (chance()) set.strength = real(0, 1);
      if (chance()) set.visible = chance();
      if (chance()) set.iterations = below(8);
      if (chance()) set.sampling = static_cast<WarpSampling>(below(2));
      return set;
    }
    }
  }

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance() { return below(2) == 0; }
  Point point() { return {real(0, 90), real(0, 80)}; }
  StrokeSide side() { return chance() ? StrokeSide::kAuto : StrokeSide::kOther; }
  /// An open arc somewhere in the middle of the picture, where curves are.
  Points stroke() {
    const Point centre{real(35, 55), real(35, 50)};
    const double radius = real(12, 32), from = real(0, 6.3), sweep = real(0.3, 2.5);
    Points points;
    for (int i = 0; i <= 12; ++i) {
      const double angle = from + sweep * i / 12;
      points.push_back(centre + radius * Point{std::cos(angle), std::sin(angle)});
    }
    return points;
  }
  LayerRef layer() { return chance() ? LayerRef() : LayerRef(LayerId{1 + below(4)}); }

private:
  std::mt19937 random_;
};

} // namespace oversketch::testing
