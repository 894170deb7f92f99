#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/surroundings.h"

namespace swarmsmith {

/// Where a robot's square lies in another robot's, in an obstacle, or behind the face of a wall: a
/// corner of one of the two, or the point of the square that is deepest in a circle.
struct Contact {
  int a = 0;
  int b = -1;            ///< another robot, or -1: what never moves
  std::uint64_t id = 0;  ///< which corner meets what; the same as long as it does
  double nx = 0;         ///< unit normal from a to the other
  double ny = 0;
  double ax = 0;  ///< from a's centre to the point of contact
  double ay = 0;
  double bx = 0;  ///< from b's
  double by = 0;
};

/// All contacts of an island of RVRs as it stands, in the order of their ids; replaces what was in
/// `found`. Between two solids the normal is the axis of least overlap. Walls count with their
/// whole line, so the arena must be convex.
void find_contacts(std::span<const Mover> movers, const Island& island,
                   const Surroundings& surroundings, std::vector<Contact>& found);

/// For how many sub-steps, up to `most`, no contact is possible: gaps against the fastest approach.
int quiet_sub_steps(std::span<const Mover> movers, const Island& island,
                    const Surroundings& surroundings, int most);

}  // namespace swarmsmith
