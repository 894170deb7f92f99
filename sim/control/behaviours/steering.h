#pragma once

#include <optional>
#include <span>

#include "sim/control/module_parts.h"
#include "sim/control/readings.h"

namespace swarmsmith {

/// What several behaviours have in common: obstacles, and the law of the treads.

/// What avoiding obstacles asks for.
UsedSenses senses_of_avoidance(const Flavour& flavour);

/// The neighbours that the flavour takes for obstacles.
std::span<const Neighbour> neighbours_in_the_way(Senses& senses, const ObstacleModel& model);

/// Along gain * w' - obstacle_gain * w_o (thesis eq. 5.1 to 5.6), where w' is `target`, or what the
/// flavour takes for it when there is nothing to steer by.
Command steer(double gain, const std::optional<Vector2>& target, double obstacle_gain,
              Senses& senses, const Flavour& flavour);

/// Towards the neighbours, away from them for a negative `weight`.
Command follow_neighbours(double gain, double weight, double obstacle_gain, Senses& senses,
                          const Flavour& flavour);

/// Alpha of Attraction and Repulsion as the flavour uses it.
double used_alpha(double alpha, const NeighbourModel& model);

/// Towards the light for sign 1, away from it for -1 (thesis eq. 5.1, 5.2).
Command follow_light(double sign, Senses& senses, const Flavour& flavour);

/// Treads that steer towards the vector (x, y) of the robot's frame at speed `speed_mps`: the tread
/// on the far side at full speed, the other at the cosine of the angle, or at `least_inner` where
/// that is more; only the direction counts, and the zero vector stands still (rvr-automode facts,
/// section 4.3).
Command command_towards(double x, double y, double speed_mps, double least_inner = -1);

}  // namespace swarmsmith
