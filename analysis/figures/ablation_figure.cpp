#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/design_choice.h"
#include "analysis/figures/makers.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr double kRowGap = 1.6;      ///< between the rows' texts, mm
constexpr double kMostLabel = 0.45;  ///< maximum part of the width for the changes' texts
constexpr double kRun = 0.5;         ///< radius of the dot for a run, mm
constexpr double kMean = 0.9;
constexpr double kBeyond = 3;  ///< to the right of the area, for half of the last tick's label

/// The cost of a rejected run, and the mean cost of its configuration.
constexpr double kRejectedCost = std::numeric_limits<double>::infinity();

/// One configuration on the way from the source to the target.
struct WayPoint {
  CandidateId candidate;
  std::int64_t step = 0;  ///< 0 is the source
  std::string change;     ///< "alpha: 1 -> 2.5", or "source"
  double mean_cost = 0;
  std::vector<std::pair<std::int64_t, double>> runs;  ///< pair and cost
};

using Values = std::map<std::string, std::string>;  ///< of one configuration, by parameter

/// The differences, sorted by parameter name; an inactive parameter is shown as NA.
std::string change_between(const Values& before, const Values& after) {
  std::string text;
  const auto value = [](const Values& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? std::string("NA") : found->second;
  };
  Values all = before;
  all.insert(after.begin(), after.end());
  for (const auto& [name, any] : all) {
    const std::string old_value = value(before, name);
    const std::string new_value = value(after, name);
    if (old_value == new_value) continue;
    text += fmt::format("{}{}: {} -> {}", text.empty() ? "" : ", ", name, old_value, new_value);
  }
  return text;
}

/// Each iteration is a step. The configuration that it adds to the way is the elite that was
/// created in the same iteration (irace_core/ablation.h).
Expected<std::vector<WayPoint>> read_way(StoreReader& store, const DesignRecord& design) {
  const auto kept = elites(store, {.design = design.design});
  if (!kept) return Unexpected(kept.error());
  const auto made = candidates(store, design.design);
  if (!made) return Unexpected(made.error());
  std::vector<WayPoint> way;
  std::vector<CandidateId> on_way;
  for (const EliteRecord& elite : *kept) {
    const auto own = std::ranges::find(*made, elite.candidate, &SampledRecord::candidate);
    // The last iteration also lists the configurations of earlier steps as its elites.
    if (own == made->end() || own->iteration != elite.iteration) continue;
    way.push_back({.candidate = elite.candidate,
                   .step = elite.iteration - 1,
                   .change = {},
                   .mean_cost = elite.runs > 0 ? -elite.mean : kRejectedCost,
                   .runs = {}});
    on_way.push_back(elite.candidate);
  }
  if (way.empty()) return way;
  const auto values = parameters(store, design.design, on_way);
  if (!values) return Unexpected(values.error());
  std::map<CandidateId, Values> of;
  for (const ParameterRecord& one : *values)
    of[one.candidate][one.parameter] = one.value;
  for (std::size_t i = 0; i < way.size(); ++i) {
    WayPoint& point = way[i];
    point.change =
        i == 0 ? "source" : change_between(of[way[i - 1].candidate], of[point.candidate]);
    const auto cells = race_cells(store, design.design, point.step + 1);
    if (!cells) return Unexpected(cells.error());
    for (const RaceCell& cell : *cells) {
      if (cell.candidate != point.candidate) continue;
      // Source and target stay on the way if they are rejected; the mean of an elite is of its
      // other runs.
      if (!cell.score) point.mean_cost = kRejectedCost;
      point.runs.emplace_back(cell.pair, cell.score ? -*cell.score : kRejectedCost);
    }
  }
  return way;
}

std::string csv_of(const std::vector<WayPoint>& way) {
  std::string csv = "step,candidate,change,mean_cost,pair,cost\n";
  for (const WayPoint& point : way) {
    for (const auto& [pair, cost] : point.runs) {
      csv += fmt::format("{},{},{},{},{},{}\n", point.step, point.candidate.value,
                         csv_field(point.change), point.mean_cost, pair, cost);
    }
  }
  return csv;
}

/// The text of its row.
std::string label_of(const WayPoint& point) {
  return point.change + (std::isfinite(point.mean_cost) ? "" : " (rejected)");
}

std::string draw(const std::vector<WayPoint>& way, const std::string& title,
                 const FigureOptions& options) {
  std::vector<double> costs;
  double widest = 0;
  for (const WayPoint& point : way) {
    if (std::isfinite(point.mean_cost)) costs.push_back(point.mean_cost);
    for (const auto& [pair, cost] : point.runs)
      if (std::isfinite(cost)) costs.push_back(cost);
    widest = std::max(widest, text_width(label_of(point), kTextSize));
  }
  const double label = std::min(widest, kMostLabel * options.width_mm);
  std::vector<std::vector<std::string>> labels;
  std::vector<double> middles;
  double height = 0;
  for (const WayPoint& point : way) {
    labels.push_back(whole_lines(label_of(point), kTextSize, label));
    const double row = kLineHeight * static_cast<double>(labels.back().size()) + kRowGap;
    middles.push_back(height + row / 2);
    height += row;
  }
  std::vector<std::string> details;
  if (!options.paper) {
    details = {counted(way.size() - 1, "step") + " from the source to the target",
               "dark: mean; pale: each run"};
  }
  const double head = kMargin + (options.paper ? 0 : kTitleSize) +
                      kLineHeight * static_cast<double>(details.size()) + 2;
  const PlotArea area{.left = kMargin + label + 2,
                      .top = head,
                      .width = options.width_mm - 2 * kMargin - label - 2 - kBeyond,
                      .height = height};
  std::string description = "Mean cost of each configuration on the way.";
  for (const WayPoint& point : way)
    description += std::isfinite(point.mean_cost)
                       ? fmt::format(" {}: {:.4g}.", point.change, point.mean_cost)
                       : fmt::format(" {}.", label_of(point));
  Svg svg(options.width_mm, area.bottom() + kHorizontalAxisRoom + kMargin, title, description);
  draw_heading(svg, title, details);
  const Axis wide(rounded(range_over(costs), kUsualTicks), area.left, area.right());
  const Axis x(rounded(range_over(costs), ticks_across(wide)), area.left, area.right());
  draw_horizontal_axis(svg, area, x, "cost (lower is better)");
  std::vector<PagePoint> means;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double y = area.top + middles[i];
    const double first = y - kLineHeight * (static_cast<double>(labels[i].size()) - 1) / 2;
    for (std::size_t k = 0; k < labels[i].size(); ++k) {
      svg.text({kMargin, first + kLineHeight * static_cast<double>(k) + kTextSize / 3},
               labels[i][k], ink(TextStyle::Anchor::Start));
    }
    std::vector<PagePoint> runs;
    for (const auto& [pair, cost] : way[i].runs)
      if (std::isfinite(cost)) runs.push_back({x.at(cost), y});
    svg.dots(runs, kRun, lightened(distinct_color(0), 0.6));
    if (std::isfinite(way[i].mean_cost)) means.push_back({x.at(way[i].mean_cost), y});
  }
  svg.line(means, stroked(distinct_color(0), 0.4));
  svg.dots(means, kMean, distinct_color(0));
  return svg.finish();
}

}  // namespace

Expected<Figure> ablation_figure(StoreReader& store, const FigureOptions& options) {
  const auto is_one = has_key(store, "ablation");
  if (!is_one) return Unexpected(is_one.error());
  if (!*is_one) {
    return unexpected(
        ErrorKind::NotFound,
        "the store has no ablation; `swarmsmith irace ablation` makes one, in a store "
        "beside the run's");
  }
  const auto design = chosen_design(store, options, "ablation");
  if (!design) return Unexpected(design.error());
  const auto way = read_way(store, *design);
  if (!way) return Unexpected(way.error());
  if (way->empty())
    return unexpected(ErrorKind::NotFound, "the ablation has not finished its first step yet");
  const std::string title = options.paper ? "" : "Ablation of " + title_of(*design);
  return Figure{.svg = draw(*way, title, options), .csv = csv_of(*way), .tex = {}, .dot = {}};
}

}  // namespace swarmsmith
