#pragma once

#include <string>
#include <vector>

#include "tracking/motion/tracked_run.h"

namespace swarmsmith {

/// How each robot's pose was obtained, cycle by cycle, as SVG: a strip a robot, coloured by
/// CycleKind, the better the thinner; ticks below it are samples that were dropped. The issues that
/// have a time are marked below, each with its code.
std::string timeline(const TrackedRun& run, const std::vector<Issue>& issues, double width_mm);

}  // namespace swarmsmith
