#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/figures/figure.h"
#include "analysis/figures/internal/store_names.h"
#include "analysis/figures/score_panels.h"
#include "analysis/records/records.h"

namespace swarmsmith {

/// Winners' scores prepared for drawing, one panel per mission.
struct GroupedScores {
  std::string by;  ///< the meaning of the colours: source, method or mission
  std::vector<ScorePanel> panels;
  std::vector<std::string>
      details;      ///< the number of scores and designs, and the meaning of a value
  std::string csv;  ///< one row per value
};

/// Groups scores by `by`; if it is empty, by source if there are several sources, else by method. A
/// group never mixes methods or sources: if there are several of both, each combination is a group.
/// Colours and order are those of the store.
GroupedScores grouped(const ChosenScores& taken, const StoreNames& names, std::string_view by);

/// Makes pairs if every method has exactly the same two sources, as usual in the field for
/// simulation beside another environment: the box of the first source is narrow, and both have the
/// method's name. Returns an explanation of the two widths. If a group has no partner, changes
/// nothing and returns an empty text.
std::string pair_boxes(std::vector<ScorePanel>& panels);

/// From a store. Errors: NotFound if no finished design has such a score.
Expected<GroupedScores> grouped_scores(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
