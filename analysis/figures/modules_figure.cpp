#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/makers.h"
#include "analysis/figures/module_chart.h"
#include "analysis/records/names.h"
#include "base/text/csv.h"
#include "sim/control/module.h"

namespace swarmsmith {
namespace {

using WinnerCounts = std::map<std::pair<std::string, std::string>, std::size_t>;

/// Behaviours come before conditions, as in the papers; modules unknown to this program come last.
bool stands_before(const std::string& a, const std::string& b) {
  const auto place = [](const std::string& id) {
    const auto module = module_from_id(id);
    return module ? static_cast<int>(*module) : 1000;
  };
  return std::tuple(place(a), a) < std::tuple(place(b), b);
}

/// The number of winners for each (method, mission).
WinnerCounts winners_of(const std::vector<DesignRecord>& all) {
  WinnerCounts counts;
  for (const DesignRecord& design : all)
    if (design.state == "finished" && design.best) ++counts[{design.method, design.mission}];
  return counts;
}

/// By method, then mission, then module.
void sort_as_drawn(std::vector<ModuleFrequency>& frequencies) {
  std::ranges::sort(frequencies, [](const ModuleFrequency& a, const ModuleFrequency& b) {
    const auto group_a = std::tie(a.method, a.mission);
    const auto group_b = std::tie(b.method, b.mission);
    return group_a != group_b ? group_a < group_b : stands_before(a.module, b.module);
  });
}

/// The ids of all modules, in the order of the rows.
std::vector<std::string> ids_of(const std::vector<ModuleFrequency>& frequencies) {
  std::vector<std::string> ids;
  for (const ModuleFrequency& frequency : frequencies)
    if (std::ranges::find(ids, frequency.module) == ids.end()) ids.push_back(frequency.module);
  std::ranges::sort(ids, stands_before);
  return ids;
}

/// The reason why there is nothing to draw.
std::string why_nothing(const std::vector<DesignRecord>& all, const WinnerCounts& counts) {
  if (counts.empty())
    return "none of these designs is finished yet; `swarmsmith ls designs` shows how far they are";
  const bool is_software =
      std::ranges::any_of(all, [](const DesignRecord& design) { return !design.flavour.empty(); });
  return is_software ? "the winners have no modules: they are neural networks; `figure machine` "
                       "draws their weights"
                     : "the winners have no modules: they configure a program";
}

/// Adds a number of the sorted table to the chart.
void add(ModuleChart& chart, const ModuleFrequency& frequency, std::size_t designs,
         const std::vector<std::string>& ids) {
  if (chart.blocks.empty() || chart.blocks.back().method != frequency.method)
    chart.blocks.push_back({.method = frequency.method});
  auto& columns = chart.blocks.back().columns;
  const std::string mission = as_words(frequency.mission);
  if (columns.empty() || columns.back().mission != mission)
    columns.push_back({mission, designs, std::vector<std::optional<ModuleCounts>>(ids.size())});
  const auto place = std::ranges::find(ids, frequency.module) - ids.begin();
  columns.back().cells[static_cast<std::size_t>(place)] = frequency.counts;
}

}  // namespace

Expected<Figure> modules_figure(StoreReader& store, const FigureOptions& options) {
  const auto all = designs(store, options.filter);
  if (!all) return Unexpected(all.error());
  const WinnerCounts counts = winners_of(*all);
  auto frequencies = module_frequencies(store, options.filter);
  if (!frequencies) return Unexpected(frequencies.error());
  if (frequencies->empty()) return unexpected(ErrorKind::NotFound, why_nothing(*all, counts));
  sort_as_drawn(*frequencies);
  const std::vector<std::string> ids = ids_of(*frequencies);
  ModuleChart chart{.title = "Modules of the winners", .width_mm = options.width_mm};
  Figure figure{.csv =
                    "mission,method,module,designs,avg_occurrences,occurrence_rate,"
                    "avg_reachable,reachable_rate\n"};
  for (const ModuleFrequency& frequency : *frequencies) {
    const std::size_t designs = counts.at({frequency.method, frequency.mission});
    add(chart, frequency, designs, ids);
    figure.csv += fmt::format("{},{},{},{},", csv_field(frequency.mission),
                              csv_field(frequency.method), csv_field(frequency.module), designs);
    const auto& often = frequency.counts;
    figure.csv +=
        often ? fmt::format("{},{},{},{}\n", often->average_occurrences, often->occurrence_rate,
                            often->average_reachable, often->reachable_rate)
              : ",,,\n";
  }
  std::ranges::transform(ids, std::back_inserter(chart.modules), as_words);
  figure.svg = draw(for_paper(chart, options));
  return figure;
}

}  // namespace swarmsmith
