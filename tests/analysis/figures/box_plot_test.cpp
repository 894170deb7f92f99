#include "analysis/figures/box_plot.h"

#include <algorithm>

#include "tests/analysis/support/svg_texts.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::vector<std::string> words_of(const std::string& svg) {
  std::vector<std::string> words;
  for (const TextBox& box : texts_of(svg))
    words.push_back(box.text);
  return words;
}

double height_of(const std::string& svg) {
  const std::size_t at = svg.find("height=\"") + 8;
  return std::stod(svg.substr(at));
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
  EXPECT_THAT(data, HasSubstr("h0M"));
  EXPECT_NE(data.substr(4, data.find("h0") - 4),
            data.substr(data.find("h0M") + 3,
                        data.find("h0", data.find("h0M") + 3) - data.find("h0M") - 3));
}

TEST(BoxPlot, CountsOfValuesThatDoNotRepeatAreNot) {
  BoxPlot plot{.title = "No ties", .details = {}};
  plot.panels = {{"m", {{"a", 0, {1, 2, 3, 4.5}}}}};
  EXPECT_THAT(words_of(draw(plot)), Not(Contains(StartsWith("\u00d7"))));
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

/// Seven methods in three missions under two profiles, ten designs each, with a line a design.
BoxPlot study(double width_mm, bool with_links) {
  BoxPlot plot{.title = "Scores by method", .details = {"42000 scores of 210 designs"}};
  plot.width_mm = width_mm;
  plot.legend = "narrow boxes: rvr; wide boxes: pseudo-reality";
  for (const char* mission : {"aggregation (robots)", "color selection (reward)", "grid"}) {
    ScorePanel panel{.title = mission, .groups = {}};
    for (const char* method :
         {"cma-es", "evostick", "icepop", "irace", "maple", "random", "vanilla"}) {
      for (const bool narrow : {true, false}) {
        ScoreGroup group{.name = method, .color = 0, .values = {}, .narrow = narrow};
        for (int i = 0; i < 10; ++i)
          group.values.push_back(0.37 * i + static_cast<double>(panel.groups.size() % 3));
        panel.groups.push_back(group);
      }
      const std::size_t last = panel.groups.size() - 1;
      for (std::size_t i = 0; with_links && i < 10; ++i)
        panel.links.push_back({.from = last - 1, .to = last, .from_value = i, .to_value = i});
    }
    plot.panels.push_back(panel);
  }
  return plot;
}

TEST(BoxPlot, OfAStudyFitsOnAPageWithWholeNames) {
  for (const double width : {84.0, 85.0, 174.0, 254.0}) {
    for (const bool with_links : {false, true}) {
      const std::string svg = draw(study(width, with_links));
      EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
      EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
      EXPECT_LE(height_of(svg), 240) << width;
      EXPECT_EQ(dots_in(svg), 420U);
      EXPECT_THAT(words_of(svg), Not(Contains(HasSubstr("\u2026")))) << width;
      for (const char* method : {"cma-es", "evostick", "vanilla"})
        EXPECT_EQ(std::ranges::count(words_of(svg), method), 3) << width;
    }
  }
}

TEST(BoxPlot, WhatTellsBoxesOfANameApartStandsInAPaper) {
  BoxPlot plot = study(84, false);
  plot.explained = false;
  EXPECT_THAT(words_of(draw(plot)), Contains(plot.legend));
}

TEST(BoxPlot, LinesBeginAndEndAtTheirPoints) {
  for (const double width : {84.0, 174.0}) {
    BoxPlot plot{.title = "gap"};
    plot.width_mm = width;
    plot.panels = {{"m",
                    {{"rvr", 0, {1, 4, 2}}, {"real", 1, {3, 1.5, 2.5}}},
                    {{.from = 0, .to = 1, .from_value = 1, .to_value = 0}}}};
    const std::string svg = draw(plot);
    // The line's ends are places of dots, which the file has as "Mx yh0".
    const std::size_t line = svg.find("stroke=\"#888888\"");
    const std::size_t begin = svg.rfind("d=\"M", line) + 4;
    const std::string path = svg.substr(begin, svg.find('"', begin) - begin);
    const std::string from = path.substr(0, path.find('L'));
    const std::string to = path.substr(path.find('L') + 1);
    EXPECT_NE(svg.find(from + "h0"), std::string::npos) << path;
    EXPECT_NE(svg.find(to + "h0"), std::string::npos) << path;
  }
}

TEST(BoxPlot, FillsAWideFigure) {
  BoxPlot plot = study(174, false);
  plot.panels.resize(1);
  plot.panels[0].groups.resize(4);
  double right = 0;
  for (const TextBox& box : texts_of(draw(plot)))
    right = std::max(right, box.text == "10" ? box.right : 0);
  EXPECT_GT(right, 165);
}

TEST(BoxPlot, PanelsBelowEachOtherBeginAtOnePlace) {
  BoxPlot plot = three_missions(84);
  std::vector<double> lefts;
  for (const TextBox& box : texts_of(draw(plot)))
    if (box.text == "n") lefts.push_back(box.right);
  ASSERT_EQ(lefts.size(), 3U);
  EXPECT_TRUE(lefts[0] == lefts[1] || lefts[1] == lefts[2] || lefts[0] == lefts[2]);
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
  EXPECT_EQ(std::ranges::count_if(
                words_of(svg), [](const std::string& word) { return word.ends_with("kinds 8"); }),
            2)
      << "to its last letter";
}

}  // namespace
}  // namespace swarmsmith
