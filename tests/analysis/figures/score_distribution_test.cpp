#include "analysis/figures/score_distribution.h"

#include <algorithm>

#include "analysis/drawing/svg.h"
#include "analysis/figures/internal/score_grid.h"

#include "tests/analysis/support/svg_texts.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::size_t bars_of_color(const std::string& svg, const std::string& color) {
  std::size_t bars = 0;
  const std::string end = "Z\" fill=\"" + color + "\"/>";
  for (std::size_t at = 0; (at = svg.find(end, at)) != std::string::npos; ++at)
    ++bars;
  return bars;
}

std::vector<std::string> words_of(const std::string& svg) {
  std::vector<std::string> words;
  for (const TextBox& box : texts_of(svg))
    words.push_back(box.text);
  return words;
}

TEST(ScoreBins, OfFewWholeNumbersAreThese) {
  const ScoreBins bins = score_bins({3, 0, 2, 2});
  EXPECT_TRUE(bins.single);
  EXPECT_EQ(bins.count, 4U);
  EXPECT_DOUBLE_EQ(bins.low, 0);
  EXPECT_EQ(bins.bin_of(0), 0U);
  EXPECT_EQ(bins.bin_of(3), 3U);
}

TEST(ScoreBins, OfOthersAreRoundAndHoldEveryValue) {
  const std::vector<double> values = {-425812, -355359.5, -371000, -380000, -400000, -360000};
  const ScoreBins bins = score_bins(values);
  EXPECT_FALSE(bins.single);
  EXPECT_DOUBLE_EQ(bins.width, 20000);
  EXPECT_DOUBLE_EQ(bins.low, -440000);
  for (const double value : values) {
    const double low = bins.low + bins.width * static_cast<double>(bins.bin_of(value));
    EXPECT_GE(value, low);
    EXPECT_LT(value, low + bins.width);
  }
  // Ends of bins belong to the bin above, also where the width is not a binary fraction.
  const ScoreBins tenths = score_bins({0, 0.1, 0.2, 0.3, 0.4, 0.5});
  EXPECT_EQ(tenths.bin_of(0.3), static_cast<std::size_t>(0.3 / tenths.width + 0.5));
  EXPECT_EQ(score_bins({0.5, 0.5}).count, 1U);
}

TEST(ScoreDistribution, BarsAreSharesAndSayTheirCounts) {
  ScoreDistribution plot{.title = "Distribution of scores", .details = {}};
  plot.groups = {"rvr", "real"};
  plot.panels = {{"aggregation",
                  {{"rvr", 0, {3, 3, 3, 3, 3, 2}}, {"real", 1, {0, 1, 1, 2, 3, 3, 3, 3, 2, 2}}}}};
  const std::string svg = draw(plot);
  // A swatch of the legend is one more.
  EXPECT_EQ(bars_of_color(svg, "#0072b2"), 2U + 1);
  EXPECT_EQ(bars_of_color(svg, "#d55e00"), 4U + 1);
  for (const char* word : {"0", "3", "5", "4", "score", "rvr", "real"})
    EXPECT_THAT(words_of(svg), Contains(word));
  EXPECT_THAT(text_problems(svg), IsEmpty());
  EXPECT_THAT(shape_problems(svg), IsEmpty());
}

TEST(ScoreDistribution, HistogramsSayTheWidthOfTheirBins) {
  ScoreDistribution plot{.title = "Distribution of scores", .details = {"6 scores"}};
  plot.groups = {"rvr"};
  const ScorePanel grid{"grid exploration",
                        {{"rvr", 0, {-425812, -355359, -371000, -380000, -400000, -360000}}}};
  plot.panels = {grid, grid, {"half", {{"rvr", 0, {0.5, 1.25, 7.75}}}}};
  for (const double width : {60.0, 84.0, 175.0}) {
    plot.width_mm = width;
    const std::string svg = draw(plot);
    EXPECT_THAT(words_of(svg), Contains("score, in bins of 20000"));
    EXPECT_THAT(words_of(svg), Contains("-440000"));
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
  }
}

TEST(ScoreDistribution, OfManyGroupsIsAGridOfMethodsByMissions) {
  ScoreDistribution plot{.title = "Distribution of scores", .details = {"630 scores"}};
  for (const char* mission : {"aggregation (robots)", "color selection (reward)", "grid (s)"}) {
    ScorePanel panel{mission, {}};
    for (const char* method :
         {"cma-es", "evostick", "icepop", "irace", "maple", "random", "vanilla"}) {
      for (const char* source : {"rvr", "pseudo-reality"}) {
        panel.groups.push_back({.name = std::string(method) + " " + source,
                                .color = 0,
                                .values = {-425812, -355359, -371000, -380000, -400000, -360000},
                                .method = method,
                                .source = source});
      }
    }
    plot.panels.push_back(panel);
  }
  for (const double width : {84.0, 85.0, 174.0}) {
    plot.width_mm = width;
    const std::string svg = draw_score_grid(plot, {"pseudo-reality", "rvr"});
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
    EXPECT_LE(std::stod(svg.substr(svg.find("height=\"") + 8)), 240) << width;
    for (const char* word : {"cma-es", "evostick", "vanilla", "rvr", "pseudo-reality"})
      EXPECT_EQ(std::ranges::count(words_of(svg), word), 1) << width;
    // Bars of equal shares in both colours: a swatch more.
    EXPECT_EQ(bars_of_color(svg, distinct_color(0)), bars_of_color(svg, distinct_color(1)));
  }
}

}  // namespace
}  // namespace swarmsmith
