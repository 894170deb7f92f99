#include "analysis/figures/module_chart.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/analysis/support/svg_texts.h"

namespace swarmsmith {
namespace {

using testing::IsEmpty;

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
  using Cells = std::vector<ModuleChart::Cell>;
  const Cells aggregation = {{1.5, 0.8}, {1.2, 1.0}, {0.2, 0.2}, {0.4, 0.4}, {2.5, 1.0}, {1.3, 0.8},
                             {0.7, 0.5}, {0.6, 0.4}, {0.4, 0.3}, {0.8, 0.6}, {1.2, 0.5}};
  const Cells grid = {{2.4, 1.0}, {0.0, 0.0}, {0.0, 0.0}, {0.1, 0.1}, {0.5, 0.5}, {0.7, 0.6},
                      {0.4, 0.4}, {1.0, 0.7}, {2.1, 0.9}, {1.9, 0.9}, {0.7, 0.4}};
  const Cells color = {{1.6, 1.0}, {1.1, 1.0}, {0.2, 0.2}, {0.5, 0.4}, {0.9, 0.7}, {1.9, 1.0},
                       {1.6, 1.0}, {1.2, 0.8}, {1.0, 0.7}, {0.7, 0.7}, {0.9, 0.8}};
  chart.blocks = {{"watermelon",
                   {{"aggregation", 10, aggregation},
                    {"color selection", 10, color},
                    {"grid exploration", 10, grid}}}};
  return chart;
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

}  // namespace
}  // namespace swarmsmith
