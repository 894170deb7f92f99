#pragma once

#include "sim/engine/internal/form.h"
#include "sim/engine/internal/walls.h"

namespace swarmsmith {

/// How far a solid extends from its centre along a unit vector of the world.
double extent_along(const Form& form, const Body& at, double x, double y);

/// Gap in metres between two solids along the best separating axis among the normals of their
/// sides: a lower bound of their distance, negative when they overlap. For two RVRs it uses the
/// faster function of walls.h.
double gap_between(const Form& form, const Body& at, const Form& other, const Body& other_at);

/// The same between a solid and the face of a wall, which has finite length: a lower bound of their
/// distance from either side.
double gap_to(const Form& form, const Body& at, const WallPlane& wall);

}  // namespace swarmsmith
