#include "analysis/figures/box_plot.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/analysis/support/svg_texts.h"

namespace swarmsmith {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> words_of(const std::string& svg) {
  std::vector<std::string> words;
  for (const TextBox& box : texts_of(svg))
    words.push_back(box.text);
  return words;
}

/// The thesis' kind: small integers and large ones, by source.
BoxPlot three_missions(double width_mm) {
  BoxPlot plot{.title = "Scores by source", .details = {"60 scores of 30 designs"}};
  plot.width_mm = width_mm;
  plot.panels = {
      {"aggregation",
       {{"rvr", 0, {3, 3, 3, 3, 3, 3, 2, 3, 3, 3}}, {"real", 1, {2, 3, 1, 3, 2, 2, 0, 2, 3, 3}}}},
      {"color selection",
       {{"rvr", 0, {6, 6, 6, 6, 6, 6, 6, 6, 6, 6}}, {"real", 1, {6, 6, 6, 6, 6, 6, 6, 6, 6, 4}}}},
      {"grid exploration",
       {{"rvr", 0, {-355359, -361234.5, -370001, -402000, -425812, -371000, -381000, -390000}},
        {"real", 1, {-340000, -351000, -342000, -361000, -350000, -349000, -351500, -342100}}}}};
  return plot;
}

/// As R 4.2 gives them: quantile(x), and the ends of ggplot2's and Tukey's whiskers.
TEST(BoxNumbers, AreThoseOfR) {
  const BoxNumbers box = box_numbers({7, 1, 2, 3, 4, 30});
  EXPECT_DOUBLE_EQ(box.lower_quartile, 2.25);
  EXPECT_DOUBLE_EQ(box.median, 3.5);
  EXPECT_DOUBLE_EQ(box.upper_quartile, 6.25);
  EXPECT_DOUBLE_EQ(box.lower_whisker, 1);
  EXPECT_DOUBLE_EQ(box.upper_whisker, 7);
  EXPECT_DOUBLE_EQ(box.mean, 47.0 / 6);
}

TEST(BoxNumbers, WhiskersNeverEndWithinTheBox) {
  // Both quartiles lie between values; the next ones are too far away for a whisker.
  const BoxNumbers box = box_numbers({0, 9, 9, 10, 10, 100});
  EXPECT_LE(box.lower_whisker, box.lower_quartile);
  EXPECT_GE(box.upper_whisker, box.upper_quartile);
  const BoxNumbers one = box_numbers({5});
  EXPECT_DOUBLE_EQ(one.lower_whisker, 5);
  EXPECT_DOUBLE_EQ(one.upper_whisker, 5);
}

TEST(BoxPlot, HasAPointForEveryScoreAndNoTextOverAnother) {
  for (const double width : {60.0, 84.0, 120.0, 175.0}) {
    const std::string svg = draw(three_missions(width));
    EXPECT_EQ(dots_in(svg), 56U);
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
    for (const char* word : {"aggregation", "grid exploration", "rvr", "real", "10", "8", "n",
                             "score (higher is better)"})
      EXPECT_THAT(words_of(svg), Contains(word));
  }
}

TEST(BoxPlot, CountsAreWrittenWhereAllIsTied) {
  BoxPlot plot{.title = "Ties", .details = {}};
  plot.panels = {{"color selection", {{"rvr", 0, std::vector<double>(30, 6.0)}}}};
  const std::string svg = draw(plot);
  EXPECT_THAT(words_of(svg), Contains("\u00d730"));
  EXPECT_EQ(dots_in(svg), 30U);
  // Also where there are many.
  plot.panels[0].groups[0].values.resize(12'000, 6.0);
  EXPECT_THAT(words_of(draw(plot)), Contains("\u00d712000"));
  EXPECT_THAT(text_problems(svg), IsEmpty());
  // The points stand beside each other.
  const std::string data = svg.substr(svg.find("d=\"M", svg.find("h0") - 20));
  EXPECT_NE(data.find("h0M"), std::string::npos);
  EXPECT_NE(data.substr(4, data.find("h0") - 4),
            data.substr(data.find("h0M") + 3,
                        data.find("h0", data.find("h0M") + 3) - data.find("h0M") - 3));
}

TEST(BoxPlot, CountsOfValuesThatDoNotRepeatAreNot) {
  BoxPlot plot{.title = "No ties", .details = {}};
  plot.panels = {{"m", {{"a", 0, {1, 2, 3, 4.5}}}}};
  EXPECT_THAT(words_of(draw(plot)), Not(Contains(testing::StartsWith("\u00d7"))));
}

TEST(BoxPlot, PointsDependOnTheValuesAlone) {
  BoxPlot plot = three_missions(84);
  const std::string svg = draw(plot);
  std::ranges::reverse(plot.panels[2].groups[0].values);
  EXPECT_EQ(draw(plot), svg);
}

TEST(BoxPlot, PairsHaveOneNameBelowTwoBoxesAndTheFirstOneIsNarrow) {
  BoxPlot plot{.title = "Scores by method"};
  plot.width_mm = 84;
  ScorePanel panel{.title = "aggregation", .groups = {}};
  for (const std::string method : {"evostick", "irace"}) {
    for (const bool narrow : {true, false})
      panel.groups.push_back(
          {.name = method, .color = 0, .values = {1, 2, 3.5, 4}, .narrow = narrow});
  }
  plot.panels = {panel};
  const std::string svg = draw(plot);
  EXPECT_THAT(text_problems(svg), IsEmpty());
  EXPECT_EQ(std::ranges::count(words_of(svg), "evostick"), 1);
  EXPECT_EQ(std::ranges::count(words_of(svg), "4"), 4) << "an n a box";
}

TEST(BoxPlot, LongNamesAndManyGroupsStayOnThePage) {
  BoxPlot plot{.title = "A title that is much longer than any column of any paper could ever be",
               .details = {}};
  ScorePanel panel{.title = "a mission with a name that does not end", .groups = {}};
  for (std::size_t i = 0; i < 9; ++i)
    panel.groups.push_back({"pseudo-reality-of-several-kinds " + std::to_string(i),
                            i,
                            {1e6 * static_cast<double>(i), 2e6, 3e6}});
  plot.panels = {panel, panel};
  const std::string svg = draw(plot);
  EXPECT_THAT(text_problems(svg), IsEmpty());
  EXPECT_THAT(shape_problems(svg), IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
