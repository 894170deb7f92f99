#include "base/id.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "base/expected.h"

namespace swarmsmith {
namespace {

TEST(Id, IsPrintedWithItsLetter) {
  EXPECT_EQ(to_string(CandidateId{812}), "c812");
  EXPECT_EQ(to_string(DesignId{3}), "d3");
  EXPECT_FALSE(CandidateId{});
  static_assert(!std::is_convertible_v<CandidateId, DesignId>);
}

TEST(Error, SaysWhereWhenItKnows) {
  EXPECT_EQ(to_string(Error{ErrorKind::BadInput, "unknown key", "a.toml:3:1"}),
            "a.toml:3:1: unknown key");
  EXPECT_EQ(to_string(Error{ErrorKind::BadInput, "unknown key", ""}), "unknown key");
}

}  // namespace
}  // namespace swarmsmith
