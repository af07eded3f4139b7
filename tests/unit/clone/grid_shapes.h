#pragma once

#include "tests/unit/clone/clone_support.h"

#include <string>

namespace oversketch {

struct NamedMask {
  std::string name;
  Mask mask;
};

/// A band about `width` px wide along a wave.
inline Mask wave_mask(int width) {
  return mask_where({0, 0, 420, 200}, [&](int x, int y) {
    for (int step = -20; step <= 20; ++step) {
      const double at = x + step;
      if (at < 10 || at > 400) continue;
      if (std::hypot(step, 100 + 75 * std::sin(at / 22) - y) < width / 2.0) return true;
    }
    return false;
  });
}

/// Whole ones, on which coarse grids see all there is.
inline std::vector<NamedMask> plain_masks() {
  return {{"disc", disc_mask(-3, 8, 60)},
          {"rectangle", rect_mask({-20, -31, 130, 87})},
          {"wave 7", wave_mask(7)},
          {"wave 13", wave_mask(13)},
          {"diagonal", mask_where({0, 0, 200, 200}, [](int x, int y) { return std::abs(x - y) < 9; })}};
}

/// Ones with what coarse grids see badly or not at all.
inline std::vector<NamedMask> tricky_masks() {
  return {{"ring", ring_mask(3, 3, 115, 67)},
          {"thin ring", ring_mask(-40, 3, 115, 111)},
          {"comb", mask_where({0, 0, 200, 150}, [](int x, int y) { return y < 40 || x % 20 < 19; })},
          {"slit", mask_where({0, 0, 150, 150}, [](int x, int y) { return x != 75 || y < 40; })},
          {"dashes", mask_where({0, 0, 150, 150}, [](int x, int y) { return x != y || x % 40 < 10; })},
          {"holes 4", holed_mask(150, 30, 4)},
          {"holes 1", holed_mask(150, 19, 0)},
          {"holes on the grid", holed_mask(150, 16, 0)},
          {"islands", mask_where({0, 0, 300, 300}, [](int x, int y) { return x % 6 < 5 && y % 7 < 5; })},
          {"grains", mask_where({0, 0, 90, 90}, [](int x, int y) { return x % 2 == 0 && y % 2 == 0; })},
          {"chessboard", mask_where({0, 0, 70, 70}, [](int x, int y) { return (x + y) % 2 == 0; })},
          {"lattice", mask_where({1, 1, 90, 90}, [](int x, int y) { return x % 2 == 0 || y % 2 == 0; })},
          {"noise 0.5", random_mask({-5, -5, 120, 130}, 0.5, 1)},
          {"noise 0.8", random_mask({-5, -5, 120, 130}, 0.8, 2)},
          {"noise 0.97", random_mask({-5, -5, 120, 130}, 0.97, 3)}};
}

/// Ones that a small matrix or plain relaxation does.
inline std::vector<NamedMask> small_masks() {
  std::vector<Mask::Run> far = {{-900'000, -900'000, -899'950}, {900'000, 900'000, 900'003}, {7, 900'000, 900'001}};
  return {{"pixel", rect_mask({5, -3, 1, 1})},
          {"row", rect_mask({0, 0, 1000, 1})},
          {"column", rect_mask({0, 0, 1, 1000})},
          {"block", rect_mask({-20, -20, 17, 23})},
          {"far apart", Mask(far)}};
}

inline std::vector<NamedMask> all_masks() {
  std::vector<NamedMask> all = plain_masks();
  for (auto&& some : {tricky_masks(), small_masks()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

} // namespace oversketch
