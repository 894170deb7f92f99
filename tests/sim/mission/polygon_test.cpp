#include "sim/mission/polygon.h"

#include <cmath>

#include "base/math.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

const std::vector<Point> kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
/// An L of three unit squares.
const std::vector<Point> kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(Polygon, HasItsAreaAndCentre) {
  EXPECT_EQ(signed_area(kSquare), 4);
  EXPECT_EQ(signed_area(kL), 3);
  EXPECT_EQ(signed_area(std::vector<Point>(kL.rbegin(), kL.rend())), -3);
  EXPECT_EQ(centroid(kSquare), (Point{1, 1}));
  // Mean of the three squares' centres.
  EXPECT_NEAR(centroid(kL).x, 5.0 / 6, 1e-15);
  EXPECT_NEAR(centroid(kL).y, 5.0 / 6, 1e-15);
}

TEST(Polygon, KnowsWhatIsWithin) {
  EXPECT_TRUE(is_within(kL, {0.5, 1.9}));
  EXPECT_TRUE(is_within(kL, {1.9, 0.5}));
  EXPECT_FALSE(is_within(kL, {1.5, 1.5}));
  EXPECT_FALSE(is_within(kL, {-0.1, 1}));
  EXPECT_FALSE(is_within(kL, {0.5, 2.1}));
}

TEST(Polygon, KnowsWhetherItIsConvex) {
  EXPECT_TRUE(is_convex(kSquare));
  EXPECT_FALSE(is_convex(kL));
  EXPECT_TRUE(is_convex(std::vector<Point>{{0, 0}, {1, 0}, {2, 0}, {0, 2}}));
}

TEST(Polygon, WithoutFlawHasNone) {
  EXPECT_EQ(flaw_of(kSquare), std::nullopt);
  EXPECT_EQ(flaw_of(kL), std::nullopt);
  EXPECT_EQ(flaw_of(std::vector<Point>(kL.rbegin(), kL.rend())), std::nullopt);
}

TEST(Polygon, FlawsAreNamed) {
  const auto flaw = [](std::vector<Point> corners) { return flaw_of(corners).value_or(""); };
  EXPECT_THAT(flaw({{0, 0}, {1, 0}}), HasSubstr("at least 3"));
  EXPECT_THAT(flaw({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), HasSubstr("side 1, from (0, 0), crosses"));
  // Touches: a corner on another side.
  EXPECT_THAT(flaw({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}), HasSubstr("crosses or touches"));
  EXPECT_THAT(flaw({{0, 0}, {1, 0}, {1, 1}, {0, 0}, {-1, 1}}), HasSubstr("corners 1 and 4"));
  EXPECT_THAT(flaw({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), HasSubstr("turns back on itself"));
  EXPECT_THAT(flaw({{0, 0}, {1e-4, 0}, {0, 1e-4}}), HasSubstr("no area"));
}

TEST(RegularPolygon, IsCircumscribedAboutItsCircle) {
  for (const int sides : {3, 4, 5, 7, 12, 60}) {
    const std::vector<Point> corners = regular_polygon(sides, 1.5);
    ASSERT_EQ(corners.size(), static_cast<std::size_t>(sides));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point from = corners[i];
      const Point to = corners[(i + 1) % corners.size()];
      EXPECT_NEAR(std::hypot((from.x + to.x) / 2, (from.y + to.y) / 2), 1.5, 1e-14);
      EXPECT_NEAR(std::hypot(from.x, from.y), 1.5 / std::cos(kPi / sides), 1e-13);
    }
    EXPECT_NEAR(corners[0].x, corners[1].x, 1e-14);  // the first side's middle is on the x axis
    EXPECT_NEAR(inradius_of_area(sides, signed_area(corners)), 1.5, 1e-13);
  }
}

TEST(Sides, ThatDoNotMeetNameTheGap) {
  const std::vector<Side> open = {{{0, 0}, {1, 0}}, {{1, 0}, {0, 1}}, {{0, 1}, {0, 0.25}}};
  EXPECT_EQ(why_not(corners_of(open)).message,
            "not closed: wall 3 ends at (0, 0.25), wall 1 begins at (0, 0), a gap of 0.25 m");
}

}  // namespace
}  // namespace swarmsmith
