#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// The limits of a field, both included.
struct FlavourLimits {
  double least = 0;
  double most = 0;
};

/// The values that a field may have, with their words in the file.
template <class Value, std::size_t Count = 2>
using FlavourChoices = std::array<std::pair<std::string_view, Value>, Count>;

/// Files have gray levels from 0 to 255, flavours have thousandths of them, as `gray_level` gives.
inline constexpr double kGrayThousandths = 1000;

inline constexpr FlavourChoices<ObstacleModel::Reading, 3> kObstacleReadings = {
    {{"linear", ObstacleModel::Reading::Linear},
     {"1/d", ObstacleModel::Reading::InverseDistance},
     {"as sensed", ObstacleModel::Reading::AsSensed}}};
inline constexpr FlavourChoices<ExplorationModel::Trigger, 3> kTurnTriggers = {
    {{"front readings", ExplorationModel::Trigger::FrontReadings},
     {"vector sum", ExplorationModel::Trigger::VectorSum},
     {"front readings, side of the sum", ExplorationModel::Trigger::FrontThenSum}}};
inline constexpr FlavourChoices<ExplorationModel::TurnLength> kTurnLengths = {
    {{"0 to tau", ExplorationModel::TurnLength::ZeroToTau},
     {"0 to tau - 1, at least 1", ExplorationModel::TurnLength::OneBelowTau}}};
inline constexpr FlavourChoices<TurnClock> kTurnClocks = {
    {{"cycles", TurnClock::Cycles}, {"seconds", TurnClock::Seconds}}};

/// Visits the constants of a flavour in the order of its file, each with its key and limits; the
/// modules are not included. The reader and the writer of flavours both use this function, so that
/// a new constant needs only one line here.
///
/// A visitor has `table(name)`, the table of the fields that follow, and `number(key, value,
/// limits)`, `integer(key, value, limits)`, `flag(key, value)`, `choice(key, value, choices)`,
/// `grays(key, range)` and `labels(key, list)`.
template <class AnyFlavour, class Visitor>
void visit_flavour_fields(AnyFlavour& flavour, Visitor& visitor) {
  constexpr FlavourLimits kDistance{0, 100};
  constexpr FlavourLimits kLength{0, std::numeric_limits<double>::infinity()};
  constexpr FlavourLimits kGain{-1000, 1000};

  visitor.integer("states", flavour.most_states, FlavourLimits{1, kMaxStates});
  visitor.integer("transitions", flavour.most_transitions, FlavourLimits{1, kMaxTransitions});
  visitor.number("speed_mps", flavour.speed_mps, FlavourLimits{0, kFastestWheel_mps});

  visitor.table("obstacles");
  visitor.choice("reading", flavour.obstacles.reading, kObstacleReadings);
  visitor.number("near_m", flavour.obstacles.near_m, kDistance);
  visitor.number("far_m", flavour.obstacles.far_m, kDistance);
  visitor.number("longest_sum", flavour.obstacles.longest_sum, kLength);
  visitor.flag("neighbours_as_obstacles", flavour.obstacles.neighbours_as_obstacles);
  visitor.number("neighbour_near_m", flavour.obstacles.neighbour_near_m, kDistance);
  visitor.number("neighbour_far_m", flavour.obstacles.neighbour_far_m, kDistance);

  visitor.table("exploration");
  visitor.choice("trigger", flavour.exploration.trigger, kTurnTriggers);
  visitor.choice("turn_clock", flavour.exploration.turn_clock, kTurnClocks);
  visitor.number("threshold", flavour.exploration.threshold, FlavourLimits{0, 1000});
  visitor.number("front_slope", flavour.exploration.front_slope, FlavourLimits{0, 1000});
  visitor.choice("turn_length", flavour.exploration.turn_length, kTurnLengths);
  visitor.number("track_m", flavour.exploration.track_m, FlavourLimits{0.001, 10});

  visitor.table("neighbours");
  visitor.number("per_metre", flavour.neighbours.per_metre, FlavourLimits{0.001, 1000});
  visitor.number("shortest_m", flavour.neighbours.shortest_m, FlavourLimits{-1, 100});
  visitor.number("offset", flavour.neighbours.offset, FlavourLimits{0, 1000});
  visitor.flag("alpha_truncated", flavour.neighbours.alpha_truncated);
  visitor.integer("repulsion_power", flavour.neighbours.repulsion_power, FlavourLimits{1, 2});
  visitor.number("attraction_gain", flavour.neighbours.attraction_gain, kGain);
  visitor.number("repulsion_gain", flavour.neighbours.repulsion_gain, kGain);
  visitor.flag("unsigned_count", flavour.neighbours.unsigned_count);

  visitor.table("light");
  visitor.number("full_lux", flavour.light.full_lux, FlavourLimits{0.001, 1'000'000});
  visitor.number("least_vector", flavour.light.least_vector, FlavourLimits{0, 100});
  visitor.number("least_reading", flavour.light.least_reading, FlavourLimits{0, 1});
  visitor.flag("unit_vector", flavour.light.unit_vector);

  visitor.table("steering");
  visitor.number("obstacle_gain", flavour.steering.obstacle_gain, kGain);
  visitor.number("attraction_obstacle_gain", flavour.steering.attraction_obstacle_gain, kGain);
  visitor.flag("forward_by_default", flavour.steering.forward_by_default);
  visitor.number("shortest_result", flavour.steering.shortest_result, FlavourLimits{0, 1000});
  visitor.number("least_inner", flavour.steering.least_inner, FlavourLimits{-1, 1});

  visitor.table("floor");
  visitor.grays("black", flavour.floor.black);
  visitor.grays("gray", flavour.floor.gray);
  visitor.grays("white", flavour.floor.white);
  visitor.labels("labels", flavour.floor.labels);
  visitor.number("hue_tolerance_deg", flavour.floor.hue_tolerance_deg, FlavourLimits{0, 360});
  visitor.flag("hue_wraps", flavour.floor.hue_wraps);
  visitor.number("saturation_tolerance", flavour.floor.saturation_tolerance, kLength);
  visitor.flag("any_channel", flavour.floor.any_channel);
}

}  // namespace swarmsmith
