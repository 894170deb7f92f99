#pragma once

#include <optional>

#include "base/text/table_reader.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// Limits of the sizes of a robot's body, in metres.
inline constexpr Limits<double> kBodySize{0.005, 5};

/// Reads the keys of an outline: `shape` and its sizes. The corners of a polygon may have any
/// origin: they are moved so that the origin becomes their centre of mass, and `pose`, which refers
/// to the same frame, is moved with them. Without a pose the corners are those of a robot, whose
/// other parts refer to the same origin: then it is an error if the origin is not their centre of
/// mass.
std::optional<Outline> read_outline(TableReader& table, Limits<double> size, Pose* pose);

/// The outline that the table's keys make of the outline `base` of a robot. Without `shape`, the
/// keys change some sizes of the base, and must be keys of its shape. Nothing if there are no such
/// keys, and after a complaint.
std::optional<Outline> read_changed_outline(TableReader& table, Limits<double> size,
                                            const Outline& base);

/// Reads `obstacles`, `objects` and `lights` of [mission.arena]; each replaces the preset's list.
void read_solids(TableReader& arena, Arena& into);

}  // namespace swarmsmith
