#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/figures/figure.h"
#include "analysis/figures/internal/store_names.h"
#include "analysis/figures/score_panels.h"
#include "analysis/records/records.h"

namespace swarmsmith {

/// Scores of winners, a panel a mission, ready to be drawn.
struct GroupedScores {
  std::string by;  ///< what the colours stand for: source, method or mission
  std::vector<ScorePanel> panels;
  std::vector<std::string> details;  ///< how many scores of what
  std::string csv;                   ///< a row a value
};

/// Groups scores by `by`; without one by source where there are several, else by method. Neither
/// several methods nor several sources ever get into one group: those of the other kind make groups
/// of their own. Colours and order are the store's.
GroupedScores grouped(const ChosenScores& taken, const StoreNames& names, std::string_view by);

/// Two sources of each method become pairs, as the field draws simulation beside another world: the
/// first narrow, both with the method's name. Returns what tells them apart, in words; nothing, and
/// changes nothing, where a group has no partner.
std::string pair_boxes(std::vector<ScorePanel>& panels);

/// Of a store. Errors: NotFound when no finished design has such a score.
Expected<GroupedScores> grouped_scores(StoreReader& store, const FigureOptions& options);

}  // namespace swarmsmith
