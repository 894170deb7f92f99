#include "analysis/figures/rank_plot.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/comparison/comparison.h"
#include "analysis/comparison/comparison_tables.h"
#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/makers.h"

namespace swarmsmith {
namespace {

constexpr double kRowHeight = 7;
constexpr double kDot = 1.1;
constexpr double kCap = 1.2;            ///< half the height of the caps of an interval
constexpr double kMostNamePart = 0.36;  ///< maximum part of the width for the names
constexpr std::size_t kNameLines = 2;
constexpr std::string_view kBand = "#e4e4e4";
constexpr std::string_view kGuide = "#d0d0d0";
constexpr std::string_view kRankLabel = "mean rank (1 is best)";

/// The best is on top; ties stay in their order.
std::vector<RankPlot::Row> by_rank(std::vector<RankPlot::Row> rows) {
  std::ranges::stable_sort(rows, {}, &RankPlot::Row::mean);
  return rows;
}

ValueRange range_of(const RankPlot::Panel& panel) {
  std::vector<double> ends = {1, static_cast<double>(panel.rows.size())};
  for (const RankPlot::Row& row : panel.rows) {
    if (!row.interval) continue;
    ends.push_back(row.interval->first);
    ends.push_back(row.interval->second);
  }
  return rounded(range_over(ends), kUsualTicks);
}

/// The text above a panel's rows, broken into lines that fit.
std::vector<std::string> lines_of(const RankPlot::Panel& panel, double width) {
  constexpr std::size_t kMostLines = 4;
  std::vector<std::string> lines;
  for (const std::string& detail : panel.details) {
    for (std::string& line : broken_text(detail, kTextSize, width, kMostLines))
      lines.push_back(std::move(line));
  }
  return lines;
}

double title_room(const RankPlot::Panel& panel) {
  return panel.title.empty() ? 0 : kLineHeight + 1;
}

double height_of(const RankPlot::Panel& panel, double width) {
  return title_room(panel) + kLineHeight * static_cast<double>(lines_of(panel, width).size()) + 2 +
         kRowHeight * static_cast<double>(panel.rows.size()) + kHorizontalAxisRoom + 3;
}

void draw_range(Svg& svg, PagePoint from, PagePoint to, std::string_view color, double width) {
  const std::array<PagePoint, 2> ends = {from, to};
  svg.line(ends, stroked(color, width));
}

void draw_row(Svg& svg, const RankPlot::Row& row, double y, const Axis& x) {
  if (row.interval) {
    const double low = x.at(row.interval->first);
    const double high = x.at(row.interval->second);
    draw_range(svg, {low, y}, {high, y}, kInk, 0.4);
    for (const double end : {low, high})
      draw_range(svg, {end, y - kCap}, {end, y + kCap}, kInk, 0.4);
  }
  svg.circle({x.at(row.mean), y}, kDot, filled(distinct_color(0)));
}

void draw_name(Svg& svg, const std::string& name, double right, double y, double width) {
  const auto lines = broken_text(name, kTextSize, width, kNameLines);
  const double above = kLineHeight * 0.8 * static_cast<double>(lines.size() - 1) / 2;
  double base = y + 0.36 * kTextSize - above;
  for (const std::string& line : lines) {
    svg.text({right, base}, line,
             {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
    base += 0.8 * kLineHeight;
  }
}

double name_room(const RankPlot& plot) {
  double widest = 0;
  for (const RankPlot::Panel& panel : plot.panels) {
    for (const RankPlot::Row& row : panel.rows)
      widest = std::max(widest, text_width(row.name, kTextSize));
  }
  return std::min(widest, kMostNamePart * plot.width_mm);
}

/// Returns the top of the next panel.
double draw_panel(Svg& svg, const RankPlot::Panel& panel, double top, double names) {
  const double width = svg.width() - 2 * kMargin;
  double y = top;
  if (!panel.title.empty()) {
    y += kTextSize;
    svg.text({kMargin, y}, fitted_text(panel.title, kTextSize * kBolder, width),
             {.size = kTextSize, .bold = true, .fill = std::string(kInk)});
    y = top + title_room(panel);
  }
  for (const std::string& line : lines_of(panel, width)) {
    svg.text({kMargin, y + kTextSize}, line, {.size = kTextSize, .fill = std::string(kInk)});
    y += kLineHeight;
  }
  const double left = kMargin + names + 2;
  const PlotArea area{.left = left,
                      .top = y + 2,
                      .width = svg.width() - kMargin - 2 - left,
                      .height = kRowHeight * static_cast<double>(panel.rows.size())};
  const Axis x(range_of(panel), area.left, area.right());
  const std::vector<RankPlot::Row> rows = by_rank(panel.rows);
  if (rows.front().interval) {
    const double low = x.at(rows.front().interval->first);
    const double high = x.at(rows.front().interval->second);
    const std::array<PagePoint, 4> band = {PagePoint{low, area.top}, PagePoint{high, area.top},
                                           PagePoint{high, area.bottom()},
                                           PagePoint{low, area.bottom()}};
    svg.polygon(band, filled(kBand));
  }
  draw_horizontal_axis(svg, area, x, kRankLabel);
  const Bands places(rows.size(), area.top, area.bottom());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double at = places.centre(i);
    draw_range(svg, {area.left, at}, {area.right(), at}, kGuide, 0.15);
    draw_name(svg, rows[i].name, area.left - 1.5, at, names);
    draw_row(svg, rows[i], at, x);
  }
  return top + height_of(panel, width);
}

/// "grid_exploration" in words, for a sentence.
std::string missions_of(const ComparedRanks& ranks) {
  std::string names = fmt::format("{}", fmt::join(ranks.missions, ", "));
  std::ranges::replace(names, '_', ' ');
  return names;
}

/// A single panel needs no title, because its source is in the details.
RankPlot::Panel panel_of(const ComparedRanks& ranks, CompareBy by, bool alone) {
  const FriedmanTest& test = ranks.test;
  RankPlot::Panel panel{.title = alone ? "" : ranks.source};
  panel.details.push_back(
      fmt::format("{} {}{}: {}", test.blocks, by == CompareBy::Method ? "missions" : "designs",
                  alone && !ranks.source.empty() ? " in " + ranks.source : "", missions_of(ranks)));
  panel.details.push_back(
      test.p_value
          ? fmt::format(
                "Friedman: \u03c7\u00b2\u00a0=\u00a0{:.4g}, df\u00a0{}, p\u00a0=\u00a0{:.3g}",
                test.statistic, test.degrees, *test.p_value)
          : "All values are tied: there is no test");
  for (std::size_t i = 0; i < ranks.names.size(); ++i) {
    const double mean = test.mean_ranks[i];
    panel.rows.push_back({ranks.names[i], mean});
    if (const auto interval = test.told_interval(i))
      panel.rows.back().interval = {interval->low, interval->high};
  }
  return panel;
}

/// By method if there are several methods, else by source.
Expected<Comparison> ranked(StoreReader& store, const FigureOptions& options) {
  ComparisonOptions asked{.by = CompareBy::Method,
                          .method = options.filter.method,
                          .source = options.source,
                          .choice = options.choice};
  if (!options.filter.mission.empty()) asked.missions = {options.filter.mission};
  if (options.by == "mission")
    return bad_input("missions are not ranked: their scores have different units", "--by");
  if (options.by == "source") asked.by = CompareBy::Source;
  auto comparison = compare(store, asked);
  if (!comparison || !comparison->ranks.empty() || !options.by.empty()) return comparison;
  asked.by = CompareBy::Source;
  return compare(store, asked);
}

}  // namespace

std::string draw(const RankPlot& plot) {
  const double width = plot.width_mm - 2 * kMargin;
  const auto footer =
      broken_text(plot.explained ? plot.reading : std::string(), kTextSize, width, 3);
  double height = kMargin + kTitleSize + 2 + kLineHeight * static_cast<double>(footer.size());
  for (const RankPlot::Panel& panel : plot.panels)
    height += height_of(panel, width);
  Svg svg(plot.width_mm, height + kMargin, plot.title, "Mean ranks with intervals of 95 %");
  double y = draw_heading(svg, plot.title, {});
  const double names = name_room(plot);
  for (const RankPlot::Panel& panel : plot.panels)
    y = draw_panel(svg, panel, y, names);
  for (const std::string& line : footer) {
    svg.text({kMargin, y + kTextSize}, line, {.size = kTextSize, .fill = std::string(kInk)});
    y += kLineHeight;
  }
  return svg.finish();
}

Expected<Figure> ranks_figure(StoreReader& store, const FigureOptions& options) {
  auto comparison = ranked(store, options);
  if (!comparison) return Unexpected(comparison.error());
  if (comparison->ranks.empty()) {
    const std::string why = comparison->unranked.empty()
                                ? "no source has scores of two methods"
                                : fmt::format("{}", fmt::join(comparison->unranked, "; "));
    return unexpected(ErrorKind::NotFound, "there is nothing to rank: " + why);
  }
  // The source of the campaign's tests comes first, as in other figures.
  std::stable_partition(
      comparison->ranks.begin(), comparison->ranks.end(),
      [&](const ComparedRanks& ranks) { return ranks.source == comparison->tested; });
  RankPlot plot{.title = fmt::format("Ranks by {}", name_of(comparison->options.by)),
                .width_mm = options.width_mm};
  const bool alone = comparison->ranks.size() == 1;
  const FriedmanTest& first = comparison->ranks.front().test;
  const bool read_alike = std::ranges::all_of(comparison->ranks, [&](const ComparedRanks& ranks) {
    return ranks.test.reading() == first.reading();
  });
  if (read_alike) plot.reading = first.reading();
  for (const ComparedRanks& ranks : comparison->ranks) {
    plot.panels.push_back(panel_of(ranks, comparison->options.by, alone));
    std::vector<std::string>& details = plot.panels.back().details;
    details.insert(details.end(), comparison->seeds.begin(), comparison->seeds.end());
    if (!read_alike) details.emplace_back(ranks.test.reading());
  }
  const bool has_band = std::ranges::any_of(comparison->ranks, [](const ComparedRanks& ranks) {
    return ranks.test.told_interval(0).has_value();
  });
  if (read_alike && has_band) plot.reading += " Grey: the best one's.";
  return Figure{.svg = draw(for_paper(plot, options)), .csv = ranks_csv(comparison->ranks)};
}

}  // namespace swarmsmith
