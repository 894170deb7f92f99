#include "analysis/arena/arena_picture.h"

#include <cmath>

#include "sim/mission/mission.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// A square of 2 m with corners at (+-1, +-1).
Arena square() {
  Arena arena;
  arena.walls = {{{-1, -1}, {1, -1}}, {{1, -1}, {1, 1}}, {{1, 1}, {-1, 1}}, {{-1, 1}, {-1, -1}}};
  return arena;
}

ArenaPicture picture_of(Arena arena) {
  ArenaPicture picture;
  picture.title = "push";
  picture.details = {"c12", "seed 7"};
  picture.arena = std::move(arena);
  return picture;
}

TEST(ArenaPicture, PutsTheArenaToScaleWithYUpwards) {
  // 84 mm less 2 mm of margin and 0.5 mm of wall on each side: 39.5 mm a metre, the centre at 42
  // mm; the upper wall below two lines of text, at 2 + 2 * 4.2 + 0.6 + 0.5 = 11.5 mm.
  ArenaPicture picture = picture_of(square());
  picture.arena.patches = {{Disc{{0.5, 0.5}, 0.1}, {0, 0, 0}}};
  const std::string text = draw(picture);
  EXPECT_THAT(text, HasSubstr("d=\"M2.5 90.5L81.5 90.5 81.5 11.5 2.5 11.5Z\""));
  EXPECT_THAT(text, HasSubstr("<circle cx=\"61.75\" cy=\"31.25\" r=\"3.95\" fill=\"#808080\"/>"));
  EXPECT_THAT(text, HasSubstr(">0.5 m</text>"));
  EXPECT_THAT(text, HasSubstr(">push</text>"));
  EXPECT_THAT(text, HasSubstr(">c12 \xc2\xb7 seed 7</text>"));
}

TEST(ArenaPicture, DrawsRobotsSolidAtTheEndAndHollowAtTheStart) {
  ArenaPicture picture = picture_of(square());
  picture.body = BoxOutline{0.2, 0.2};
  picture.robots = {{{{0, 0, 0}}, "stop"}};
  const std::string instant = draw(picture);
  // The body about (42, 51), 7.9 mm wide; the tip of its mark at 0.9 of half a side to the right.
  EXPECT_THAT(instant, HasSubstr("d=\"M45.95 47.05L38.05 47.05 38.05 54.95 45.95 54.95Z\" "
                                 "fill=\"#0072b2\""));
  EXPECT_THAT(instant, HasSubstr("d=\"M45.5"));
  EXPECT_THAT(instant, HasSubstr(">0 stop</text>"));
  EXPECT_THAT(instant, HasSubstr("text-anchor=\"middle\""));
  EXPECT_THAT(instant, Not(HasSubstr("stroke=\"#0072b2\"")));

  picture.robots[0].poses.push_back({0.5, 0, 1.5707963267948966});
  const std::string span = draw(picture);
  // A start, the trail's strongest part, and the body where the robot came to.
  EXPECT_THAT(span, HasSubstr("d=\"M45.95 47.05L38.05 47.05 38.05 54.95 45.95 54.95Z\" "
                              "fill=\"none\" stroke=\"#0072b2\""));
  EXPECT_THAT(span, HasSubstr("d=\"M42 51L61.75 51\" fill=\"none\" stroke=\"#0072b2\""));
  EXPECT_THAT(span, HasSubstr("d=\"M61.75 47.4"));
}

TEST(ArenaPicture, WritesTimesBesideRobotsAndNotOverTheirNumbers) {
  ArenaPicture picture = picture_of(square());
  picture.body = BoxOutline{0.2, 0.2};
  picture.cycles_a_mark = 50;
  PicturedRobot drives;
  for (int i = 0; i <= 100; ++i)
    drives.poses.push_back({0.008 * i - 0.5, 0, 0});
  picture.robots = {drives};
  const std::string text = draw(picture);
  EXPECT_THAT(text, HasSubstr(">5</text>"));
  EXPECT_THAT(text, Not(HasSubstr(">10</text>"))) << "it ends there";

  // Another one stands where the first one's time would be.
  picture.robots.push_back({{{-0.5 + 0.4 + 0.13, 0, 0}}, ""});
  const std::string beside = draw(picture);
  const auto x_of = [](const std::string& drawn) {
    const std::string before = drawn.substr(0, drawn.find(">5</text>"));
    const auto at = before.rfind("<text x=\"");
    return std::stod(before.substr(at + 9));
  };
  ASSERT_THAT(beside, HasSubstr(">5</text>"));
  EXPECT_LT(x_of(beside), x_of(text));
}

TEST(ArenaPicture, DrawsWhatStandsInTheArena) {
  ArenaPicture picture = picture_of(square());
  picture.arena.obstacles = {{CircleOutline{0.1}, {-0.5, 0, 0}}};
  picture.arena.objects = {{BoxOutline{0.2, 0.2}, {0, 0.5, 0}}};
  picture.arena.lights = {{1.5, 0, 0.75, 1000}};
  picture.objects = {{{0, 0.5, 0}, {0.2, 0.5, 0}}};
  const std::string text = draw(picture);
  EXPECT_EQ(count_of(text, "fill=\"#4d4d4d\""), 1U);
  EXPECT_EQ(count_of(text, "fill=\"#d9b778\""), 1U);
  EXPECT_EQ(count_of(text, "stroke-dasharray"), 1U);  // where the object was
  EXPECT_EQ(count_of(text, "fill=\"#f0e442\""), 1U);
  // The light is to the right of the walls, within the page.
  EXPECT_THAT(text, HasSubstr("<circle cx=\"79.8\""));
}

TEST(ArenaPicture, TellsLargeSwarmsByWhatTheyDo) {
  ArenaPicture picture = picture_of(square());
  picture.body = CircleOutline{0.02};
  for (int i = 0; i < 9; ++i)
    picture.robots.push_back({{{0.1 * i, 0, 0}}, i < 3 ? "stop" : "exploration"});
  const std::string text = draw(picture);
  EXPECT_THAT(text, HasSubstr(">6 \xc3\x97 exploration</text>"));
  EXPECT_THAT(text, HasSubstr(">3 \xc3\x97 stop</text>"));
  EXPECT_THAT(text, Not(HasSubstr("text-anchor=\"middle\"")));  // no room for numbers
}

TEST(ArenaPicture, OfTwoMinutesOfThreeRobotsStaysSmall) {
  ArenaPicture picture = picture_of(dodecagon_of_the_thesis());
  // Turning all the time is the worst case of a trail.
  for (int robot = 0; robot < 3; ++robot) {
    PicturedRobot pictured;
    for (int i = 0; i <= 1200; ++i) {
      const double at = 0.15 * i + robot;
      pictured.poses.push_back({0.5 * std::cos(0.031 * i) + 0.2 * std::cos(at),
                                0.5 * std::sin(0.027 * i) + 0.2 * std::sin(at), at});
    }
    picture.robots.push_back(std::move(pictured));
  }
  const std::string text = draw(picture);
  EXPECT_GT(text.size(), 10'000U);
  EXPECT_LT(text.size(), 100'000U);
}

}  // namespace
}  // namespace swarmsmith
