#include "core/base/bulk_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace oversketch {
namespace {

TEST(BulkAllocator, HoldsFewValuesAndMany) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{3} << 20}) {
    std::vector<float, BulkAllocator<float>> values(count, 1.5F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % 64, 0u);
    auto copy = values;
    copy.resize(count + 5);
    EXPECT_EQ(std::count(copy.begin(), copy.begin() + static_cast<std::ptrdiff_t>(count), 1.5F),
              static_cast<std::ptrdiff_t>(count));
  }
}

TEST(BulkAllocator, RefusesWhatNoMemoryHolds) {
  BulkAllocator<double> allocator;
  EXPECT_THROW((void)allocator.allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

} // namespace
} // namespace oversketch
