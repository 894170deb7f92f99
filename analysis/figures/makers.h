#pragma once

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// One maker a kind of figure (figure.h); each in a file of its own, with the plot's data and its
/// drawing beside it.

Expected<Figure> convergence_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> ranks_figure(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
