#include "core/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace oversketch {
namespace {

Result<int> half_of(int value) {
  if (value % 2 != 0) return Error{"odd", "give an even number", "value 3"};
  return value / 2;
}

TEST(ResultTest, ReadingWhatIsNotThereIsABug) {
  const Result<int> bad = half_of(3), good = half_of(4);
  EXPECT_THROW(static_cast<void>(bad.value()), BugError);
  EXPECT_THROW(static_cast<void>(*bad), BugError);
  EXPECT_THROW(static_cast<void>(good.error()), BugError);
  EXPECT_THROW(static_cast<void>(Result<void>().error()), BugError);
  const Result<std::string> text(Error{"e", "s", "w"});
  EXPECT_THROW(static_cast<void>(text->size()), BugError);
}

TEST(ResultTest, HoldsAValueOrAnError) {
  const Result<int> good = half_of(4), bad = half_of(3);
  ASSERT_TRUE(good.ok());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_EQ(*good, 2);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error(), (Error{"odd", "give an even number", "value 3"}));
  EXPECT_TRUE(Result<void>().ok());
  EXPECT_FALSE(Result<void>(Error{"a", "b", "c"}).ok());
}

TEST(ResultTest, MovesItsValueOut) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 7);
  Result<std::vector<int>> list(std::vector<int>{1, 2});
  list->push_back(3);
  EXPECT_EQ(list.value(), (std::vector<int>{1, 2, 3}));
}

TEST(ErrorTest, PrintsCodePlaceAndSentence) {
  EXPECT_EQ(to_string(Error{"a.b", "do this", "here"}), "a.b: here: do this");
  EXPECT_EQ(to_string(Error{"a.b", "do this", ""}), "a.b: do this");
}

TEST(ErrorTest, PutsTheOuterPlaceFirst) {
  EXPECT_EQ(at("file:3", Error{"c", "s", ""}).where, "file:3");
  EXPECT_EQ(at("file:3", Error{"c", "s", "layer L1"}).where, "file:3: layer L1");
}

TEST(CheckTest, SaysWhatWhyAndWhere) {
  EXPECT_NO_THROW(CHECK(1 + 1 == 2, "sums"));
  try {
    CHECK(1 + 1 == 3, "sums add up");
    FAIL() << "nothing thrown";
  } catch (const BugError& bug) {
    const std::string text = bug.what();
    EXPECT_NE(text.find("result_test.cpp:"), std::string::npos);
    EXPECT_NE(text.find("sums add up"), std::string::npos);
    EXPECT_NE(text.find("1 + 1 == 3"), std::string::npos);
  }
}

TEST(CheckTest, EvaluatesItsConditionOnce) {
  int count = 0;
  CHECK(++count == 1, "once");
  EXPECT_EQ(count, 1);
}

} // namespace
} // namespace oversketch
