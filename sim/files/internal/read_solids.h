#pragma once

#include <optional>

#include "base/text/table_reader.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// The keys of an outline: `shape` and its sizes. A polygon's corners may lie anywhere: they are
/// moved so that the origin is their centre of mass, and `pose`, in whose frame they were, with
/// them. Without a pose they are a robot's, whose other parts lie around the origin: they are
/// refused if that is not their centre of mass.
std::optional<Outline> read_outline(TableReader& table, Limits<double> size, Pose* pose);

/// The outline that the keys make of `base`, a robot's; without `shape` they change some of its
/// sizes, and must be those of its own shape. Nothing without any of the keys, and after a
/// complaint.
std::optional<Outline> read_changed_outline(TableReader& table, Limits<double> size,
                                            const Outline& base);

/// `obstacles`, `objects` and `lights` of [mission.arena], each in place of the preset's.
void read_solids(TableReader& arena, Arena& into);

}  // namespace swarmsmith
