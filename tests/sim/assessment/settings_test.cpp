#include "sim/assessment/internal/settings.h"

#include <gtest/gtest.h>

#include "base/math.h"
#include "sim/assessment/internal/contact.h"

namespace swarmsmith::assessment {
namespace {

TEST(StartsInAGroup, AreHalfAMetreToSevenTenthsApartAroundTheCentre) {
  for (int seed = 1; seed <= 100; ++seed) {
    const std::vector<Pose> starts = starts_in_a_group(rvr(), seed);
    ASSERT_EQ(starts.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose& a = starts[i];
      const Pose& b = starts[(i + 1) % 3];
      EXPECT_LT(hypot(a.x, a.y), 0.41);
      EXPECT_GE(hypot(a.x - b.x, a.y - b.y), 0.5);
      EXPECT_LE(hypot(a.x - b.x, a.y - b.y), 0.7);
    }
    EXPECT_FALSE(any_contact(rvr().body.outline, starts, dodecagon_of_the_thesis()));
  }
  EXPECT_NE(starts_in_a_group(rvr(), 1), starts_in_a_group(rvr(), 2));
  EXPECT_EQ(starts_in_a_group(rvr(), 1), starts_in_a_group(rvr(), 1));
}

TEST(StartsInAGroup, OfRobotsThatSeeLessFarAreNearer) {
  Robot robot = rvr();
  robot.neighbours.range_m = 0.375;
  const std::vector<Pose> starts = starts_in_a_group(robot, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose& a = starts[i];
    const Pose& b = starts[(i + 1) % 3];
    EXPECT_GE(hypot(a.x - b.x, a.y - b.y), 0.25);
    EXPECT_LE(hypot(a.x - b.x, a.y - b.y), 0.35);
  }
  robot.neighbours.range_m = 10;
  EXPECT_EQ(starts_in_a_group(robot, 1), starts_in_a_group(rvr(), 1));
}

TEST(RangeText, IsOneNumberWhereBothEndsReadAlike) {
  EXPECT_EQ(range_text({3, 1, 2}, 0), "1 to 3");
  EXPECT_EQ(range_text({0.501, 0.499}, 1), "0.5");
}

}  // namespace
}  // namespace swarmsmith::assessment
