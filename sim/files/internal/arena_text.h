#pragma once

#include <string>
#include <vector>

#include "base/text/toml_text.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The lines of [mission.arena].
std::vector<SectionLine> arena_lines(const Mission& mission);

/// The points as [[0, 0], [1, 0.5]].
std::string point_list(const std::vector<Point>& points);

/// The keys of an outline: `shape = "box", length = 1, width = 0.5`.
std::string outline_text(const Outline& outline);

/// The same, one key per line.
std::vector<SectionLine> outline_lines(const Outline& outline);

/// The keys x, y and theta of a pose.
std::string pose_text(const Pose& pose);

/// The keys x, y, width and height; squares are written as rectangles, too.
std::string rectangle_text(const Rectangle& shape);

}  // namespace swarmsmith
