#include "core/session/content_cache.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

namespace oversketch {
namespace {

Hash key(int number) {
  return {static_cast<std::uint64_t>(number), 0};
}

TEST(ContentCache, TheLeastRecentlyUsedGoesFirst) {
  ContentCache<int> cache(2);
  cache.put(key(1), std::make_shared<const int>(1));
  cache.put(key(2), std::make_shared<const int>(2));
  EXPECT_EQ(*cache.find(key(1)), 1);
  cache.put(key(3), std::make_shared<const int>(3));
  EXPECT_EQ(cache.find(key(2)), nullptr);
  EXPECT_EQ(*cache.find(key(1)), 1);
}

TEST(ContentCache, DropsEarlyWhatGoesNextAndNobodyUses) {
  ContentCache<int> cache(2);
  EXPECT_EQ(cache.drop_last(), nullptr);
  cache.put(key(1), std::make_shared<const int>(1));
  EXPECT_EQ(cache.drop_last(), nullptr);
  auto held = cache.put(key(2), std::make_shared<const int>(2));
  EXPECT_EQ(*cache.drop_last(), 1);
  cache.put(key(3), std::make_shared<const int>(3));
  EXPECT_EQ(cache.drop_last(), nullptr);
  EXPECT_NE(cache.find(key(2)), nullptr);
  cache.put(key(4), std::make_shared<const int>(4));
  EXPECT_EQ(cache.find(key(3)), nullptr);
  held = nullptr;
  EXPECT_EQ(*cache.drop_last(), 2);
  EXPECT_EQ(cache.find(key(2)), nullptr);
}

} // namespace
} // namespace oversketch
