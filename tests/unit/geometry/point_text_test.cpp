#include "core/geometry/point_text.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

TEST(PointText, TellsAPlaceToATenth) {
  EXPECT_EQ(point_text({12.34, -5}), "(12.3, -5.0)");
  EXPECT_EQ(point_text({-0.04, 0.04}), "(0.0, 0.0)");
  EXPECT_EQ(point_text({1048575.96, 7}), "(1048576.0, 7.0)");
}

TEST(PointText, IsShortForPlacesOutOfReach) {
  EXPECT_EQ(point_text({1e30, 0}), "(1e+30, 0)");
  EXPECT_EQ(point_text({2.5, -1.23456e8}), "(2.5, -1.235e+08)");
}

} // namespace
} // namespace oversketch
