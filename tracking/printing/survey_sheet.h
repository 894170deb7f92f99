#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// A form for the survey of floor tags.
struct SurveySheetOptions {
  Arena arena;
  std::vector<int> ids;  ///< numbers of the floor tags
  double edge_m = 0.1;   ///< edge of their black border
  Paper paper;
};

/// Proposes positions for a number of floor tags: on a circle near the walls, with heading along x.
/// Four of them just cover half of a dodecagon.
std::vector<Pose> suggested_places(const Arena& arena, std::size_t tags, double edge_m);

/// A page with the arena from above and a position for each tag, an explanation of a tag's corners
/// and angle, and a table for the measured numbers. BadInput without an id, with more ids than
/// the page has lines, or for an edge, an area or tags that no arena file could have.
Expected<std::string> survey_sheet(const SurveySheetOptions& options);

}  // namespace swarmsmith
