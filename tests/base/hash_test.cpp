#include "base/hash.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(Digest, DependsOnOrderLengthAndSign) {
  const auto of = [](auto... parts) {
    Digest digest;
    (digest.add(parts), ...);
    return digest.hex();
  };
  EXPECT_EQ(of("ab", "c"), of("ab", "c"));
  EXPECT_NE(of("ab", "c"), of("a", "bc"));
  EXPECT_NE(of(std::int64_t{1}, std::int64_t{2}), of(std::int64_t{2}, std::int64_t{1}));
  EXPECT_NE(of(0.0), of(-0.0));
  EXPECT_NE(of(""), of());
  EXPECT_EQ(of("x").size(), 32U);
}

}  // namespace
}  // namespace swarmsmith
