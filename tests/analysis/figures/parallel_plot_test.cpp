#include "analysis/figures/parallel_plot.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"

namespace swarmsmith {
namespace {

const double kNotActive = std::numeric_limits<double>::quiet_NaN();

ParallelPlot small_plot() {
  ParallelPlot plot{.title = "t",
                    .details = {"1 elite"},
                    .caption = "By a rule.",
                    .parameters = {{.name = "S0", .categories = {"attraction", "stop"}},
                                   {.name = "tau0", .low = 1, .high = 100}},
                    .lines = {}};
  plot.lines = {{"c1", false, 0, {0, 50}}, {"c2", true, 3, {1, kNotActive}}};
  return plot;
}

/// The x of the points of a line through `axes` axes, two points each, and the score.
std::vector<double> places(const std::string& path) {
  std::vector<double> xs;
  const char* at = path.c_str() + path.find('M') + 1;
  while (*at != '"') {
    char* end = nullptr;
    xs.push_back(std::strtod(at, &end));
    std::strtod(end, &end);
    at = *end == 'L' || *end == ' ' ? end + 1 : end;
  }
  return xs;
}

std::vector<std::string> lines_of(const DrawnPage& page, const std::string& width) {
  std::vector<std::string> lines;
  for (const std::string& path : page.paths)
    if (path.find("stroke-width=\"" + width + "\"") != std::string::npos) lines.push_back(path);
  return lines;
}

TEST(ParallelPlot, ElitesAreBoldAndOnTop) {
  const std::string svg = draw(small_plot());
  const DrawnPage page = drawn_page(svg);
  const auto bold = lines_of(page, "0.5");
  const auto pale = lines_of(page, "0.13");
  ASSERT_EQ(bold.size(), 1U);
  ASSERT_EQ(pale.size(), 1U);
  EXPECT_GT(svg.find(bold[0]), svg.find(pale[0]));
  EXPECT_THAT(bold[0], HasSubstr(sequential_color(1)));
}

TEST(ParallelPlot, LinesGoThroughTheirValues) {
  const DrawnPage page = drawn_page(draw(small_plot()));
  const auto elite = places(lines_of(page, "0.5").at(0));
  const auto other = places(lines_of(page, "0.13").at(0));
  ASSERT_EQ(elite.size(), 5U);
  ASSERT_EQ(other.size(), 5U);
  EXPECT_LT(other[0], elite[0]);  // attraction before stop
  EXPECT_LT(elite[2], other[4]);  // not active: left of where the axis of the scores begins
  EXPECT_LT(other[4], other[2]);
  EXPECT_LT(other[2], elite[4]);
  // 50 of 1 to 100 is just left of the middle.
  EXPECT_NEAR(other[2], (other[4] + elite[4]) / 2, 1);
}

TEST(ParallelPlot, ThePlaceOfWhatIsNotActiveIsThereWhereItIsNeeded) {
  const DrawnPage page = drawn_page(draw(small_plot()));
  EXPECT_EQ(lines_of(page, "0.25").size(), 3U);  // two axes, and one such place
  EXPECT_TRUE(page.has_text("not active"));
  EXPECT_TRUE(page.has_text("higher is better"));
}

TEST(ParallelPlot, TextsStandClearAndFilesStaySmall) {
  const std::vector<std::string> conditions = {
      "black_floor", "color_detection",          "fixed_probability",
      "gray_floor",  "inverted_neighbour_count", "neighbour_count",
      "white_floor"};
  for (const double width : {84.0, 174.0}) {
    ParallelPlot plot{.title = "t", .details = {"d"}, .caption = "By a rule.", .width_mm = width};
    Rng rng(3);
    for (int i = 0; i < 10; ++i) {
      plot.parameters.push_back({.name = fmt::format("NumConnections{}", i),
                                 .categories = i % 2 == 0 ? conditions : std::vector<std::string>{},
                                 .low = -19.75,
                                 .high = 19.25});
    }
    for (int i = 0; i < 260; ++i) {
      ParallelPlot::Line line{.name = "c1", .is_elite = i < 10, .mean = -380000 * rng.uniform()};
      for (int p = 0; p < 10; ++p)
        line.values.push_back(p % 2 == 0 ? static_cast<double>(rng.below(7)) : rng.uniform());
      plot.lines.push_back(line);
    }
    const std::string svg = draw(plot);
    EXPECT_THAT(drawn_page(svg).collisions(), IsEmpty()) << width;
    EXPECT_LT(svg.size(), 200'000U);
  }
}

}  // namespace
}  // namespace swarmsmith
