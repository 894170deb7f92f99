#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/engine/internal/contact_solver.h"

namespace swarmsmith {

/// A corner of a robot's square that lies in another robot's, or behind the face of a wall.
struct Contact {
  int a = 0;
  int b = -1;            ///< another robot of the island, or -1: a wall
  std::uint64_t id = 0;  ///< which corner meets what; the same from sub-step to sub-step
  double nx = 0;         ///< unit normal from a to the other
  double ny = 0;
  double ax = 0;  ///< from a's centre to the point of contact
  double ay = 0;
  double bx = 0;  ///< from b's
  double by = 0;
};

/// All contacts of an island as it stands, in a fixed order; replaces what was in `found`. Between
/// two squares the normal is the axis of least overlap. Walls count with their whole line, so the
/// arena must be convex.
void find_contacts(std::span<const IslandMember> island, std::span<const WallPlane> walls,
                   std::vector<Contact>& found);

/// For how many sub-steps, up to `most`, no contact is possible: gaps against the fastest approach.
int quiet_sub_steps(std::span<const IslandMember> island, std::span<const WallPlane> walls,
                    int most);

}  // namespace swarmsmith
