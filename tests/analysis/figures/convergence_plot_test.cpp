#include "analysis/figures/convergence_plot.h"

#include <fmt/format.h>

#include "analysis/drawing/svg.h"
#include "analysis/figures/internal/stairs.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"

namespace swarmsmith {
namespace {

ConvergencePlot plot_of(std::size_t panels, std::size_t lines, double width_mm = 84) {
  ConvergencePlot plot{.title = "Convergence",
                       .details = {"Best candidate of many designs"},
                       .groups = {"watermelon", "chocolate"},
                       .width_mm = width_mm};
  for (std::size_t p = 0; p < panels; ++p) {
    ConvergencePlot::Panel panel{.name = fmt::format("mission {}", p)};
    for (std::size_t i = 0; i < lines; ++i) {
      const double base = p == 0 ? 2.0 : -380000.0;
      panel.lines.push_back({.name = fmt::format("d{}", i + 1), .group = i % 2});
      for (int k = 1; k <= 4; ++k) {
        const double mean = base * (1 + 0.01 * static_cast<double>(i) + 0.05 * k);
        panel.lines.back().points.push_back({25000.0 * k, mean, mean - 0.3, mean + 0.1});
      }
    }
    plot.panels.push_back(panel);
  }
  return plot;
}

std::size_t shapes(const DrawnPage& page, const std::string& attribute) {
  return static_cast<std::size_t>(std::ranges::count_if(page.paths, [&](const std::string& path) {
    return path.find(attribute) != std::string::npos;
  }));
}

TEST(ConvergencePlot, ADesignAloneHasTheBandOfItsElites) {
  const std::string band = "fill=\"" + lightened(distinct_color(0), 0.75) + "\"";
  const DrawnPage alone = drawn_page(draw(plot_of(1, 1)));
  EXPECT_EQ(shapes(alone, band), 2U);  // in the plot and in the legend
  EXPECT_TRUE(alone.has_text("least to best elite"));
  EXPECT_EQ(shapes(drawn_page(draw(plot_of(1, 2))), band), 0U);
}

TEST(ConvergencePlot, MissionsHaveAxesOfTheirOwn) {
  const DrawnPage page = drawn_page(draw(plot_of(2, 3)));
  EXPECT_TRUE(page.has_text("mission 0"));
  EXPECT_TRUE(page.has_text("mission 1"));
  EXPECT_EQ(std::ranges::count(page.texts, "mean score (higher is better)", &DrawnPage::Text::text),
            2);
  EXPECT_TRUE(page.has_text("-400000"));
  EXPECT_TRUE(page.has_text("2.10"));
}

TEST(ConvergencePlot, ManyDesignsArePaleWithABoldMedian) {
  const DrawnPage page = drawn_page(draw(plot_of(1, 30)));
  EXPECT_EQ(shapes(page, "stroke-width=\"0.7\""), 2U);
  EXPECT_EQ(shapes(page, "stroke=\"" + lightened(distinct_color(1), 0.5) + "\""), 15U);
  EXPECT_TRUE(page.has_text("chocolate (bold: median)"));
}

TEST(ConvergencePlot, TextsStandClearOfEachOther) {
  for (const double width : {84.0, 174.0})
    for (const std::size_t panels : {1U, 2U, 3U})
      for (const std::size_t lines : {1U, 30U})
        EXPECT_THAT(drawn_page(draw(plot_of(panels, lines, width))).collisions(), IsEmpty())
            << width << " " << panels << " " << lines;
}

TEST(Stairs, HoldTheirValueUntilTheNext) {
  EXPECT_THAT(stairs({{1, 5}, {3, 7}}),
              ElementsAre(StairPoint{1, 5}, StairPoint{3, 5}, StairPoint{3, 7}));
}

TEST(Stairs, MedianIsWhereAllAre) {
  EXPECT_THAT(median_of({{{1, 0}, {4, 10}}, {{2, 4}, {5, 6}}, {{2, 5}, {3, 1}, {6, 2}}}),
              ElementsAre(StairPoint{2, 4}, StairPoint{3, 1}, StairPoint{4, 4}));
  EXPECT_THAT(median_of({{{1, 0}}, {{1, 3}}}), ElementsAre(StairPoint{1, 1.5}));
  EXPECT_THAT(median_of({}), IsEmpty());
}

TEST(ConvergencePlot, SearchesThatTellOnceAreNoVerticalLines) {
  ConvergencePlot plot = plot_of(1, 6);
  plot.groups = {"random"};
  for (auto& line : plot.panels.front().lines) {
    line.group = 0;
    line.points = {{100000, line.points[0].mean, 0, 0}};
  }
  // Ends, a median among them, and no line.
  const DrawnPage page = drawn_page(draw(plot));
  EXPECT_EQ(shapes(page, "stroke=\"" + distinct_color(0) + "\" stroke-width=\"0.7\""), 0U);
  for (auto& line : plot.panels.front().lines)
    line.points.insert(line.points.begin(), {50000, line.points[0].mean - 1, 0, 0});
  const std::string svg = draw(plot);
  const std::size_t median = svg.find("stroke-width=\"0.7\"");
  ASSERT_NE(median, std::string::npos);
  const std::size_t begin = svg.rfind("d=\"M", median);
  const std::string path = svg.substr(begin, median - begin);
  EXPECT_EQ(std::ranges::count(path, 'L'), 1) << path;  // straight, from point to point
  EXPECT_EQ(path.find_first_of("HV"), std::string::npos) << path;
}

}  // namespace
}  // namespace swarmsmith
