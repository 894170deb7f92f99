#include "analysis/drawing/svg.h"

#include <cmath>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(Svg, IsAFileInMillimetres) {
  const std::string text = Svg(84, 97.5, "a < b", "\"c\" & d\x01").finish();
  EXPECT_THAT(text, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"84mm\" "
                               "height=\"97.5mm\" viewBox=\"0 0 84 97.5\""));
  EXPECT_THAT(text, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(text, HasSubstr("<desc>&quot;c&quot; &amp; d\\u0001</desc>"));
  EXPECT_THAT(text, EndsWith("</svg>\n"));
}

TEST(Svg, WritesShapesShort) {
  Svg svg(10, 10, "", "");
  const PagePoint points[] = {{0, 0.001}, {1.5, 2.126}, {-0.001, 10}};
  svg.line(points, {.fill = "none", .stroke = "#123456", .width = 0.4, .dashes = "1 2"});
  svg.polygon(points, {.fill = "#ffffff", .stroke = "none", .width = 3, .dashes = {}});
  svg.circle({1, 2}, 3, {});
  const std::string text = svg.finish();
  EXPECT_THAT(text, HasSubstr("<path d=\"M0 0L1.5 2.13 0 10\" fill=\"none\" stroke=\"#123456\" "
                              "stroke-width=\"0.4\" stroke-dasharray=\"1 2\""));
  EXPECT_THAT(text, HasSubstr("<path d=\"M0 0L1.5 2.13 0 10Z\" fill=\"#ffffff\"/>"));
  EXPECT_THAT(text, HasSubstr("<circle cx=\"1\" cy=\"2\" r=\"3\" fill=\"none\"/>"));
}

TEST(Svg, CurvesAreQuadratic) {
  Svg svg(10, 10, "", "");
  svg.curve({1, 2}, {3, 4.5}, {5, 6}, stroked("#123456", 0.4));
  EXPECT_THAT(svg.finish(), HasSubstr("<path d=\"M1 2Q3 4.5 5 6\" fill=\"none\""));
}

TEST(Svg, KeepsTextAsText) {
  Svg svg(10, 10, "", "");
  svg.text({1, 2}, "n < 3", {.size = 2, .anchor = TextStyle::Anchor::End, .bold = true});
  EXPECT_THAT(svg.finish(), HasSubstr("<text x=\"1\" y=\"2\" font-size=\"2\" text-anchor=\"end\" "
                                      "font-weight=\"bold\" fill=\"#000000\">n &lt; 3</text>"));
}

TEST(Svg, TheOutsideOfAPolygonIsThePageLessThePolygon) {
  Svg svg(10, 20, "", "");
  const PagePoint points[] = {{1, 1}, {2, 1}, {2, 2}};
  svg.outside(points, {.fill = "#ffffff", .stroke = "none", .width = 0, .dashes = {}});
  EXPECT_THAT(svg.finish(), HasSubstr("M0 0L10 0 10 20 0 20ZM1 1L2 1 2 2Z"));
  EXPECT_THAT(svg.finish(), HasSubstr("fill-rule=\"evenodd\""));
}

TEST(Svg, AddsThePicturesOfOthers) {
  Svg inner(5, 5, "inner", "d");
  inner.circle({1, 2}, 1, filled("#ff0000"));
  Svg outer(20, 20, "outer", "d");
  outer.add(inner, {7.5, 3});
  EXPECT_THAT(outer.finish(), HasSubstr("<g transform=\"translate(7.5 3)\">\n<circle cx=\"1\""));
  EXPECT_THAT(outer.finish(), Not(HasSubstr("inner")));
  EXPECT_THAT(outer.finish(), EndsWith("</g>\n</svg>\n"));
}

TEST(Text, ThatIsTooWideEndsInAnEllipsis) {
  EXPECT_NEAR(text_width("abcdef", 1), 3.4, 1e-9);
  EXPECT_EQ(fitted_text("abcdef", 1, 3.41), "abcdef");
  EXPECT_EQ(fitted_text("abcdef", 1, 3.39), "abc\xe2\x80\xa6");
  // Letters of two bytes are taken whole.
  EXPECT_EQ(fitted_text("\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4", 1, 3), "\xc3\xa4\xc3\xa4\xe2\x80\xa6");
}

TEST(Color, IsMixedWithWhite) {
  EXPECT_EQ(lightened("#000000", 0.5), "#808080");
  EXPECT_EQ(lightened("#0072b2", 0), "#0072b2");
  EXPECT_EQ(lightened("#d55e00", 1), "#ffffff");
  EXPECT_EQ(distinct_color(0), distinct_color(kDistinctColors));
  EXPECT_NE(distinct_color(0), distinct_color(1));
}

TEST(Simplified, KeepsCornersAndDropsWhatLiesBetween) {
  std::vector<PagePoint> points;
  for (int i = 0; i <= 10; ++i)
    points.push_back({0.1 * i, 0});
  for (int i = 1; i <= 10; ++i)
    points.push_back({1, 0.1 * i});
  EXPECT_EQ(simplified(points, 0.01), (std::vector<PagePoint>{{0, 0}, {1, 0}, {1, 1}}));
  const std::vector<PagePoint> stands(100, {3, 4});
  EXPECT_EQ(simplified(stands, 0.01).size(), 2U);
}

TEST(Simplified, LeavesNothingOutFartherThanItsTolerance) {
  std::vector<PagePoint> circle;
  for (int i = 0; i <= 360; ++i)
    circle.push_back({10 * std::cos(i * 0.01745329252), 10 * std::sin(i * 0.01745329252)});
  const auto rough = simplified(circle, 0.1);
  EXPECT_LT(rough.size(), 60U);
  for (const PagePoint& point : circle) {
    double nearest = 100;
    for (std::size_t i = 0; i + 1 < rough.size(); ++i) {
      // Distance from the chord, by its height over a circle of this radius.
      const double dx = rough[i + 1].x - rough[i].x;
      const double dy = rough[i + 1].y - rough[i].y;
      const double along =
          ((point.x - rough[i].x) * dx + (point.y - rough[i].y) * dy) / (dx * dx + dy * dy);
      if (along < 0 || along > 1) continue;
      nearest = std::min(nearest, std::hypot(point.x - rough[i].x - along * dx,
                                             point.y - rough[i].y - along * dy));
    }
    EXPECT_LE(nearest, 0.1 + 1e-9);
  }
}

TEST(Millimetres, AreReadWithTheirUnit) {
  EXPECT_EQ(millimetres_from_text("84mm"), 84);
  EXPECT_EQ(millimetres_from_text("8.5 cm"), 85);
  EXPECT_EQ(millimetres_from_text("2in"), 50.8);
  EXPECT_EQ(millimetres_from_text("120"), 120);
  for (const char* wrong : {"", "mm", "84 px", "inf", "84mm2"})
    EXPECT_LT(millimetres_from_text(wrong), 0) << wrong;
}

TEST(Svg, BarsAreOneShapeInFewLetters) {
  Svg svg(10, 10, "t", "d");
  const std::vector<PageBar> cells = {{{1, 2}, 0.5}, {{1.5, 2}, 1}, {{0.25, 3}, 0.5}};
  svg.bars(cells, 0.9, "#123456");
  svg.bars({}, 0.9, "#654321");
  svg.bars(std::vector<PageBar>{{{1, 2}, 3}, {{2, 2}, 1}}, 0.5, "#abcdef", BarDirection::Down);
  const std::string text = svg.finish();
  EXPECT_THAT(text, HasSubstr("\"M1 2h.5m0 0h1m-2.25 1h.5\""));
  EXPECT_THAT(text, HasSubstr("\"M1 2v3m1-3v1\""));
  EXPECT_THAT(text, Not(HasSubstr("#654321")));
}

TEST(Svg, RoundingOfBarsDoesNotAddUp) {
  Svg svg(10, 10, "t", "d");
  std::vector<PageBar> cells;
  for (int i = 0; i < 3; ++i)
    cells.push_back({{i / 3.0, 0}, 1 / 3.0});
  svg.bars(cells, 1, "#123456");
  EXPECT_THAT(svg.finish(), HasSubstr("M0 0h.33m0 0h.34m0 0h.33"));
}

}  // namespace
}  // namespace swarmsmith
