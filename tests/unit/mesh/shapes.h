#pragma once

#include "core/geometry/point.h"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace oversketch::shapes {

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Radius varies freely from point to point.
inline Points star(Random& random, int count, double least, double most) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(to_point(std::polar(uniform(random, least, most), 2 * std::numbers::pi * i / count)));
  return points;
}

/// A disc whose edge goes in and out by `depth` between neighbouring points.
inline Points zigzag(int teeth, double radius, double depth) {
  Points points;
  for (int i = 0; i < 2 * teeth; ++i)
    points.push_back(to_point(std::polar(radius - (i % 2) * depth, std::numbers::pi * i / teeth)));
  return points;
}

inline Points comb(Random& random, int teeth, double length) {
  Points points{{0, -20}};
  double x = 0;
  for (int i = 0; i < teeth; ++i) {
    const double tooth = uniform(random, 0.5, 9), gap = uniform(random, 0.01, 5);
    points.push_back({x, uniform(random, 0.3, 1) * length});
    points.push_back({x + tooth, uniform(random, 0.3, 1) * length});
    points.push_back({x + tooth, 0});
    x += tooth + gap;
    points.push_back({x, 0});
  }
  points.push_back({x, -20});
  return points;
}

/// A band that winds inwards, `gap` apart from itself.
inline Points spiral(double turns, double width, double gap) {
  Points outer, inner;
  for (double t = 0; t <= turns * 2 * std::numbers::pi; t += 0.05) {
    const double radius = 15 + (width + gap) * t / (2 * std::numbers::pi);
    outer.push_back(to_point(std::polar(radius + width, t)));
    inner.push_back(to_point(std::polar(radius, t)));
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

/// A rectangle with a slit from the middle of its upper side nearly to the lower one: a hairpin.
inline Points slit(double width, double height, double slit_width, double at_x) {
  return {{0, 0},     {at_x, 0},       {at_x, height - 13}, {at_x + slit_width, height - 13}, {at_x + slit_width, 0},
          {width, 0}, {width, height}, {0, height}};
}

/// The way round the cells of a maze without loops: `nodes` × `nodes` rooms joined by corridors, walls as wide as
/// corridors. Vertices at whole coordinates, every unit step a point.
inline Points maze(Random& random, int nodes) {
  const int n = 2 * nodes - 1;
  std::vector<std::vector<bool>> open(n, std::vector<bool>(n, false));
  std::vector<std::pair<int, int>> path{{0, 0}};
  open[0][0] = true;
  while (!path.empty()) {
    const auto [x, y] = path.back();
    std::vector<std::pair<int, int>> ways;
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      const int to_x = x + 2 * dx, to_y = y + 2 * dy;
      if (to_x >= 0 && to_x < n && to_y >= 0 && to_y < n && !open[to_y][to_x]) ways.emplace_back(dx, dy);
    }
    if (ways.empty()) {
      path.pop_back();
      continue;
    }
    const auto [dx, dy] = ways[random() % ways.size()];
    open[y + dy][x + dx] = open[y + 2 * dy][x + 2 * dx] = true;
    path.emplace_back(x + 2 * dx, y + 2 * dy);
  }
  const auto is_open = [&](int x, int y) { return x >= 0 && y >= 0 && x < n && y < n && open[y][x]; };
  std::map<std::pair<int, int>, std::pair<int, int>> next;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      if (!is_open(x, y)) continue;
      if (!is_open(x, y - 1)) next[{x, y}] = {x + 1, y};
      if (!is_open(x + 1, y)) next[{x + 1, y}] = {x + 1, y + 1};
      if (!is_open(x, y + 1)) next[{x + 1, y + 1}] = {x, y + 1};
      if (!is_open(x - 1, y)) next[{x, y + 1}] = {x, y};
    }
  Points points;
  std::pair<int, int> at{0, 0};
  do {
    points.push_back({static_cast<double>(at.first), static_cast<double>(at.second)});
    at = next.at(at);
  } while (at != std::pair{0, 0});
  return points;
}

/// Moves the outermost sides outwards, so that a grid centred on the box has its lines on the other vertices.
inline Points stretched(Points points, double low_by, double high_by) {
  const Box box = bounds(points);
  for (Point& p : points) {
    if (p.x == box.low.x) p.x -= low_by;
    if (p.y == box.low.y) p.y -= low_by;
    if (p.x == box.high.x) p.x += high_by;
    if (p.y == box.high.y) p.y += high_by;
  }
  return points;
}

inline Points scaled(Points points, double factor, Point offset = {}) {
  for (Point& p : points)
    p = factor * p + offset;
  return points;
}

inline Points turned_by(const Points& points, double angle) {
  return transformed(points, {std::polar(1.0, angle), 0});
}

struct Case {
  std::string name;
  Points outline;
  double cell = 10;
};

/// Simple outlines of many kinds.  In the ones called "on the grid" vertices lie on grid lines and grid corners to the
/// bit.
inline std::vector<Case> cases() {
  Random random(1);
  std::vector<Case> all;
  for (int i = 0; i < 6; ++i) {
    all.push_back({"star " + std::to_string(i), star(random, 5 + 40 * i, 20, 120), 10});
    all.push_back({"comb " + std::to_string(i), turned_by(comb(random, 6 + i, 90), 0.3 * i), 7});
    all.push_back({"maze " + std::to_string(i), turned_by(scaled(maze(random, 5), 4 + 2 * i), 0.2 * i), 10});
    all.push_back({"maze on the grid " + std::to_string(i), scaled(stretched(maze(random, 3 + i), 0.5, 0.5), 8), 8});
    all.push_back(
        {"maze on the coarse grid " + std::to_string(i), scaled(stretched(maze(random, 3 + i), 1, 0), 8), 16});
  }
  for (const int teeth : {20, 100, 600})
    all.push_back({"zigzag " + std::to_string(teeth), zigzag(teeth, 100, 9), 10});
  all.push_back({"spiral", spiral(4, 6, 1.5), 10});
  all.push_back({"fine spiral", spiral(9, 1, 0.2), 10});
  for (const double width : {3.0, 0.01, 1e-9})
    all.push_back({"slit " + std::to_string(width), slit(60, 100, width, 31.7), 10});
  all.push_back({"slit on the grid", slit(80, 80, 1e-12, 35), 10});
  // Lines at −5, 5, 15 …: the sides and the diagonals pass through grid corners.
  all.push_back({"steps on the grid",
                 {{0, 0}, {80, 0}, {80, 35}, {65, 35}, {65, 55}, {45, 55}, {45, 75}, {25, 75}, {25, 80}, {0, 80}},
                 10});
  all.push_back(
      {"diagonals on the grid", {{0, 35}, {35, 0}, {45, 0}, {80, 35}, {80, 45}, {45, 80}, {35, 80}, {0, 45}}, 10});
  all.push_back({"fan on a corner", {{0, 0}, {80, 0}, {80, 80}, {35, 35}, {0, 80}}, 10});
  all.push_back({"point on a line", {{0, 0}, {80, 0}, {80, 80}, {35, 42}, {0, 80}}, 10});
  all.push_back({"point on a line from above", {{0, 0}, {35, 38}, {80, 0}, {80, 80}, {0, 80}}, 10});
  all.push_back({"bow tie on a corner", {{0, 0}, {35, 34.5}, {80, 0}, {80, 80}, {35, 35.5}, {0, 80}}, 10});
  // The sides of the needles are one rounding apart where they begin and meet at their tips.
  Points needles{{0, 0}};
  for (int i = 1; i < 12; ++i) {
    const double x = 6.1 * i;
    const Point tip{x + uniform(random, -2.5, 2.5), -120.0 + i};
    needles.insert(needles.end(), {{x, 0}, tip, {std::nextafter(x, 100), 0}});
  }
  needles.insert(needles.end(), {{80, 0}, {80, 50}, {0, 50}});
  all.push_back({"needles", needles, 10});
  all.push_back({"needles lying", turned_by(needles, std::numbers::pi / 2), 10});
  all.push_back({"bar thinner than a cell", {{0, 0}, {200, 3}, {200, 5}, {0, 2}}, 10});
  all.push_back({"one cell high", {{0, 0}, {12, 0}, {12, 1}, {0, 1}}, 12});
  all.push_back({"far away", scaled(star(random, 50, 20, 120), 1, {900'000.3, -700'000.7}), 10});
  return all;
}

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

/// A name for GoogleTest: letters and digits alone, and different for each.
inline std::string name_of(const testing::TestParamInfo<Case>& test) {
  std::string name = test.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name + "_" + std::to_string(test.index);
}

} // namespace oversketch::shapes
