#include "analysis/drawing/axes.h"

#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using testing::DoubleEq;
using testing::Pointwise;

TEST(Axes, RangeOfEqualValuesIsWideEnoughToDraw) {
  EXPECT_EQ(range_over({}), (ValueRange{0, 1}));
  EXPECT_EQ(range_over({3, 1, 2}), (ValueRange{1, 3}));
  EXPECT_EQ(range_over({2, 2}), (ValueRange{1.5, 2.5}));
  EXPECT_EQ(range_over({-100}), (ValueRange{-110, -90}));
}

TEST(Axes, TicksAreRoundAndNoMoreThanAsked) {
  EXPECT_DOUBLE_EQ(tick_step({0, 3}, 7), 0.5);
  EXPECT_DOUBLE_EQ(tick_step({-384171, -379120}, 7), 1000);
  EXPECT_DOUBLE_EQ(tick_step({0, 1}, 1), 1);
  EXPECT_THAT(ticks_in({-0.1, 0.31}, 0.1),
              Pointwise(testing::DoubleNear(1e-12), {-0.1, 0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(rounded({0.3, 2.9}, 7), (ValueRange{0, 3}));
}

TEST(Axes, TickTextsHaveTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
  EXPECT_EQ(tick_text(-380000, 1000), "-380000");
  EXPECT_EQ(tick_text(-1e-17, 0.1), "0.0");
}

TEST(Axes, MapsTheLowEndToTheFirstPlace) {
  const Axis up({0, 10}, 50, 10);
  EXPECT_DOUBLE_EQ(up.at(0), 50);
  EXPECT_DOUBLE_EQ(up.at(10), 10);
  EXPECT_DOUBLE_EQ(up.at(2.5), 40);
  const Bands bands(4, 10, 50);
  EXPECT_THAT(bands.centre(0), DoubleEq(15));
  EXPECT_THAT(bands.centre(3), DoubleEq(45));
}

TEST(Axes, BreaksNamesAtBlanksAndShortensWhatIsTooLong) {
  EXPECT_THAT(broken_text("colour selection", 2.8, 16, 3), ElementsAre("colour", "selection"));
  EXPECT_THAT(broken_text("a b", 2.8, 16, 3), ElementsAre("a b"));
  EXPECT_THAT(broken_text("one two three four", 2.8, 8, 2), ElementsAre("one", "two\u2026"));
}

TEST(Axes, NamesOfNarrowBandsAreWrittenSmallerBeforeTheyAreCut) {
  const std::vector<std::string> names = {"watermelon rvr", "chocolate rvr"};
  const auto drawn = [&](double width) {
    Svg svg(60, 40, "t", "d");
    const PlotArea area{10, 5, width, 20};
    draw_band_axis(svg, area, {2, area.left, area.right()}, names);
    return svg.finish();
  };
  EXPECT_THAT(drawn(40), HasSubstr("font-size=\"2.8\""));
  EXPECT_THAT(drawn(34), HasSubstr("font-size=\"2.5\""));
  EXPECT_THAT(drawn(34), HasSubstr(">watermelon<"));
  EXPECT_THAT(drawn(20), HasSubstr("font-size=\"2.2\""));
  EXPECT_THAT(drawn(20), HasSubstr("\u2026<"));
}

TEST(Axes, TextsOfAWideAxisStandClearOfEachOther) {
  Svg svg(60, 40, "t", "d");
  const PlotArea area{10, 5, 45, 20};
  draw_horizontal_axis(svg, area, {{100000, 400000}, area.left, area.right()}, "experiments");
  const std::string text = svg.finish();
  EXPECT_THAT(text, HasSubstr(">100000<"));
  EXPECT_THAT(text, HasSubstr(">300000<"));
  EXPECT_THAT(text, Not(HasSubstr(">150000<")));
}

TEST(Axes, SequentialColoursGetDarker) {
  EXPECT_EQ(sequential_color(0), "#fde725");
  EXPECT_EQ(sequential_color(1), "#440154");
  EXPECT_EQ(sequential_color(0.5), "#21918c");
  EXPECT_EQ(sequential_color(7), "#440154");
}

TEST(FlowingLegend, EntriesFollowEachOtherAndBreakWhereTheyMust) {
  const std::vector<LegendEntry> entries = {
      {"#000000", "one"}, {"#000000", "two"}, {"#000000", "a much longer third"}};
  EXPECT_DOUBLE_EQ(FlowingLegend(entries, 80).height(), kLineHeight);
  EXPECT_DOUBLE_EQ(FlowingLegend(entries, 40).height(), 2 * kLineHeight);
  EXPECT_DOUBLE_EQ(FlowingLegend(entries, 12).height(), 3 * kLineHeight);
  EXPECT_DOUBLE_EQ(FlowingLegend({}, 12).height(), 0);
}

}  // namespace
}  // namespace swarmsmith
