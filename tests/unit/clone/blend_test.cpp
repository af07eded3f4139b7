#include "core/clone/blend.h"
#include "core/clone/domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace oversketch {
namespace {

TEST(Blend, RefusesNumbersOutOfRangeAndUnknownNames) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {-0.01, 1.01, nan, inf, -inf}) {
    BlendOptions options;
    options.strength = bad;
    EXPECT_EQ(check_options(options).error().where, "strength");
    options = {};
    options.opacity = bad;
    EXPECT_EQ(check_options(options).error().where, "opacity");
    options = {};
    options.average = bad;
    EXPECT_EQ(check_options(options).error().where, "average");
  }
  for (const double bad : {-1.0, nan, inf}) {
    BlendOptions options;
    options.feather_px = bad;
    EXPECT_EQ(check_options(options).error().code, "clone.bad-option");
    EXPECT_EQ(check_options(options).error().where, "feather_px");
  }
  EXPECT_TRUE(check_options({}).ok());
  EXPECT_EQ(parse_blend_mode("").error().code, "clone.unknown-mode");
  EXPECT_EQ(parse_domain("Linear").error().code, "clone.unknown-domain");
  EXPECT_NE(parse_blend_mode("mixd").error().sentence.find("\"mixed\""), std::string::npos);
}

TEST(Blend, NamesAreReadBack) {
  for (const char* name : {"import", "mixed", "monochrome", "average", "none"})
    EXPECT_EQ(to_string(*parse_blend_mode(name)), name);
  for (const char* name : {"encoded", "linear", "log"})
    EXPECT_EQ(to_string(*parse_domain(name)), name);
  EXPECT_EQ(*parse_blend_mode("import"), BlendMode::kImport);
  EXPECT_EQ(*parse_blend_mode("none"), BlendMode::kNone);
  EXPECT_EQ(*parse_domain("log"), Domain::kLog);
}

TEST(Domain, GoesThereAndBack) {
  for (const Domain domain : {Domain::kEncoded, Domain::kLinear, Domain::kLog}) {
    double before = -HUGE_VAL;
    for (int i = -300; i <= 1200; ++i) {
      const auto x = static_cast<float>(i) / 255;
      const Channels there = to_domain({x, -x, x / 3, 1}, domain);
      const Channels back = from_domain(there, domain);
      EXPECT_NEAR(back.v[0], x, 1e-9);
      EXPECT_EQ(back.v[1], -back.v[0]);
      EXPECT_NEAR(back.v[2], x / 3, 1e-9);
      EXPECT_EQ(there.v[3], 0);
      EXPECT_GT(there.v[0], before);
      before = there.v[0];
    }
  }
}

TEST(Domain, KnownValues) {
  // sRGB (IEC 61966-2-1): level 128 is 0.2158605 in linear light.
  EXPECT_NEAR(to_domain({128.0F / 255, 0, 1, 1}, Domain::kLinear).v[0], 0.2158605, 1e-6);
  EXPECT_EQ(to_domain({0, 0, 1, 1}, Domain::kLinear).v[2], 1);
  // A ratio is a difference: x + ε doubled adds ln 2.
  const float x = 0.2F;
  const auto doubled = static_cast<float>(2 * (x + kLogEpsilon) - kLogEpsilon);
  EXPECT_NEAR(to_domain({doubled, 0, 0, 1}, Domain::kLog).v[0] - to_domain({x, 0, 0, 1}, Domain::kLog).v[0],
              std::log(2.0), 1e-6);
}

TEST(Domain, SlopeBoundHolds) {
  for (const Domain domain : {Domain::kEncoded, Domain::kLinear, Domain::kLog})
    for (int i = 0; i <= 500; ++i) {
      const auto x = static_cast<float>(i) / 255;
      Channels y = to_domain({x, 0, 0, 1}, domain);
      const double low = from_domain(y, domain).v[0];
      y.v[0] += 1e-7;
      EXPECT_LE(from_domain(y, domain).v[0] - low, 1e-7 * largest_slope(domain, x) * (1 + 1e-6) + 1e-15);
    }
}

} // namespace
} // namespace oversketch
