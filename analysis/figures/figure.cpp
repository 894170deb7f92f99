#include "analysis/figures/figure.h"

#include <algorithm>
#include <array>

#include "analysis/figures/makers.h"

namespace swarmsmith {

std::span<const FigureKind> figure_kinds() {
  static constexpr std::array kKinds = {
      FigureKind{"convergence", "Mean of the elites over the experiments used", convergence_figure},
      FigureKind{"ranks", "Mean ranks of methods or sources with Friedman's 95 % intervals",
                 ranks_figure},
  };
  return kKinds;
}

const FigureKind* find_figure_kind(std::string_view name) {
  const auto kinds = figure_kinds();
  const auto found = std::ranges::find(kinds, name, &FigureKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace swarmsmith
