#include "base/id.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "base/expected.h"
#include "base/units.h"

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

TEST(Units, LiteralsAndMakersAreSi) {
  using namespace literals;
  EXPECT_DOUBLE_EQ(degrees(180).value, 3.141592653589793);
  EXPECT_EQ(centimetres(30), 0.3_m);
}

}  // namespace
}  // namespace swarmsmith
