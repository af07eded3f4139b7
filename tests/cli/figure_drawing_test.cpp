// The brush and the letters of figures.

#include "app/cli/figure_canvas.h"
#include "app/cli/figure_font.h"

#include "core/geometry/curve.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace oversketch::cli {
namespace {

using testing::TempFolder;

constexpr Rgba kWhite{1, 1, 1, 1};
constexpr Rgba kNothing{0, 0, 0, 0};

/// The ink on a picture that was empty, px.
double ink(const Canvas& canvas) {
  double sum = 0;
  for (const Rgba& p : canvas.pixels().values())
    sum += p.a;
  return sum;
}

Points rectangle(double x, double y, double w, double h) {
  return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
}

TEST(FigureCanvas, DrawsNothingWhereThereIsNothing) {
  Canvas canvas(20, 20, kNothing);
  canvas.fill(Points{}, kWhite);
  canvas.fill(Points{{3, 3}}, kWhite);
  canvas.stroke({}, 2, false, kWhite);
  canvas.arrow({5, 5}, {5, 5}, 2, kWhite);
  canvas.fill(rectangle(30, 3, 10, 10), kWhite);
  canvas.fill(rectangle(-30, 3, 10, 10), kWhite);
  canvas.fill(rectangle(3, -1e9, 10, 1e8), kWhite);
  canvas.draw(Raster<Rgba>(4, 4, kWhite), 40, -40);
  EXPECT_EQ(ink(canvas), 0);
}

TEST(FigureCanvas, InkIsThePolygonsArea) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 50; ++round) {
    Points ring;
    for (int i = 0; i < 12; ++i) {
      const double t = 2 * 3.14159265358979 * (i + 0.7 * unit(random)) / 12, r = 8 + 30 * unit(random);
      ring.push_back({50 + 0.37 * round / 50 + r * std::cos(t), 50 + r * std::sin(t)});
    }
    Canvas canvas(100, 100, kNothing);
    canvas.fill(ring, kWhite);
    EXPECT_NEAR(ink(canvas), std::abs(signed_area(ring)), 0.5);
  }
  Canvas exact(10, 10, kNothing);
  exact.fill(rectangle(2.25, 3.5, 4.5, 3.25), kWhite);
  EXPECT_NEAR(ink(exact), 4.5 * 3.25, 1e-4);
  EXPECT_NEAR(exact.pixels().at(2, 3).a, 0.75 * 0.5, 1e-5);
  EXPECT_NEAR(exact.pixels().at(4, 5).a, 1, 1e-5);
}

TEST(FigureCanvas, OverlapsAreDrawnOnceAndHolesStayOpen) {
  const std::vector<Points> overlapping = {rectangle(2, 2, 10, 10), rectangle(6, 6, 10, 10)};
  Canvas both(20, 20, kNothing);
  both.fill(overlapping, {1, 1, 1, 0.5f});
  EXPECT_NEAR(ink(both), 0.5 * (100 + 100 - 36), 1e-3);
  Points hole = rectangle(5, 5, 4, 4);
  std::reverse(hole.begin(), hole.end());
  const std::vector<Points> frame = {rectangle(2, 2, 10, 10), hole};
  Canvas ring(20, 20, kNothing);
  ring.fill(frame, kWhite);
  EXPECT_NEAR(ink(ring), 100 - 16, 1e-3);
}

TEST(FigureCanvas, WhatHangsOutIsCutOff) {
  Canvas canvas(20, 20, kNothing);
  canvas.fill(rectangle(-7, -7, 17, 100), kWhite);
  EXPECT_NEAR(ink(canvas), 10 * 20, 1e-3);
  canvas.draw(Raster<Rgba>(50, 50, {0, 0, 1, 1}), -10, -10);
  EXPECT_EQ(canvas.pixels().at(19, 19), (Rgba{0, 0, 1, 1}));
}

TEST(FigureCanvas, StrokesHaveTheirWidth) {
  const Point a{10.3, 12.1}, b{81.2, 47.9};
  Canvas line(100, 100, kNothing);
  line.stroke({a, b}, 3, false, kWhite);
  EXPECT_NEAR(ink(line), 3 * distance(a, b) + 3.14159 * 1.5 * 1.5, 1);
  Canvas there_and_back(100, 100, kNothing);
  there_and_back.stroke({a, b, a, b}, 3, false, kWhite);
  EXPECT_EQ(there_and_back.pixels(), line.pixels());
  Canvas closed(100, 100, kNothing), open(100, 100, kNothing);
  closed.stroke(rectangle(10, 10, 60, 40), 2, true, kWhite);
  open.stroke({{10, 10}, {70, 10}, {70, 50}, {10, 50}, {10, 10}}, 2, false, kWhite);
  EXPECT_EQ(closed.pixels(), open.pixels());
  Canvas disc(100, 100, kNothing);
  disc.disc({50.2, 49.9}, 20, kWhite);
  EXPECT_NEAR(ink(disc), 3.14159 * 400, 8);
  Canvas cross(100, 100, kNothing);
  cross.cross({50, 50}, 10, 4, kWhite);
  EXPECT_NEAR(ink(cross), 2 * 20 * 4 - 16, 0.1);
}

TEST(FigureCanvas, ArrowsReachFromTailToHead) {
  Canvas canvas(100, 100, kNothing);
  canvas.arrow({10, 50}, {80, 50}, 4, kWhite);
  // A shaft of 54 × 4 and a point 16 long and 14.4 wide.
  EXPECT_NEAR(ink(canvas), 54 * 4 + 0.5 * 16 * 14.4, 0.5);
  EXPECT_NEAR(canvas.pixels().at(10, 50).a, 1, 1e-5);
  EXPECT_EQ(canvas.pixels().at(9, 50).a, 0);
  EXPECT_GT(canvas.pixels().at(79, 50).a, 0.1);
  EXPECT_EQ(canvas.pixels().at(80, 50).a, 0);
  EXPECT_GT(canvas.pixels().at(65, 45).a, 0.9);
  EXPECT_EQ(canvas.pixels().at(60, 45).a, 0);
}

TEST(FigureCanvas, ColoursMixByAlpha) {
  Canvas canvas(4, 4, {1, 0, 0, 1});
  canvas.rectangle(0, 0, 4, 4, {0, 1, 0, 0.25f});
  EXPECT_NEAR(canvas.pixels().at(1, 1).r, 0.75, 1e-6);
  EXPECT_NEAR(canvas.pixels().at(1, 1).g, 0.25, 1e-6);
  EXPECT_EQ(canvas.pixels().at(1, 1).a, 1);
  Canvas empty(4, 4, kNothing);
  empty.rectangle(0, 0, 4, 4, {0, 1, 0, 0.25f});
  EXPECT_EQ(empty.pixels().at(1, 1), (Rgba{0, 1, 0, 0.25f}));
  empty.fill(rectangle(0, 0, 4, 4), {1, 0, 0, 1}, Canvas::Mix::kAtop);
  EXPECT_EQ(empty.pixels().at(1, 1), (Rgba{1, 0, 0, 0.25f}));
  EXPECT_EQ(color_of(0x3380FF, 0.5), (Rgba{0.2f, 128 / 255.0f, 1, 0.5f}));
}

std::filesystem::path font_file(const std::string& name) {
  return std::filesystem::path(OVERSKETCH_SOURCE_DIR) / "assets" / "fonts" / name;
}

TEST(FigureFont, RefusesWhatIsNoFont) {
  const TempFolder folder;
  EXPECT_EQ(Font::load(folder / "none.otf").error().code, "file.missing");
  for (const std::string& text : {std::string(), std::string("OTTO"), std::string(5000, 'x'), std::string(200, '\0')}) {
    folder.write("font.otf", text);
    EXPECT_EQ(Font::load(folder / "font.otf").error().code, "font.unreadable") << text.size();
  }
}

TEST(FigureFont, WidthsAddUpButForKerning) {
  for (const char* name : {"Inter-Regular.otf", "Inter-SemiBold.otf"}) {
    const auto font = Font::load(font_file(name));
    ASSERT_TRUE(font.ok()) << to_string(font.error());
    EXPECT_EQ(font->width("", 20), 0);
    EXPECT_GT(font->width("i", 20), 0);
    EXPECT_GT(font->width("m", 20), 2 * font->width("i", 20));
    EXPECT_NEAR(font->width("mm nn", 40), 2 * font->width("mm nn", 20), 1e-4);
    EXPECT_NEAR(font->width("nnnn", 20), 4 * font->width("n", 20), 1e-4);
    EXPECT_LT(font->width("AV", 20), font->width("A", 20) + font->width("V", 20));
    // Each is a letter of the font: none has the width of what stands for a missing one and looks like it.
    for (const char* letter : {"σ", "ω", "×", "∞", "₁", "₂", "°", "−"})
      EXPECT_NE(font->outlines(letter, 20, {0, 0}), font->outlines("\U0010FFFD", 20, {0, 0})) << letter;
  }
}

TEST(FigureFont, LettersStandOnTheBaseline) {
  const auto font = Font::load(font_file("Inter-Regular.otf"));
  ASSERT_TRUE(font.ok()) << to_string(font.error());
  const auto box_of = [&](const char* text) {
    Box box;
    for (const Points& ring : font->outlines(text, 100, {7, 200}))
      for (const Point p : ring)
        box.add(p);
    return box;
  };
  const Box h = box_of("H");
  EXPECT_NEAR(h.high.y, 200, 0.5);
  EXPECT_NEAR(h.size().y, 72.7, 1); // the typeface's cap height
  EXPECT_GT(h.low.x, 7);
  EXPECT_LT(h.high.x, 7 + font->width("H", 100));
  EXPECT_GT(box_of("p").high.y, 210);
  EXPECT_GT(box_of("HH").high.x, h.high.x + 0.9 * font->width("H", 100));
  // A letter o has a hole, which is wound the other way.
  const auto o = font->outlines("o", 100, {0, 0});
  ASSERT_EQ(o.size(), 2u);
  EXPECT_LT(signed_area(o[0]) * signed_area(o[1]), 0);
  // It is its own mirror image, curves included.
  for (const Points& ring : o) {
    const ClosedCurve curve(ring);
    const double middle = bounds(ring).centre().x;
    for (const Point p : ring)
      EXPECT_LT(curve.nearest({2 * middle - p.x, p.y}).distance, 0.25);
  }
  EXPECT_TRUE(font->outlines(" ", 100, {0, 0}).empty());
}

TEST(FigureFont, BytesThatAreNoTextShowAsSuch) {
  const auto font = Font::load(font_file("Inter-Regular.otf"));
  ASSERT_TRUE(font.ok()) << to_string(font.error());
  const double mark = font->width("\uFFFD", 20);
  for (const char* bytes : {"\x80", "\xFF", "\xC3", "\xC0"})
    EXPECT_NEAR(font->width(bytes, 20), mark, 1e-6) << bytes;
  EXPECT_NEAR(font->width("\xE2\x82", 20), 2 * mark, 0.5);
  EXPECT_NEAR(font->width("\xC3\xC3", 20), 2 * mark, 0.5);
  EXPECT_NEAR(font->width("\xE2\x82m", 20), 2 * mark + font->width("m", 20), 0.5);
  EXPECT_NE(font->width("é", 20), font->width("\xC3", 20) + font->width("\xA9", 20));
}

} // namespace
} // namespace oversketch::cli
