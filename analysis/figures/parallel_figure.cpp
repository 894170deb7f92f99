#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/design_choice.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/parameter_table.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/parallel_plot.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostAxes = 10;
constexpr std::size_t kMostNamed =
    14;  ///< the maximum number that the user can name; more would make too large a file
/// The maximum number of lines for other candidates, which show the range of what was tried. Each
/// takes some 250 characters of the file.
constexpr std::size_t kMostOthers = 250;

bool has_several_values(const ParameterColumn& column) {
  return column.is_category() ? column.categories.size() > 1 : column.low < column.high;
}

/// The parameters that most candidates have; among equal ones, those whose distribution changed
/// most come first.
std::vector<std::size_t> most_active(const ParameterTable& table) {
  std::vector<std::size_t> order;
  std::vector<double> moved(table.columns.size());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (!has_several_values(table.columns[i])) continue;
    order.push_back(i);
    moved[i] = movement(table.columns[i]);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (table.columns[a].active != table.columns[b].active)
      return table.columns[a].active > table.columns[b].active;
    return moved[a] > moved[b];
  });
  order.resize(std::min(order.size(), kMostAxes));
  return order;
}

/// The rows of the table that are drawn.
struct DrawnLines {
  std::vector<std::size_t> elites;
  std::vector<std::size_t> others;
  std::size_t others_in_all = 0;
  std::size_t every =
      1;  ///< interval between the others that are drawn, in the order in which they were sampled
  std::int64_t iteration = 0;
};

DrawnLines drawn_of(const ParameterTable& table, const std::vector<EliteRecord>& kept) {
  DrawnLines drawn;
  if (!kept.empty()) drawn.iteration = kept.back().iteration;
  std::set<std::size_t> is_elite;
  for (const EliteRecord& elite : kept) {
    const std::size_t row = table.row_of(elite.candidate);
    if (elite.iteration == drawn.iteration && row < table.candidates.size()) is_elite.insert(row);
  }
  std::vector<std::size_t> others;
  for (std::size_t row = 0; row < table.candidates.size(); ++row) {
    if (!table.candidates[row].mean) continue;
    (is_elite.contains(row) ? drawn.elites : others).push_back(row);
  }
  drawn.others_in_all = others.size();
  drawn.every = std::max<std::size_t>(1, (others.size() + kMostOthers - 1) / kMostOthers);
  for (std::size_t i = 0; i < others.size(); i += drawn.every)
    drawn.others.push_back(others[i]);
  return drawn;
}

ParallelPlot::Line line_of(const ParameterTable& table, const std::vector<std::size_t>& chosen,
                           std::size_t row, bool is_elite) {
  const SampledRecord& candidate = table.candidates[row];
  ParallelPlot::Line line{
      .name = to_string(candidate.candidate), .is_elite = is_elite, .mean = *candidate.mean};
  for (const std::size_t column : chosen)
    line.values.push_back(table.columns[column].values[row]);
  return line;
}

std::string csv_of(const ParallelPlot& plot, DesignId design) {
  std::string csv = "design,candidate,elite,mean,parameter,value\n";
  for (const auto& line : plot.lines) {
    for (std::size_t p = 0; p < plot.parameters.size(); ++p) {
      const auto& parameter = plot.parameters[p];
      std::string value;
      if (!std::isnan(line.values[p])) {
        value = parameter.categories.empty()
                    ? fmt::format("{}", line.values[p])
                    : csv_field(parameter.categories[static_cast<std::size_t>(line.values[p])]);
      }
      csv += fmt::format("{},{},{},{},{},{}\n", design.value, line.name.substr(1),
                         line.is_elite ? 1 : 0, line.mean, csv_field(parameter.name), value);
    }
  }
  return csv;
}

std::string caption_of(const DrawnLines& drawn, const FigureOptions& options, std::size_t shown,
                       std::size_t parameters) {
  std::string text = "Bold: elites. Pale: ";
  text +=
      drawn.every == 1
          ? "all other candidates that ran."
          : fmt::format("one in {} of the others that ran, in the order of sampling.", drawn.every);
  if (options.parameter.empty() && shown < parameters) {
    text += fmt::format(
        " The {} of {} parameters that most candidates have (of equal ones, those whose values "
        "moved most).",
        shown, parameters);
  }
  return text;
}

}  // namespace

Expected<Figure> parallel_figure(StoreReader& store, const FigureOptions& options) {
  const auto design = chosen_design(store, options, "parallel");
  if (!design) return Unexpected(design.error());
  const auto table = read_parameter_table(store, design->design);
  if (!table) return Unexpected(table.error());
  const auto kept = elites(store, {.design = design->design});
  if (!kept) return Unexpected(kept.error());
  auto chosen = named_columns(*table, options.parameter, kMostNamed);
  if (!chosen) return Unexpected(chosen.error());
  if (options.parameter.empty()) chosen = most_active(*table);
  const DrawnLines drawn = drawn_of(*table, *kept);
  if (drawn.elites.empty() && drawn.others.empty()) {
    return unexpected(ErrorKind::NotFound,
                      fmt::format("no candidate of {} has a score yet", to_string(design->design)));
  }

  ParallelPlot plot{.title = title_of(*design), .width_mm = options.width_mm};
  plot.details.push_back(fmt::format("{} of {}, iteration {}",
                                     counted(drawn.elites.size(), "elite"),
                                     to_string(design->design), drawn.iteration));
  plot.details.push_back(fmt::format("and {} of {}", drawn.others.size(),
                                     counted(drawn.others_in_all, "other candidate")));
  plot.caption = caption_of(drawn, options, chosen->size(), table->columns.size());
  for (const std::size_t place : *chosen) {
    const ParameterColumn& column = table->columns[place];
    plot.parameters.push_back({column.name, column.categories, column.low, column.high});
  }
  for (const std::size_t row : drawn.others)
    plot.lines.push_back(line_of(*table, *chosen, row, false));
  for (const std::size_t row : drawn.elites)
    plot.lines.push_back(line_of(*table, *chosen, row, true));
  Figure figure{.csv = csv_of(plot, design->design)};
  for (std::size_t i = 0; i < chosen->size(); ++i)
    plot.parameters[i].name = table->columns[(*chosen)[i]].words;
  figure.svg = draw(for_paper(plot, options));
  return figure;
}

}  // namespace swarmsmith
