#pragma once

#include "sim/control/reference_model.h"
#include "sim/robot/fields.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

inline constexpr FieldChoices<ProximityRing::Reading> kProximityReadings = {
    {{"distance", ProximityRing::Reading::Distance},
     {"strength", ProximityRing::Reading::Strength}}};
inline constexpr FieldChoices<LightRing::Reading> kLightReadings = {
    {{"lux", LightRing::Reading::Lux}, {"strength", LightRing::Reading::Strength}}};
inline constexpr FieldChoices<GroundSensor::Reading> kGroundReadings = {
    {{"color", GroundSensor::Reading::Color}, {"vote", GroundSensor::Reading::Vote}}};
inline constexpr FieldChoices<NeighbourSensor::Source> kNeighbourSensors = {
    {{"sight", NeighbourSensor::Source::Sight}, {"radio", NeighbourSensor::Source::Radio}}};

inline constexpr FieldUse kOfDistances = {
    [](const Robot& robot) { return robot.proximity.reading == ProximityRing::Reading::Distance; },
    "whose proximity sensors measure distances"};
inline constexpr FieldUse kOfStrengths = {
    [](const Robot& robot) { return robot.proximity.reading == ProximityRing::Reading::Strength; },
    "whose proximity sensors give strengths"};
inline constexpr FieldUse kOfLightStrengths = {
    [](const Robot& robot) { return robot.light.reading == LightRing::Reading::Strength; },
    "whose light sensors give strengths"};
inline constexpr FieldUse kOfColors = {
    [](const Robot& robot) { return robot.ground.reading == GroundSensor::Reading::Color; },
    "whose ground sensor sees colours"};
inline constexpr FieldUse kOfVotes = {
    [](const Robot& robot) { return robot.ground.reading == GroundSensor::Reading::Vote; },
    "whose ground sensors vote"};
inline constexpr FieldUse kOfSight = {
    [](const Robot& robot) { return robot.neighbours.source == NeighbourSensor::Source::Sight; },
    "that see each other"};
inline constexpr FieldUse kOfRadio = {
    [](const Robot& robot) { return robot.neighbours.source == NeighbourSensor::Source::Radio; },
    "that hear each other by radio"};

/// A limit higher than the number of ground points of any known robot.
inline constexpr int kMostGroundPoints = 8;
/// The most ticks that a vote or a radio remembers.
inline constexpr int kLongestMemory = 100;

/// Visits the fields of a robot in the order of its file, each with its key and limits; the
/// function for profiles is in sim/engine/profile_fields.h. In addition to the methods of that
/// visitor, a visitor has `outline(outline)`, `angles(key, list)` in degrees, `points(key, list)`,
/// `numbers(key, array, limits)` and `count(key, value, least, most)`. The `reading` of a device
/// comes before the fields that are used only with one reading.
template <class AnyRobot, class Visitor>
void visit_robot_fields(AnyRobot& robot, Visitor& visitor) {
  visitor.device("body");
  visitor.outline(robot.body.outline);
  visitor.number("height", robot.body.height_m, FieldLimits{0.005, 5});
  visitor.number("mass", robot.body.mass_kg, FieldLimits{0.001, 1000});
  visitor.number("inertia", robot.body.inertia_kg_m2, FieldLimits{0, 1000});
  visitor.number("robot_friction", robot.body.robot_friction, FieldLimits{0, 2});
  visitor.number("wall_friction", robot.body.wall_friction, FieldLimits{0, 2});

  visitor.device("drive");
  visitor.number("track", robot.drive.track_m, FieldLimits{0.005, 5});
  visitor.number("max_speed", robot.drive.max_speed_mps, FieldLimits{0.001, kFastestWheel_mps});
  visitor.number("force", robot.drive.max_force_N, FieldLimits{0.001, 10'000});
  visitor.number("torque", robot.drive.max_torque_Nm, FieldLimits{0.001, 10'000});

  visitor.device("proximity");
  visitor.angles("rays", robot.proximity.rays_deg);
  visitor.angles("labels", robot.proximity.labels_deg);
  visitor.number("start", robot.proximity.start_m, FieldLimits{0, 5});
  visitor.number("height", robot.proximity.height_m, FieldLimits{0, 5});
  visitor.choice("reading", robot.proximity.reading, kProximityReadings);
  visitor.only(kOfStrengths, [&] {
    visitor.number("reach", robot.proximity.reach_m, FieldLimits{0, 5});
    visitor.numbers("law", robot.proximity.law, FieldLimits{-1e6, 1e6});
  });

  visitor.device("light");
  visitor.angles("angles", robot.light.angles_deg);
  visitor.number("out", robot.light.out_m, FieldLimits{0, 5});
  visitor.number("height", robot.light.height_m, FieldLimits{0, 5});
  visitor.choice("reading", robot.light.reading, kLightReadings);

  visitor.device("ground");
  visitor.points("points", robot.ground.places);
  visitor.choice("reading", robot.ground.reading, kGroundReadings);
  visitor.only(kOfVotes, [&] {
    visitor.count("ticks", robot.ground.vote_ticks, 1, kLongestMemory);
    visitor.count("majority", robot.ground.vote_majority, 0, kLongestMemory * kMostGroundPoints);
    visitor.number("black_below", robot.ground.black_below, FieldLimits{0, 1});
    visitor.number("white_above", robot.ground.white_above, FieldLimits{0, 1});
  });

  visitor.device("neighbours");
  visitor.choice("source", robot.neighbours.source, kNeighbourSensors);
  visitor.number("range", robot.neighbours.range_m, FieldLimits{0, 100});
  visitor.number("height", robot.neighbours.height_m, FieldLimits{0, 5});
  visitor.number("less", robot.neighbours.less_m, FieldLimits{0, 5});
  visitor.only(kOfRadio,
               [&] { visitor.count("ticks", robot.neighbours.memory_ticks, 1, kLongestMemory); });
}

}  // namespace swarmsmith
