#include "analysis/figures/module_chart.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "analysis/drawing/svg.h"
#include "tests/analysis/support/svg_texts.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Tables 7.1 to 7.3 of the thesis.
ModuleChart thesis_tables() {
  ModuleChart chart{.title = "Modules of the winners", .details = {}};
  chart.modules = {"exploration",
                   "stop",
                   "attraction",
                   "repulsion",
                   "black floor",
                   "gray floor",
                   "white floor",
                   "neighbour count",
                   "inverted neighbour count",
                   "fixed probability",
                   "color detection"};
  using Numbers = std::vector<std::pair<double, double>>;
  const Numbers aggregation = {{1.5, 0.8}, {1.2, 1.0}, {0.2, 0.2}, {0.4, 0.4},
                               {2.5, 1.0}, {1.3, 0.8}, {0.7, 0.5}, {0.6, 0.4},
                               {0.4, 0.3}, {0.8, 0.6}, {1.2, 0.5}};
  const Numbers grid = {{2.4, 1.0}, {0.0, 0.0}, {0.0, 0.0}, {0.1, 0.1}, {0.5, 0.5}, {0.7, 0.6},
                        {0.4, 0.4}, {1.0, 0.7}, {2.1, 0.9}, {1.9, 0.9}, {0.7, 0.4}};
  const Numbers color = {{1.6, 1.0}, {1.1, 1.0}, {0.2, 0.2}, {0.5, 0.4}, {0.9, 0.7}, {1.9, 1.0},
                         {1.6, 1.0}, {1.2, 0.8}, {1.0, 0.7}, {0.7, 0.7}, {0.9, 0.8}};
  const auto cells = [](const Numbers& numbers) {
    std::vector<std::optional<ModuleCounts>> counts;
    for (const auto& [mean, rate] : numbers)
      counts.push_back(ModuleCounts{mean, rate, mean, rate});
    return counts;
  };
  chart.blocks = {{"watermelon",
                   {{"aggregation", 10, cells(aggregation)},
                    {"color selection", 10, cells(color)},
                    {"grid exploration", 10, cells(grid)}}}};
  return chart;
}

/// All texts behind each other, blanks between.
std::string words_of(const std::string& svg) {
  std::string words;
  for (const TextBox& box : texts_of(svg))
    words += box.text + " ";
  return words;
}

std::ptrdiff_t times(const std::string& svg, const std::string& word) {
  return std::ranges::count(texts_of(svg), word, &TextBox::text);
}

TEST(ModuleChart, WritesEveryNumberOfTheTable) {
  const std::string svg = draw(thesis_tables());
  EXPECT_EQ(times(svg, "2.5"), 1);
  EXPECT_EQ(times(svg, "100 %"), 7);
  EXPECT_EQ(times(svg, "0 %"), 2);
  EXPECT_EQ(times(svg, "n = 10"), 3);
  EXPECT_EQ(times(svg, "black floor"), 1);
  std::size_t numbers = 0;
  for (const TextBox& box : texts_of(svg))
    if (box.text.ends_with(" %")) ++numbers;
  EXPECT_EQ(numbers, 33U);
}

TEST(ModuleChart, WhatCannotBeReachedIsPaleAndWhatCannotBeIsADash) {
  ModuleChart chart = thesis_tables();
  EXPECT_THAT(draw(chart), Not(HasSubstr("pale")));
  auto& cells = chart.blocks.front().columns.front().cells;
  cells[4]->average_reachable = 2;
  cells[10] = std::nullopt;
  const std::string svg = draw(chart);
  EXPECT_EQ(times(svg, "-"), 2);
  EXPECT_THAT(svg, HasSubstr(lightened(distinct_color(0), 0.6)));
  EXPECT_THAT(words_of(svg), HasSubstr("pale: in states that cannot be reached"));
  EXPECT_THAT(words_of(svg), HasSubstr("-: the flavour has no such module"));
  EXPECT_THAT(text_problems(svg), IsEmpty());
}

TEST(ModuleChart, HasNoTextOverAnother) {
  for (const double width : {60.0, 84.0, 120.0, 175.0, 300.0}) {
    ModuleChart chart = thesis_tables();
    chart.width_mm = width;
    const std::string svg = draw(chart);
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
  }
}

TEST(ModuleChart, WhatDoesNotFitSideBySideContinuesBelow) {
  ModuleChart chart = thesis_tables();
  auto& columns = chart.blocks.front().columns;
  chart.modules.resize(5);  // with all of them it would be higher than a page, and a grid
  for (auto& column : columns)
    column.cells.resize(5);
  const auto first = columns;
  columns.insert(columns.end(), first.begin(), first.end());
  chart.blocks.push_back({"chocolate", first});
  const std::string svg = draw(chart);
  // Six missions of one method are two stripes, and the other method is a third one.
  EXPECT_EQ(times(svg, "black floor"), 3);
  EXPECT_EQ(times(svg, "watermelon"), 2);
  EXPECT_EQ(times(svg, "chocolate"), 1);
  EXPECT_THAT(text_problems(svg), IsEmpty());
  EXPECT_THAT(shape_problems(svg), IsEmpty());
}

TEST(ModuleChart, OfAStudyIsAGridAMissionOnOnePage) {
  ModuleChart chart = thesis_tables();
  const auto columns = chart.blocks.front().columns;
  chart.blocks.clear();
  for (const char* method : {"cma-es", "evostick", "icepop", "irace", "maple", "random", "vanilla"})
    chart.blocks.push_back({method, columns});
  chart.blocks[1].columns[0].cells[3] = std::nullopt;
  for (const double width : {84.0, 85.0, 174.0, 254.0}) {
    chart.width_mm = width;
    const std::string svg = draw(chart);
    EXPECT_THAT(text_problems(svg), IsEmpty()) << width;
    EXPECT_THAT(shape_problems(svg), IsEmpty()) << width;
    EXPECT_LE(std::stod(svg.substr(svg.find("height=\"") + 8)), 240) << width;
    for (const char* method : {"cma-es", "evostick", "vanilla"})
      EXPECT_EQ(times(svg, method), 3) << width;
    EXPECT_EQ(times(svg, "2.5"), 7) << width;  // black floor for aggregation, of each method
    EXPECT_EQ(times(svg, "-"), 1);
    EXPECT_THAT(words_of(svg), HasSubstr("-: the flavour has no such module"));
  }
}

}  // namespace
}  // namespace swarmsmith
