#include "sim/assessment/internal/settings.h"

#include <gtest/gtest.h>

#include "base/math.h"
#include "sim/assessment/internal/contact.h"

namespace swarmsmith::assessment {
namespace {

TEST(StartsInAGroup, AreHalfAMetreToSevenTenthsApartAroundTheCentre) {
  for (int seed = 1; seed <= 100; ++seed) {
    const std::vector<Pose> starts = starts_in_a_group(seed);
    ASSERT_EQ(starts.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose& a = starts[i];
      const Pose& b = starts[(i + 1) % 3];
      EXPECT_LT(hypot(a.x, a.y), 0.41);
      EXPECT_GE(hypot(a.x - b.x, a.y - b.y), 0.5);
      EXPECT_LE(hypot(a.x - b.x, a.y - b.y), 0.7);
    }
    EXPECT_FALSE(any_contact(starts, dodecagon_of_the_thesis()));
  }
  EXPECT_NE(starts_in_a_group(1), starts_in_a_group(2));
  EXPECT_EQ(starts_in_a_group(1), starts_in_a_group(1));
}

TEST(RangeText, IsOneNumberWhereBothEndsReadAlike) {
  EXPECT_EQ(range_text({3, 1, 2}, 0), "1 to 3");
  EXPECT_EQ(range_text({0.501, 0.499}, 1), "0.5");
}

}  // namespace
}  // namespace swarmsmith::assessment
