#pragma once

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// One function per kind of figure (figure.h), each in its own file beside the data and the drawing
/// of its plot.

Expected<Figure> box_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> convergence_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> modules_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> scores_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> machine_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> race_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> sampling_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> parallel_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> gap_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> training_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> importance_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> ranks_figure(StoreReader& store, const FigureOptions& options);
Expected<Figure> ablation_figure(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
