#pragma once

#include <optional>
#include <string>

#include "sim/mission/mission.h"

namespace swarmsmith {

/// Whether the score depends only on the positions of the robots at the last instant.
bool is_scored_at_the_end(const ScoreRule& rule);

/// The nearest place where a robot's share of the score changes; its share is the score that it
/// would get alone.
struct NearestBorder {
  double distance_m = 0;
  std::string name;   ///< "black spot at (0, 0)", "green patch at (0.3, 0)"
  double here = 0;    ///< the robot's share at its place
  double beyond = 0;  ///< its share on the other side
};

/// The nearest border around a point, searched in all directions where the floor may change. Exact
/// for discs and rectangles that do not overlap, otherwise searched in steps of 1/1000 of a turn.
/// Nothing if there is no border, or if the score uses more than the last instant. `arena` includes
/// the patches of the run.
std::optional<NearestBorder> nearest_border(const ScoreRule& rule, const Arena& arena, Point point);

/// A patch as text: "black spot at (0, 0)".
std::string patch_text(const Patch& patch);

}  // namespace swarmsmith
