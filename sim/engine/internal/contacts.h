#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/surroundings.h"

namespace swarmsmith {

/// A place where a robot's square overlaps another robot's square, an obstacle, or the face of a
/// wall: a corner of one of the two inside the other, or the point of the square that is deepest in
/// a circle.
struct Contact {
  int a = 0;
  int b = -1;            ///< another robot, or -1 for a fixed body
  std::uint64_t id = 0;  ///< identifies the corner and the bodies; stays the same as long as the
                         ///< contact lasts
  double nx = 0;         ///< unit normal from a to the other body
  double ny = 0;
  double ax = 0;  ///< from a's centre to the contact point
  double ay = 0;
  double bx = 0;  ///< from b's centre to the contact point
  double by = 0;
};

/// All contacts of an island of RVRs at their present poses, in the order of their ids; replaces
/// the content of `found`. Between two solids the normal is the axis of least overlap. A wall
/// counts as an infinite line, so the arena must be convex.
void find_contacts(std::span<const Mover> movers, const Island& island,
                   const Surroundings& surroundings, std::vector<Contact>& found);

/// The number of sub-steps, up to `most`, in which no contact is possible: computed from the gaps
/// and the fastest possible approach.
int quiet_sub_steps(std::span<const Mover> movers, const Island& island,
                    const Surroundings& surroundings, int most);

}  // namespace swarmsmith
