#pragma once

#include <utility>

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// If the options ask for a paper, removes the parts that belong in its caption: title, details,
/// and the explanation.
template <class Plot>
Plot for_paper(Plot plot, const FigureOptions& options) {
  if (!options.paper) return plot;
  plot.title.clear();
  if constexpr (requires { plot.details; }) plot.details.clear();
  if constexpr (requires { plot.caption; }) plot.caption.clear();
  if constexpr (requires { plot.explained; }) plot.explained = false;
  return plot;
}

}  // namespace swarmsmith
