#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// A form for measuring where floor tags lie.
struct SurveySheetOptions {
  Arena arena;
  std::vector<int> ids;  ///< of the floor tags
  double edge_m = 0.1;   ///< of their black border
  Paper paper;
};

/// Where so many floor tags may lie: on a circle near the walls, heading along x. Four of them
/// cover just half of a dodecagon.
std::vector<Pose> suggested_places(const Arena& arena, std::size_t tags, double edge_m);

/// One page: the arena from above with a place for each tag, which corner of a tag is which, how
/// its angle counts, and a table to write the measured numbers into.
/// BadInput: no id, or more than the page has lines for.
Expected<std::string> survey_sheet(const SurveySheetOptions& options);

}  // namespace swarmsmith
