#include "core/base/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace oversketch {
namespace {

TEST(HashTest, MatchesTheReferenceOfXxh3) {
  // Reference values of XXH3 with 128 bits and seed 0.
  EXPECT_EQ(to_string(Hasher().finish()), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(to_string(Hasher().add_bytes("a", 1).finish()), "a96faf705af16834e6c632b61e964e1f");
  EXPECT_EQ(to_string(Hasher().add_bytes("abc", 3).finish()), "06b05ab6733a618578af5f94892f3950");
}

TEST(HashTest, PrintsHighThenLow) {
  EXPECT_EQ(to_string(Hash{0xf, 0x123456789abcdef0ULL}), "123456789abcdef0000000000000000f");
}

TEST(HashTest, PiecesOfBytesMakeTheSameHashAsTheWhole) {
  const std::string text(1000, 'x');
  const Hash whole = Hasher().add_bytes(text.data(), text.size()).finish();
  EXPECT_EQ(Hasher().add_bytes(text.data(), 313).add_bytes(text.data(), 0).add_bytes(text.data(), 687).finish(), whole);
}

TEST(HashTest, TellsApartWhatDiffers) {
  const std::vector<Hash> all{
      Hasher().add("ab").add("c").finish(),
      Hasher().add("a").add("bc").finish(),
      Hasher().add("abc").finish(),
      Hasher().add("").add("abc").finish(),
      Hasher().add(1).finish(),
      Hasher().add(1LL).finish(),
      Hasher().add(0.0).finish(),
      Hasher().add(-0.0).finish(),
      Hasher().add(1).add(2).finish(),
      Hasher().add(2).add(1).finish(),
      Hasher().add(std::span<const int>(std::array{1, 2})).finish(),
      Hasher().add(std::span<const int>(std::array{1})).add(2).finish(),
      Hasher().add(Hash{1, 2}).finish(),
      Hasher().add(Hash{2, 1}).finish(),
  };
  EXPECT_EQ(std::set<Hash>(all.begin(), all.end()).size(), all.size());
  EXPECT_EQ(std::unordered_set<Hash>(all.begin(), all.end()).size(), all.size());
}

TEST(HashTest, FinishingChangesNothing) {
  Hasher hasher;
  hasher.add("a");
  const Hash first = hasher.finish();
  EXPECT_EQ(hasher.finish(), first);
  hasher.add("b");
  EXPECT_EQ(hasher.finish(), Hasher().add("a").add("b").finish());
}

} // namespace
} // namespace oversketch
