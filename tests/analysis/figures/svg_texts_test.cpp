#include "tests/analysis/support/svg_texts.h"

#include "analysis/drawing/svg.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(SvgTexts, HaveTheWidthOfTheirFont) {
  Svg svg(50, 20, "t", "d");
  svg.text({10, 10}, "0 <", {.size = 10});
  const auto texts = texts_of(svg.finish());
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].text, "0 <");
  EXPECT_NEAR(texts[0].right - texts[0].left, 6.36 + 3.18 + 8.38, 1e-9);
}

TEST(SvgTexts, OverlapsAreFound) {
  Svg svg(50, 20, "t", "d");
  svg.text({10, 10}, "first", {.size = 3});
  svg.text({16, 10}, "second", {.size = 3, .anchor = TextStyle::Anchor::End});
  svg.text({10, 14}, "below", {.size = 3});
  EXPECT_THAT(text_problems(svg.finish()), ElementsAre(HasSubstr("\"first\"")));
}

TEST(SvgTexts, WhatReachesOverThePageIsFound) {
  Svg svg(50, 20, "t", "d");
  svg.text({48, 10}, "cut", {.size = 3});
  EXPECT_THAT(text_problems(svg.finish()), ElementsAre(HasSubstr("not on the page")));
  EXPECT_THAT(shape_problems(svg.finish()), IsEmpty());
  const PagePoint points[] = {{1, 1}, {51, 2}};
  svg.line(points, stroked("#000000", 1));
  EXPECT_EQ(shape_problems(svg.finish()).size(), 1U);
}

TEST(SvgTexts, DotsAreCounted) {
  Svg svg(50, 20, "t", "d");
  const PagePoint points[] = {{1, 1}, {5, 2}, {7, 2.5}};
  svg.dots(points, 0.5, "#112233");
  EXPECT_EQ(dots_in(svg.finish()), 3U);
  EXPECT_THAT(svg.finish(), HasSubstr("d=\"M1 1h0M5 2h0M7 2.5h0\""));
  EXPECT_THAT(shape_problems(svg.finish()), IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
