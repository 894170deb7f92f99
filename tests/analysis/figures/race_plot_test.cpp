#include "analysis/figures/race_plot.h"

#include <cmath>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/figures/internal/cell_runs.h"
#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"

namespace swarmsmith {
namespace {

using State = RacePlot::Cell::State;

constexpr std::size_t kScaleBoxes = 7;  ///< of the legend, one a colour
const std::string kDrop = "#d55e00";
const std::string kInkColor = "#222222";

/// A race in which half of the living are dropped after every fifth step, with random ranks.
RacePlot random_race(std::size_t rows, std::size_t steps, double width_mm, bool drops = true) {
  RacePlot plot{.title = "aggregation, watermelon",
                .details = {"Race of d1, iteration 3", "Budget: 300 of the design's 3000",
                            fmt::format("{} candidates", rows)},
                .description = "ranks",
                .width_mm = width_mm};
  Rng rng(7);
  std::size_t alive = rows;
  plot.rows.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    plot.rows[row].name = fmt::format("c{}", 1000 + row);
    plot.rows[row].elite_before = row % 7 == 0;
    plot.rows[row].elite_after = row < 3;
    plot.rows[row].cells.resize(steps);
  }
  for (std::size_t step = 0; step < steps; ++step) {
    const bool is_drop = drops && step % 5 == 4 && alive > 3;
    plot.steps.push_back({static_cast<std::int64_t>(step + 101),
                          is_drop    ? "-"
                          : step < 4 ? "x"
                                     : "=",
                          static_cast<std::int64_t>(alive)});
    for (std::size_t row = 0; row < alive; ++row)
      plot.rows[row].cells[step] = {State::Ranked, rng.uniform()};
    if (!is_drop) continue;
    for (std::size_t row = alive / 2; row < alive; ++row)
      plot.rows[row].dropped_after = step;
    alive /= 2;
  }
  return plot;
}

std::size_t cells_in(const RacePlot& plot) {
  std::size_t count = 0;
  for (const auto& row : plot.rows)
    count += static_cast<std::size_t>(
        std::ranges::count(row.cells, State::Ranked, &RacePlot::Cell::state));
  return count;
}

/// The lengths of all bars in the colours of ranks, without the legend's.
double ranked_length(const DrawnPage& page, double row_thickness) {
  double length = 0;
  for (std::size_t paint = 0; paint < kRankPaints; ++paint) {
    for (const auto& bar : page.bars_of(sequential_color(static_cast<double>(paint) / 6)))
      if (std::abs(bar.thickness - row_thickness) < 1e-9) length += bar.length;
  }
  return length;
}

TEST(RacePlot, HasOneCellAScore) {
  RacePlot plot = random_race(6, 5, 84);
  // Neighbours that differ are not merged.
  for (auto& row : plot.rows)
    for (std::size_t step = 0; step < row.cells.size(); ++step)
      row.cells[step].part = step % 2 == 0 ? 0 : 1;
  const DrawnPage page = drawn_page(draw(plot));
  const std::size_t best = page.bars_of(sequential_color(1)).size();
  const std::size_t worst = page.bars_of(sequential_color(0)).size();
  EXPECT_EQ(best + worst - 2, cells_in(plot));
  EXPECT_EQ(cells_in(plot), 30U);
  // The bars of the best lie left of those of the worst in their row, a step apart.
  EXPECT_NEAR(page.bars_of(sequential_color(1))[0].length, 6, 0.02);
}

TEST(RacePlot, MergedCellsCoverEachScoreOnce) {
  const RacePlot plot = random_race(58, 60, 84);
  const DrawnPage page = drawn_page(draw(plot));
  // Where a row is on the page, by its drop line: half a row apart at most.
  const double thickness = page.bars_of(kDrop).front().thickness;
  double column = 0;
  for (const auto& bar : page.bars_of(kDrop))
    column = std::max(column, bar.x);
  const auto& names = page.texts;
  ASSERT_FALSE(names.empty());
  const double left = [&] {
    double least = page.width;
    for (const auto& bar : page.bars)
      if (std::abs(bar.thickness - thickness) < 1e-9) least = std::min(least, bar.x);
    return least;
  }();
  const std::size_t last_drop = *plot.rows[4].dropped_after + 1;
  const double width = (column - left) / static_cast<double>(last_drop);
  EXPECT_NEAR(ranked_length(page, thickness), width * static_cast<double>(cells_in(plot)),
              0.005 * width * static_cast<double>(cells_in(plot)));
}

TEST(RacePlot, DroppedRowsEndWithALineAndNothingAfterIt) {
  const RacePlot plot = random_race(20, 15, 84);
  const DrawnPage page = drawn_page(draw(plot));
  const auto drops = page.bars_of(kDrop);
  const auto dropped = std::ranges::count_if(
      plot.rows, [](const auto& row) { return row.dropped_after.has_value(); });
  ASSERT_EQ(drops.size(), static_cast<std::size_t>(dropped));
  for (const auto& bar : page.bars) {
    if (bar.color == kDrop || bar.color == kInkColor) continue;
    for (const auto& drop : drops) {
      if (std::abs(bar.y - drop.y) < 1e-6) {
        EXPECT_LE(bar.x + bar.length, drop.x + 0.02);
      }
    }
  }
}

TEST(RacePlot, MarksElitesBeforeAndAfter) {
  const RacePlot plot = random_race(20, 15, 84);
  const auto marks = drawn_page(draw(plot)).bars_of(kInkColor);
  EXPECT_EQ(marks.size(), 3U + 3U);  // every seventh row, and the first three
}

TEST(RacePlot, SaysWhatTheMarkersMeanThatOccur) {
  const DrawnPage page = drawn_page(draw(random_race(20, 15, 84)));
  EXPECT_TRUE(page.has_text("x  no test"));
  EXPECT_TRUE(page.has_text("-  some dropped"));
  EXPECT_FALSE(page.has_text(".  none had to run"));
  EXPECT_EQ(std::ranges::count(page.texts, "x", &DrawnPage::Text::text), 4);
  EXPECT_TRUE(page.has_text("alive"));
  EXPECT_TRUE(page.has_text("20"));
  EXPECT_TRUE(page.has_text("10"));
}

TEST(RacePlot, NarrowStepsKeepTheMarkersOfThoseThatDropped) {
  const RacePlot plot = random_race(400, 200, 174);
  const DrawnPage page = drawn_page(draw(plot));
  const auto dropped = std::ranges::count(plot.steps, "-", &RacePlot::Step::marker);
  EXPECT_EQ(std::ranges::count(page.texts, "-", &DrawnPage::Text::text), dropped);
  EXPECT_EQ(std::ranges::count(page.texts, "x", &DrawnPage::Text::text), 1);
}

TEST(RacePlot, RejectedAndMissingCellsHaveColoursOfTheirOwn) {
  RacePlot plot = random_race(6, 4, 84, false);
  plot.rows[2].cells[1].state = State::Rejected;
  plot.rows[3].cells[2].state = State::Absent;
  const DrawnPage page = drawn_page(draw(plot));
  EXPECT_EQ(page.bars_of("#cc79a7").size(), 1U);
  EXPECT_EQ(page.bars_of("#d4d4d4").size(), 1U);
  EXPECT_TRUE(page.has_text("rejected"));
  EXPECT_TRUE(page.has_text("alive, not run"));
}

TEST(RacePlot, TextsStandClearOfEachOtherAtEverySize) {
  for (const double width : {84.0, 120.0, 174.0}) {
    for (const auto& [rows, steps] : {std::pair<std::size_t, std::size_t>{1, 1},
                                      {3, 7},
                                      {58, 60},
                                      {58, 17},
                                      {400, 200},
                                      {1024, 30}}) {
      EXPECT_THAT(drawn_page(draw(random_race(rows, steps, width))).collisions(), IsEmpty())
          << rows << " x " << steps << " at " << width;
    }
  }
}

TEST(RacePlot, LargeRacesStaySmallFiles) {
  EXPECT_LT(draw(random_race(400, 200, 174)).size(), 200'000U);
  // None dropped and no two neighbours alike: steps share cells, and the figure says so.
  const std::string worst = draw(random_race(400, 200, 174, false));
  EXPECT_LT(worst.size(), 200'000U);
  EXPECT_THAT(worst, HasSubstr("cells: mean rank of"));
  EXPECT_LT(draw(random_race(2000, 40, 84, false)).size(), 200'000U);
}

TEST(RacePlot, SharedCellsHaveTheMeanRank) {
  RacePlot plot{.steps = {{1, "x", 1}, {2, "x", 1}, {3, "x", 1}}, .rows = {{.name = "c1"}}};
  plot.rows[0].cells = {{State::Ranked, 0}, {State::Ranked, 1}, {State::Ranked, 0.99}};
  EXPECT_EQ(cell_runs(plot, 100).runs.size(), 2U);  // the two bad ones are painted alike
  const CellRuns shared = cell_runs(plot, 1);
  EXPECT_EQ(shared.steps_a_cell, 3U);
  ASSERT_EQ(shared.runs.size(), 1U);
  EXPECT_EQ(shared.runs[0].paint, 4U);  // 0.663 of the way to the worst
  EXPECT_EQ(shared.runs[0].end, 3U);
}

}  // namespace
}  // namespace swarmsmith
