#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/design_choice.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/parameter_table.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/sampling_plot.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostPanels = 12;
constexpr double kWide = 120;  ///< mm: from this width on, a line has more panels
constexpr std::size_t kParts = 16, kManyParts = 32;

/// The indices of the columns whose distribution changed most, in descending order.
std::vector<std::size_t> most_moved(const ParameterTable& table) {
  std::vector<double> moved;
  moved.reserve(table.columns.size());
  for (const ParameterColumn& column : table.columns)
    moved.push_back(movement(column));
  std::vector<std::size_t> order(table.columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return moved[a] > moved[b]; });
  order.resize(std::min(order.size(), kMostPanels));
  return order;
}

/// The index of each iteration that sampled candidates.
std::map<std::int64_t, std::size_t> sampled_iterations(const ParameterTable& table) {
  std::map<std::int64_t, std::size_t> places;
  for (const SampledRecord& candidate : table.candidates)
    places.emplace(candidate.iteration, 0);
  std::size_t next = 0;
  for (auto& [iteration, place] : places)
    place = next++;
  return places;
}

SamplingPlot::Panel panel_of(const ParameterTable& table, const ParameterColumn& column,
                             const std::map<std::int64_t, std::size_t>& iterations,
                             const std::vector<EliteRecord>& kept, std::size_t parts) {
  SamplingPlot::Panel panel{.name = column.name,
                            .categories = column.categories,
                            .low = column.low,
                            .high = column.high,
                            .columns = std::vector<SamplingPlot::Column>(iterations.size())};
  if (column.is_whole && column.high - column.low < static_cast<double>(parts)) {
    panel.is_whole = true;
    panel.low -= 0.5;
    panel.high += 0.5;
    parts = static_cast<std::size_t>(panel.high - panel.low);
  }
  const std::size_t kinds = column.is_category() ? column.categories.size() : parts;
  for (auto& drawn : panel.columns)
    drawn.counts.resize(kinds, 0);
  const double width = panel.high > panel.low ? panel.high - panel.low : 1;
  for (std::size_t i = 0; i < table.candidates.size(); ++i) {
    auto& drawn = panel.columns[iterations.at(table.candidates[i].iteration)];
    ++drawn.candidates;
    const double value = column.values[i];
    if (std::isnan(value)) continue;
    const double place =
        column.is_category() ? value : static_cast<double>(parts) * (value - panel.low) / width;
    ++drawn.counts[std::min(static_cast<std::size_t>(place), kinds - 1)];
  }
  for (const EliteRecord& elite : kept) {
    const auto place = iterations.find(elite.iteration);
    const std::size_t row = table.row_of(elite.candidate);
    if (place == iterations.end() || row == table.candidates.size()) continue;
    if (std::isnan(column.values[row])) continue;
    panel.columns[place->second].elites.push_back(column.values[row]);
  }
  return panel;
}

/// One row per counted item: a value, or the lower and upper end of a part of the range.
std::string csv_of(const SamplingPlot& plot, DesignId design) {
  std::string csv = "design,parameter,iteration,candidates,kind,value,low,high,count\n";
  for (const auto& panel : plot.panels) {
    for (std::size_t at = 0; at < panel.columns.size(); ++at) {
      const auto& column = panel.columns[at];
      const std::string key = fmt::format("{},{},{},{}", design.value, csv_field(panel.name),
                                          plot.iterations[at], column.candidates);
      const double part = (panel.high - panel.low) /
                          static_cast<double>(std::max<std::size_t>(1, column.counts.size()));
      std::int64_t active = 0;
      for (std::size_t i = 0; i < column.counts.size(); ++i) {
        active += column.counts[i];
        if (!panel.categories.empty()) {
          csv += fmt::format("{},value,{},,,{}\n", key, csv_field(panel.categories[i]),
                             column.counts[i]);
        } else {
          const double low = panel.low + part * static_cast<double>(i);
          csv += fmt::format("{},range,,{},{},{}\n", key, low, low + part, column.counts[i]);
        }
      }
      csv += fmt::format("{},not active,,,,{}\n", key, column.candidates - active);
      std::map<double, std::size_t> elites;
      for (const double value : column.elites)
        ++elites[value];
      for (const auto& [value, count] : elites) {
        const std::string text = panel.categories.empty()
                                     ? fmt::format("{}", value)
                                     : csv_field(panel.categories[static_cast<std::size_t>(value)]);
        csv += fmt::format("{},elite,{},,,{}\n", key, text, count);
      }
    }
  }
  return csv;
}

}  // namespace

Expected<Figure> sampling_figure(StoreReader& store, const FigureOptions& options) {
  const auto design = chosen_design(store, options, "sampling");
  if (!design) return Unexpected(design.error());
  const auto table = read_parameter_table(store, design->design);
  if (!table) return Unexpected(table.error());
  const auto kept = elites(store, {.design = design->design});
  if (!kept) return Unexpected(kept.error());
  const bool is_named = !options.parameter.empty();
  auto chosen = named_columns(*table, options.parameter, kMostPanels);
  if (!chosen) return Unexpected(chosen.error());
  if (!is_named) chosen = most_moved(*table);

  const auto iterations = sampled_iterations(*table);
  SamplingPlot plot{.title = title_of(*design), .width_mm = options.width_mm};
  plot.details.push_back(fmt::format("Values that {} sampled, {}", to_string(design->design),
                                     counted(table->candidates.size(), "candidate")));
  for (const auto& [iteration, place] : iterations)
    plot.iterations.push_back(iteration);
  const bool is_wide = options.width_mm >= kWide;
  const std::size_t small = is_wide ? 4 : 3;
  const std::size_t large = is_wide ? 2 : 1;
  plot.panels_a_line = is_named ? large : small;
  for (const std::size_t column : *chosen) {
    plot.panels.push_back(panel_of(*table, table->columns[column], iterations, *kept,
                                   is_named ? kManyParts : kParts));
  }
  plot.caption =
      "Shares are of an iteration's candidates; blank: not active. A density of 1 is an even "
      "spread "
      "of its active values.";
  if (!is_named && table->columns.size() > plot.panels.size()) {
    plot.caption += fmt::format(
        " The {} of {} parameters that moved most between the first and the last third of the "
        "candidates (total variation).",
        plot.panels.size(), table->columns.size());
  }
  Figure figure{.csv = csv_of(plot, design->design)};
  for (std::size_t i = 0; i < chosen->size(); ++i)
    plot.panels[i].name = table->columns[(*chosen)[i]].words;
  figure.svg = draw(for_paper(plot, options));
  return figure;
}

}  // namespace swarmsmith
