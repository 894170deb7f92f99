#pragma once

#include <string>
#include <vector>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// A timeline as SVG that shows how each robot's pose was obtained in each cycle: a strip per
/// robot, coloured by CycleKind, thinner for better kinds; ticks below a strip are samples that
/// were dropped. Issues that have a time are marked at the bottom with their codes.
std::string timeline(const TrackedRun& run, const std::vector<Issue>& issues, double width_mm);

}  // namespace swarmsmith
