#include "analysis/figures/race_plot.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/cell_runs.h"

namespace swarmsmith {
namespace {

/// Each run takes some 14 characters, so the file stays under 200 kB.
constexpr std::size_t kMostRuns = 10'000;
constexpr double kLargestColumn = 6;
constexpr double kLargestRow = 3.6;
constexpr double kTallest = 1.25;      ///< height of the matrix relative to the figure's width
constexpr double kTallest_mm = 150;    ///< on a page
constexpr double kMark = 1;            ///< width of an elite's mark
constexpr double kDropLine = 0.4;      ///< width of the line after the step that dropped a row
constexpr double kLeastHeadRoom = 10;  ///< for the words before the two lines above the matrix
constexpr std::string_view kDrop = "#d55e00";
constexpr std::string_view kRejectedColor = "#cc79a7";
constexpr std::string_view kNotRunColor = "#d4d4d4";

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kMarkers = {
    {{"x", "no test"},
     {"-", "some dropped"},
     {"=", "none dropped"},
     {"!", "would drop elites"},
     {".", "none had to run"},
     {"c", "dropped by capping"},
     {":", "only elites ran"}}};

/// Positions of the parts of the figure, mm.
struct Layout {
  PlotArea matrix;
  double column = 0;  ///< width of a step
  double row = 0;     ///< height of a candidate
  double alive_line = 0;
  double marker_line = 0;
  double column_left(std::size_t step) const {
    return matrix.left + column * static_cast<double>(step);
  }
  double row_middle(std::size_t row_number) const {
    return matrix.top + row * (static_cast<double>(row_number) + 0.5);
  }
};

Layout layout_of(const RacePlot& plot) {
  double names = kLeastHeadRoom;
  for (const auto& row : plot.rows)
    names = std::max(names, text_width(row.name, kTextSize));
  Layout layout;
  layout.matrix.left = kMargin + names + 1 + kMark + 0.4;
  const double room = plot.width_mm - kMargin - kMark - 0.4 - layout.matrix.left;
  const auto steps = static_cast<double>(std::max<std::size_t>(1, plot.steps.size()));
  const auto rows = static_cast<double>(std::max<std::size_t>(1, plot.rows.size()));
  layout.column = std::min(kLargestColumn, room / steps);
  layout.row = std::min(kLargestRow, std::min(kTallest * plot.width_mm, kTallest_mm) / rows);
  layout.matrix.width = layout.column * steps;
  layout.matrix.height = layout.row * rows;
  const double head =
      kMargin + kTitleSize + kLineHeight * static_cast<double>(plot.details.size()) + 2;
  layout.alive_line = head + kTextSize;
  layout.marker_line = layout.alive_line + kLineHeight;
  layout.matrix.top = layout.marker_line + 1.4;
  return layout;
}

/// Writes the number of alive candidates where it changes and there is room for it.
void draw_alive(Svg& svg, const RacePlot& plot, const Layout& at) {
  const double before = at.matrix.left - kMark - 1.4;
  svg.text({before, at.alive_line}, "alive", ink(TextStyle::Anchor::End));
  svg.text({before, at.marker_line}, "test", ink(TextStyle::Anchor::End));
  double taken = 0;
  for (std::size_t step = 0; step < plot.steps.size(); ++step) {
    if (step > 0 && plot.steps[step].alive == plot.steps[step - 1].alive) continue;
    const double left = at.column_left(step);
    const std::string text = fmt::format("{}", plot.steps[step].alive);
    const double right = left + text_width(text, kTextSize);
    if (left < taken || right > svg.width() - kMargin) continue;
    svg.text({left, at.alive_line}, text, ink(TextStyle::Anchor::Start));
    taken = right + 0.6;
  }
}

/// A marker and the steps [first, end) that have it.
struct MarkerStretch {
  std::string marker;
  std::size_t first = 0;
  std::size_t end = 0;

  bool dropped_some() const { return marker == "-" || marker == "c"; }
};

/// One stretch per step, or one per sequence of equal markers.
std::vector<MarkerStretch> marker_stretches(const RacePlot& plot, bool each) {
  std::vector<MarkerStretch> stretches;
  for (std::size_t step = 0; step < plot.steps.size(); ++step) {
    const std::string& marker = plot.steps[step].marker;
    if (each || stretches.empty() || stretches.back().marker != marker)
      stretches.push_back({marker, step, step});
    stretches.back().end = step + 1;
  }
  return stretches;
}

/// Draws one letter per step. If steps are too narrow for a readable letter, draws one letter per
/// sequence of equal markers, as far as there is room; markers of steps that dropped a candidate
/// have priority.
void draw_markers(Svg& svg, const RacePlot& plot, const Layout& at) {
  constexpr double kLeast = 1.6;      ///< size of the smallest readable letters
  constexpr double kOfStretch = 2.2;  ///< size if not each step has a letter
  const double fitting = at.column / (1.1 * text_width("=", 1));
  const bool each = fitting >= kLeast;
  const double size = each ? std::min(fitting, kTextSize) : kOfStretch;
  std::vector<MarkerStretch> stretches = marker_stretches(plot, each);
  std::stable_partition(stretches.begin(), stretches.end(),
                        std::mem_fn(&MarkerStretch::dropped_some));
  std::vector<ValueRange> taken;
  for (const MarkerStretch& stretch : stretches) {
    const double middle = (at.column_left(stretch.first) + at.column_left(stretch.end)) / 2;
    const double half = text_width(stretch.marker, size) / 2;
    const bool is_clear = std::ranges::none_of(taken, [&](const ValueRange& other) {
      return middle - half < other.high && other.low < middle + half;
    });
    if (!is_clear) continue;
    svg.text({middle, at.marker_line}, stretch.marker, ink(TextStyle::Anchor::Middle, size));
    taken.push_back({middle - half, middle + half});
  }
}

/// Writes the names of the rows from the best one on, as many as fit.
void draw_names(Svg& svg, const RacePlot& plot, const Layout& at) {
  double taken = 0;
  for (std::size_t row = 0; row < plot.rows.size(); ++row) {
    const double middle = at.row_middle(row);
    if (row > 0 && middle - taken < kTextSize + 0.4) continue;
    svg.text({at.matrix.left - kMark - 1.4, middle + 0.36 * kTextSize}, plot.rows[row].name,
             ink(TextStyle::Anchor::End));
    taken = middle;
  }
}

void draw_cells(Svg& svg, const CellRuns& cells, const Layout& at) {
  for (std::size_t paint = 0; paint < kPaints; ++paint) {
    std::vector<PageBar> bars;
    for (const CellRun& run : cells.runs) {
      if (run.paint != paint) continue;
      const double left = at.column_left(run.first);
      bars.push_back({{left, at.row_middle(run.row)}, at.column_left(run.end) - left});
    }
    std::string color(kRejectedColor);
    if (paint < kRankPaints)
      color = sequential_color(1 - static_cast<double>(paint) / (kRankPaints - 1));
    if (paint == kNotRun) color = kNotRunColor;
    svg.bars(bars, at.row + 0.01, color);
  }
}

/// Marks elites beside their rows, and draws lines where rows end.
void draw_marks(Svg& svg, const RacePlot& plot, const Layout& at) {
  std::vector<PageBar> elites;
  std::vector<PageBar> drops;
  for (std::size_t row = 0; row < plot.rows.size(); ++row) {
    const RacePlot::Row& candidate = plot.rows[row];
    const double middle = at.row_middle(row);
    if (candidate.elite_before) elites.push_back({{at.matrix.left - kMark - 0.4, middle}, kMark});
    if (candidate.elite_after) elites.push_back({{at.matrix.right() + 0.4, middle}, kMark});
    if (candidate.dropped_after)
      drops.push_back({{at.column_left(*candidate.dropped_after + 1), middle}, kDropLine});
  }
  // Leaves a small gap between neighbouring marks, if there is room.
  svg.bars(elites, std::max(0.8 * at.row, at.row - 0.4), kInk);
  svg.bars(drops, at.row + 0.01, kDrop);
}

/// Writes the numbers of steps below the matrix, round ones as far as there is room.
double draw_steps(Svg& svg, const RacePlot& plot, const Layout& at) {
  const double text = at.matrix.bottom() + 1 + kTextSize;
  if (plot.steps.empty()) return text;
  const std::string widest = fmt::format("{}", plot.steps.back().number);
  const double room = (text_width(widest, kTextSize) + 1) / at.column;
  const ValueRange range = {static_cast<double>(plot.steps.front().number),
                            static_cast<double>(plot.steps.back().number) + 1};
  const auto most = static_cast<std::size_t>((range.high - range.low) / room);
  const auto apart = static_cast<std::int64_t>(std::max(1.0, tick_step(range, most)));
  for (std::size_t step = 0; step < plot.steps.size(); ++step) {
    if (plot.steps[step].number % apart != 0) continue;
    const double middle = at.column_left(step) + at.column / 2;
    const std::array<PagePoint, 2> tick = {
        {{middle, at.matrix.bottom() + 0.2}, {middle, at.matrix.bottom() + 0.9}}};
    svg.line(tick, stroked(kInk, 0.15));
    svg.text({middle, text}, fmt::format("{}", plot.steps[step].number),
             ink(TextStyle::Anchor::Middle));
  }
  svg.text({at.matrix.left, text + kLineHeight}, "step, on one pair (instance, seed)",
           ink(TextStyle::Anchor::Start));
  return text + kLineHeight;
}

/// Draws the scale of rank colours.
void draw_scale(Svg& svg, double base_line) {
  constexpr double kBox = 3.2;
  double x = kMargin;
  for (std::size_t paint = 0; paint < kRankPaints; ++paint, x += kBox) {
    const PageBar box = {{x, base_line - 1}, kBox};
    svg.bars({&box, 1}, 2.4, sequential_color(1 - static_cast<double>(paint) / (kRankPaints - 1)));
  }
  svg.text({x + 0.8, base_line}, "rank in the step, best to worst", ink(TextStyle::Anchor::Start));
}

Legend legend_of(const RacePlot& plot, const CellRuns& cells) {
  std::vector<LegendEntry> entries;
  const auto any = [&](auto test) { return std::ranges::any_of(plot.rows, test); };
  if (any([](const auto& row) { return row.dropped_after.has_value(); }))
    entries.push_back({std::string(kDrop), "dropped here"});
  if (any([](const auto& row) { return row.elite_before; }))
    entries.push_back({std::string(kInk), "left: elite before"});
  if (any([](const auto& row) { return row.elite_after; }))
    entries.push_back({std::string(kInk), "right: elite after"});
  const auto painted = [&](std::size_t paint) {
    return std::ranges::find(cells.runs, paint, &CellRun::paint) != cells.runs.end();
  };
  if (painted(kNotRun)) entries.push_back({std::string(kNotRunColor), "alive, not run"});
  if (painted(kRejected)) entries.push_back({std::string(kRejectedColor), "rejected"});
  for (const auto& [marker, meaning] : kMarkers) {
    if (std::ranges::find(plot.steps, marker, &RacePlot::Step::marker) != plot.steps.end())
      entries.push_back({"", fmt::format("{}  {}", marker, meaning)});
  }
  if (cells.steps_a_cell > 1)
    entries.push_back({"", fmt::format("cells: mean rank of {} steps", cells.steps_a_cell)});
  return {std::move(entries), plot.width_mm - 2 * kMargin};
}

}  // namespace

std::string_view meaning_of_marker(std::string_view marker) {
  const auto* const found =
      std::ranges::find(kMarkers, marker, &std::pair<std::string_view, std::string_view>::first);
  return found == kMarkers.end() ? "not known" : found->second;
}

std::string draw(const RacePlot& plot) {
  const Layout at = layout_of(plot);
  const CellRuns cells = cell_runs(plot, kMostRuns);
  const Legend legend = legend_of(plot, cells);
  const double below = at.matrix.bottom() + 1 + kTextSize + kLineHeight;
  const double height = below + 2 + kLineHeight + 1.5 + legend.height() + kMargin;
  Svg svg(plot.width_mm, height, plot.title, plot.description);
  draw_heading(svg, plot.title, plot.details);
  draw_alive(svg, plot, at);
  draw_markers(svg, plot, at);
  draw_names(svg, plot, at);
  draw_cells(svg, cells, at);
  draw_marks(svg, plot, at);
  const double steps_end = draw_steps(svg, plot, at);
  draw_scale(svg, steps_end + 2 + kTextSize);
  legend.draw(svg, steps_end + 2 + kLineHeight + 1.5);
  return svg.finish();
}

}  // namespace swarmsmith
