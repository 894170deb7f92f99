#pragma once

#include <optional>
#include <string>

#include "sim/mission/mission.h"

namespace swarmsmith {

/// Whether the score depends on where the robots are at the last instant alone.
bool is_scored_at_the_end(const ScoreRule& rule);

/// The nearest place where a robot's share of the score, which is what it would score alone, is
/// another one.
struct NearestBorder {
  double distance_m = 0;
  std::string name;   ///< "black spot at (0, 0)", "green patch at (0.3, 0)"
  double here = 0;    ///< the robot's share
  double beyond = 0;  ///< its share on the other side
};

/// The border nearest to a point, looked for in all directions to where the floor changes; exact
/// for discs and rectangles that do not overlap, else to the 1/1000 of a turn. Nothing when there
/// is none, or when the score looks at more than the last instant. `arena` with the patches of the
/// run.
std::optional<NearestBorder> nearest_border(const ScoreRule& rule, const Arena& arena, Point point);

/// "black spot at (0, 0)".
std::string patch_text(const Patch& patch);

}  // namespace swarmsmith
