#pragma once

#include <optional>
#include <span>

#include "sim/control/module_parts.h"
#include "sim/control/readings.h"

namespace swarmsmith {

/// Functions that several behaviours share: avoiding obstacles, and the speeds of the treads.

/// The readings that obstacle avoidance requests.
UsedSenses senses_of_avoidance(const Flavour& flavour);

/// The neighbours that the flavour treats as obstacles.
std::span<const Neighbour> neighbours_in_the_way(Senses& senses, const ObstacleModel& model);

/// Steers along gain * w' - obstacle_gain * w_o (thesis eq. 5.1 to 5.6). w' is `target`, or the
/// flavour's default if there is nothing to follow.
Command steer(double gain, const std::optional<Vector2>& target, double obstacle_gain,
              Senses& senses, const Flavour& flavour);

/// Steers towards the neighbours, or away from them if `weight` is negative.
Command follow_neighbours(double gain, double weight, double obstacle_gain, Senses& senses,
                          const Flavour& flavour);

/// The alpha of Attraction and Repulsion as the flavour applies it.
double used_alpha(double alpha, const NeighbourModel& model);

/// Steers towards the light if `sign` is 1, away from it if it is -1 (thesis eq. 5.1, 5.2).
Command follow_light(double sign, Senses& senses, const Flavour& flavour);

/// Tread speeds that steer towards the vector (x, y) in the robot's frame at speed `speed_mps`: the
/// outer tread runs at full speed, the inner one at the cosine of the angle times that speed, but
/// at no less than `least_inner` times it. Only the direction of the vector counts; for the zero
/// vector the robot stands still (rvr-automode facts, section 4.3).
Command command_towards(double x, double y, double speed_mps, double least_inner = -1);

}  // namespace swarmsmith
