#pragma once

#include <utility>

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// The plot without what a paper says in its caption, when that is asked for: title, details, and
/// how to read it.
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
