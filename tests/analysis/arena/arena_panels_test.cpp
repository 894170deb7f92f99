#include "analysis/arena/arena_panels.h"

#include <algorithm>

#include "tests/analysis/support/svg_texts.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Runs of three robots in a square of 2 m, where the second one does the longest things.
ArenaPanels four_runs(double width_mm) {
  ArenaPanels panels{.title = "push", .details = {"c12"}, .pictures = {}, .width_mm = width_mm};
  for (const char* seed : {"seed 1", "seed 1138953375", "seed 3", "seed 4"}) {
    ArenaPicture picture;
    picture.title = seed;
    picture.details = {"score 3"};
    picture.arena.walls = {
        {{-1, -1}, {1, -1}}, {{1, -1}, {1, 1}}, {{1, 1}, {-1, 1}}, {{-1, 1}, {-1, -1}}};
    for (int i = 0; i < 3; ++i)
      picture.robots.push_back({{{0.3 * i, 0, 0}, {0.3 * i, 0.5, 1}}, "exploration"});
    panels.pictures.push_back(picture);
  }
  return panels;
}

TEST(ArenaPanels, StandSideBySideWithoutTextOverText) {
  for (const double width : {60.0, 84.0, 175.0}) {
    const std::string svg = draw(four_runs(width));
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
    const auto texts = texts_of(svg);
    EXPECT_EQ(std::ranges::count(texts, "score 3", &TextBox::text), 4);
    EXPECT_EQ(std::ranges::count(texts, "2 exploration", &TextBox::text), 4);
  }
  const std::string svg = draw(four_runs(84));
  EXPECT_THAT(svg, HasSubstr("translate(42 "));
  const auto texts = texts_of(svg);
  const auto place = [&](const char* text) {
    return *std::ranges::find(texts, text, &TextBox::text);
  };
  EXPECT_DOUBLE_EQ(place("seed 1").bottom, place("seed 1138953375").bottom);
  EXPECT_DOUBLE_EQ(place("seed 1").left, place("seed 3").left);
  EXPECT_GT(place("seed 3").top, place("0 exploration").bottom);
}

TEST(ArenaPanels, OfOneRunIsAsWideAsThePage) {
  ArenaPanels panels = four_runs(84);
  panels.pictures.resize(1);
  EXPECT_THAT(draw(panels), HasSubstr(draw(panels.pictures.front()).substr(400, 200)));
}

}  // namespace
}  // namespace swarmsmith
