#include "analysis/figures/sampling_plot.h"

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/internal/category_colors.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"

namespace swarmsmith {
namespace {

SamplingPlot::Panel behaviours(const std::string& name, std::size_t iterations) {
  SamplingPlot::Panel panel{.name = name, .categories = {"attraction", "repulsion", "stop"}};
  for (std::size_t i = 0; i < iterations; ++i)
    panel.columns.push_back({.candidates = 8, .counts = {2, 4, 1}, .elites = {0, 1}});
  return panel;
}

SamplingPlot::Panel numbers(const std::string& name, std::size_t iterations) {
  SamplingPlot::Panel panel{.name = name, .low = -19.75, .high = 19.25};
  for (std::size_t i = 0; i < iterations; ++i)
    panel.columns.push_back({.candidates = 10, .counts = {0, 1, 8, 1}, .elites = {2, 2, 3.5}});
  return panel;
}

SamplingPlot small_plot(std::size_t iterations) {
  SamplingPlot plot{.title = "t", .details = {"Values that d1 sampled"}, .caption = "By a rule."};
  for (std::size_t i = 0; i < iterations; ++i)
    plot.iterations.push_back(static_cast<std::int64_t>(i + 1));
  plot.panels = {behaviours("S0", iterations), numbers("W0", iterations)};
  return plot;
}

TEST(SamplingPlot, StacksTheSharesOfTheCandidates) {
  const DrawnPage page = drawn_page(draw(small_plot(3)));
  const CategoryColors colors({{"attraction", "repulsion", "stop"}});
  const auto attraction = page.bars_of(colors.color("attraction"));
  const auto repulsion = page.bars_of(colors.color("repulsion"));
  const auto stop = page.bars_of(colors.color("stop"));
  ASSERT_EQ(attraction.size(), 3U);
  ASSERT_EQ(repulsion.size(), 3U);
  ASSERT_EQ(stop.size(), 3U);
  EXPECT_TRUE(attraction[0].goes_down);
  EXPECT_NEAR(repulsion[0].length, 2 * attraction[0].length, 0.03);
  EXPECT_NEAR(stop[0].length, attraction[0].length / 2, 0.03);
  // Each stands on the one before; an eighth of the height stays blank: not active.
  EXPECT_NEAR(repulsion[0].y + repulsion[0].length, attraction[0].y, 0.02);
  EXPECT_NEAR(stop[0].y + stop[0].length, repulsion[0].y, 0.02);
  EXPECT_LT(attraction[0].x, attraction[1].x);
}

TEST(SamplingPlot, ShadesNumbersByDensityAndMarksElites) {
  const DrawnPage page = drawn_page(draw(small_plot(3)));
  // Four parts with 0, 1, 8, 1 of 10: densities 0.4 and 3.2.
  EXPECT_EQ(page.bars_of(lightened("#2c5f8a", 0.85)).size(), 6U);
  EXPECT_EQ(page.bars_of(lightened("#2c5f8a", 0.3)).size(), 3U);
  EXPECT_EQ(page.bars_of("#000000").size(), 6U);  // equal elites are one mark
  EXPECT_TRUE(page.has_text("-19.75"));
  EXPECT_TRUE(page.has_text("19.25"));
}

TEST(SamplingPlot, FamiliesOfValuesAreNamedByTheirPanels) {
  SamplingPlot plot = small_plot(2);
  plot.panels.push_back(behaviours("S1", 2));
  SamplingPlot::Panel size{.name = "size", .categories = {"1", "2"}};
  size.columns.assign(2, {.candidates = 2, .counts = {1, 1}, .elites = {}});
  plot.panels.push_back(size);
  const DrawnPage page = drawn_page(draw(plot));
  EXPECT_TRUE(page.has_text("S0,") && page.has_text("S1:"));
  EXPECT_TRUE(page.has_text("size:"));
  EXPECT_EQ(std::ranges::count(page.texts, "attraction", &DrawnPage::Text::text), 1);
  EXPECT_EQ(page.bars_of(sequential_color(0)).size(), 2U);
}

TEST(SamplingPlot, TextsStandClearOfEachOther) {
  for (const double width : {84.0, 174.0}) {
    for (const std::size_t across : {1U, 3U, 4U}) {
      SamplingPlot plot = small_plot(40);
      plot.width_mm = width;
      plot.panels_a_line = across;
      for (int i = 0; i < 9; ++i)
        plot.panels.push_back(numbers(fmt::format("NumConnections{}", i), 40));
      EXPECT_THAT(drawn_page(draw(plot)).collisions(), IsEmpty()) << width << " " << across;
      EXPECT_LT(draw(plot).size(), 200'000U);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
