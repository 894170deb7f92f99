#include "robot/runtime/robot_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "robot/transport/messages.h"
#include "sim/files/robot_file.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {
namespace {

/// Keys and values of all fields, without the name.
std::vector<std::pair<std::string, std::string>> fields_of(const Robot& robot) {
  std::vector<std::pair<std::string, std::string>> fields;
  for (const Section& section : robot_sections(robot, "robot")) {
    const std::string device = section.prefix.substr(section.prefix.find('.') + 1);
    for (const SectionLine& line : section.lines) {
      // Keys of different devices may be equal, so each key gets the name of its device.
      if (line.key != "name") fields.emplace_back(device + line.key, line.value);
    }
  }
  return fields;
}

/// The first field in which two robots of one name differ, as part of a sentence.
std::string difference(const Robot& wanted, const Robot& driven) {
  const auto theirs = fields_of(wanted);
  const auto ours = fields_of(driven);
  const auto [one, other] = std::mismatch(theirs.begin(), theirs.end(), ours.begin(), ours.end());
  if (one == theirs.end() || other == ours.end() || one->first != other->first)
    return "other fields";
  return fmt::format("`{}` = {}, and the node's robot has {}", one->first, one->second,
                     other->second);
}

}  // namespace

std::optional<std::string> other_robot(std::string_view what, const Robot& wanted,
                                       const Robot& driven) {
  // RVRs with different outlines count as one robot (docs/robot-runtime.md, "Which robot"): the
  // outline has no effect on what a node reads or commands.
  if (wanted == driven || (is_rvr(wanted) && is_rvr(driven))) return std::nullopt;
  if (wanted.name == driven.name) {
    return fmt::format("{} is for a robot `{}` with {}; use the same robot file for both", what,
                       wanted.name, difference(wanted, driven));
  }
  std::string why =
      fmt::format("{} is for the robot `{}`, and the node drives the robot `{}`; use one for `{}`",
                  what, wanted.name, driven.name, driven.name);
  if (!no_node_drives(wanted))
    why += fmt::format(", or a node of `{}` (`swarmsmith robot run --kind`)", wanted.name);
  return why;
}

std::optional<std::string> no_node_drives(const Robot& robot) {
  // Without a light ring of its own, a robot has its light sensors where its proximity sensors are.
  const std::size_t rays = robot.proximity.rays_deg.size();
  const std::size_t lights = robot.light.angles_deg.empty() ? rays : robot.light.angles_deg.size();
  std::string has;
  // Drivers send distances, lux and colours (docs/robot-messages.md). A node would have to invent
  // the readings of these other sensors.
  if (kOfStrengths.acts_on(robot)) {
    has = "proximity sensors that give strengths";
  } else if (kOfLightStrengths.acts_on(robot)) {
    has = "light sensors that give strengths";
  } else if (kOfVotes.acts_on(robot)) {
    has = "ground sensors that vote";
  } else if (kOfRadio.acts_on(robot)) {
    has = "a radio for neighbours";
  } else if (rays != kRangeSensors || lights != kRangeSensors) {
    has = fmt::format("{} proximity and {}", rays, counted(lights, "light sensor"));
  } else {
    return std::nullopt;
  }
  return fmt::format(
      "the robot `{}` has {}, and nodes drive robots that measure {} distances, {} values in lux, "
      "the colour of the floor and the places of others; `swarmsmith evaluate` simulates it",
      robot.name, has, kRangeSensors, kRangeSensors);
}

}  // namespace swarmsmith
