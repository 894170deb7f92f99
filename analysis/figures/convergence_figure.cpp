#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "analysis/figures/convergence_plot.h"
#include "analysis/figures/design_choice.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/store_names.h"
#include "analysis/figures/makers.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// Designs in panels by mission and colours by method, both in the order of the store. A single
/// design has the colour of its method.
class PlotOfDesigns {
 public:
  PlotOfDesigns(const std::vector<DesignRecord>& designs, const StoreNames& names,
                double width_mm) {
    names_ = names;
    plot_.groups = names.methods;
    plot_.title = "Convergence";
    plot_.width_mm = width_mm;
    if (!designs.empty()) plot_.details.push_back(details_of(designs));
    for (const DesignRecord& design : designs)
      add(design);
    if (designs.size() != 1) return;
    const DesignRecord& alone = designs.front();
    plot_.groups[place_of(names.methods, alone.method)] =
        to_string(alone.design) + ", best candidate";
  }

  /// The elites of a design must follow each other; within an iteration they must be ordered by
  /// rank.
  void add(const EliteRecord& elite) {
    const auto place = places_.find(elite.design);
    if (place == places_.end()) return;
    auto& points = plot_.panels[place->second.first].lines[place->second.second].points;
    if (elite.rank == 1) {
      points.push_back(
          {static_cast<double>(elite.experiments_used), elite.mean, elite.mean, elite.mean});
    } else if (!points.empty()) {
      points.back().least_elite = std::min(points.back().least_elite, elite.mean);
      points.back().largest_elite = std::max(points.back().largest_elite, elite.mean);
    }
  }

  const ConvergencePlot& plot() const { return plot_; }

 private:
  static std::string details_of(const std::vector<DesignRecord>& designs) {
    if (designs.size() > 1) return fmt::format("Best candidate of {} designs", designs.size());
    return fmt::format("Best candidate of {}: {}", to_string(designs.front().design),
                       title_of(designs.front()));
  }

  void add(const DesignRecord& design) {
    const auto [panel, is_new_panel] = panels_.try_emplace(design.mission, panels_.size());
    if (is_new_panel)
      plot_.panels.push_back({.name = names_.title_of(design.mission), .lines = {}});
    const std::size_t color = place_of(plot_.groups, design.method);
    auto& lines = plot_.panels[panel->second].lines;
    places_[design.design] = {panel->second, lines.size()};
    lines.push_back({.name = to_string(design.design), .group = color, .points = {}});
  }

  StoreNames names_;
  ConvergencePlot plot_;
  std::map<std::string, std::size_t> panels_;
  std::map<DesignId, std::pair<std::size_t, std::size_t>> places_;  ///< panel and line
};

}  // namespace

Expected<Figure> convergence_figure(StoreReader& store, const FigureOptions& options) {
  const auto known = designs(store, options.filter);
  if (!known) return Unexpected(known.error());
  const auto all = elites(store, options.filter);
  if (!all) return Unexpected(all.error());
  if (all->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "no iteration of these designs has ended yet; `swarmsmith ls designs` shows "
                      "what the store has");
  }
  const auto names = names_of(store);
  if (!names) return Unexpected(names.error());
  // Baselines have no race.
  std::vector<DesignRecord> raced;
  for (const DesignRecord& design : *known) {
    if (std::ranges::find(*all, design.design, &EliteRecord::design) != all->end())
      raced.push_back(design);
  }
  // The same order of panels as in all figures.
  std::ranges::stable_sort(raced, {}, [&](const DesignRecord& design) {
    return place_of(names->missions, design.mission);
  });
  PlotOfDesigns made(raced, *names, options.width_mm);
  std::map<DesignId, const DesignRecord*> by_id;
  for (const DesignRecord& design : *known)
    by_id.emplace(design.design, &design);
  Figure figure{.csv = "design,mission,method,iteration,experiments_used,rank,candidate,mean,n\n"};
  for (const EliteRecord& elite : *all) {
    const auto design = by_id.find(elite.design);
    // Ignores a design that was added between the two queries.
    if (design == by_id.end()) continue;
    made.add(elite);
    figure.csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", elite.design.value,
                              csv_field(design->second->mission), csv_field(design->second->method),
                              elite.iteration, elite.experiments_used, elite.rank,
                              elite.candidate.value, elite.mean, elite.runs);
  }
  figure.svg = draw(for_paper(made.plot(), options));
  return figure;
}

}  // namespace swarmsmith
