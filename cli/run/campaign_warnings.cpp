#include "cli/run/campaign_warnings.h"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "base/suggestion.h"
#include "base/text/json.h"
#include "sim/control/flavour.h"
#include "sim/engine/fitting.h"
#include "sim/engine/kept_constants.h"
#include "sim/mission/footprint.h"
#include "sim/mission/score.h"

namespace swarmsmith::cli {
namespace {

bool has(const std::vector<std::string>& modules, Module module) {
  return std::ranges::find(modules, id_of(module)) != modules.end();
}

/// The published program recognises black only at one grey level, which noise always changes.
void warn_about_black(const Method& method, const Flavour& flavour, const Profile& profile,
                      std::vector<std::string>& warnings) {
  const bool narrow = flavour.floor.black.high < 1000;
  if (!has(method.conditions, Module::BlackFloor) || !narrow || profile.ground_color.sd == 0)
    return;
  warnings.push_back(
      "method \"" + method.name + "\": flavour " + method.flavour +
      " accepts only pure black as black, so that with the ground noise of profile " +
      profile.name + " black_floor hardly ever holds");
}

/// Warns if the range of the proximity sensors differs from the range that the flavour assumes.
void warn_about_range(const Method& method, const Flavour& flavour, const Profile& profile,
                      std::vector<std::string>& warnings) {
  const double expected = flavour.obstacles.far_m;
  const double range = profile.proximity.range_m;
  if (range == expected) return;
  warnings.push_back("method \"" + method.name + "\": flavour " + method.flavour +
                     " takes obstacles into account up to " + json_number(expected) +
                     " m, but the proximity sensors of profile " + profile.name + " see up to " +
                     json_number(range) + " m; " +
                     (range < expected ? "obstacles in between are never seen"
                                       : "what they see beyond that is ignored"));
}

/// Without a light, both phototaxis behaviours only avoid obstacles.
void warn_about_light(const Method& method, const Campaign& campaign,
                      std::vector<std::string>& warnings) {
  if (method.architecture == Architecture::Network) return;
  const bool photo = has(method.behaviours, Module::Phototaxis);
  const bool anti = has(method.behaviours, Module::AntiPhototaxis);
  if (!photo && !anti) return;
  const std::string effect = photo && anti ? "phototaxis and anti_phototaxis only avoid"
                             : photo       ? "phototaxis only avoids"
                                           : "anti_phototaxis only avoids";
  for (const CampaignMission& mission : campaign.missions) {
    if (!mission.mission.arena.lights.empty()) continue;
    warnings.push_back("method \"" + method.name + "\": mission " + mission.mission.name +
                       " has no light, so that " + effect + " obstacles there");
  }
}

/// The floor under such a point is not the floor under the robot's body.
void warn_about_ground_points(const Mission& mission, std::vector<std::string>& warnings) {
  for (const Point& point : ground_points_outside(mission.robot))
    warnings.push_back("mission " + mission.name + ": the robot's ground sensor at [" +
                       json_number(point.x) + ", " + json_number(point.y) +
                       "] is outside of its body");
}

/// Simulated rays hit walls of any height, although they pass over other things that are lower than
/// the sensors.
void warn_about_low_walls(const Mission& mission, std::vector<std::string>& warnings) {
  const double sensors_m = mission.robot.proximity.height_m;
  const double walls_m = mission.arena.wall_height_m;
  if (sensors_m <= walls_m) return;
  warnings.push_back("mission " + mission.name + ": the robot's proximity sensors are " +
                     json_number(sensors_m) + " m high, its walls " + json_number(walls_m) +
                     " m; simulated rays hit walls of any height");
}

void warn_about_objects(const Mission& mission, std::vector<std::string>& warnings) {
  const auto* formula = std::get_if<Formula>(&mission.rule);
  const bool scores_objects = std::holds_alternative<ObjectsOn>(mission.rule) ||
                              (formula != nullptr && formula->of == "objects");
  if (!scores_objects || !mission.arena.objects.empty()) return;
  warnings.push_back("mission " + mission.name +
                     ": its score is about movable objects, but its arena has none");
}

/// The modules of a method that use neighbours; a network always reads them.
std::vector<std::string> looking_for_neighbours(const Method& method) {
  if (method.architecture == Architecture::Network) return {"networks"};
  std::vector<std::string> found;
  for (const Module module : {Module::Attraction, Module::Repulsion})
    if (has(method.behaviours, module)) found.emplace_back(id_of(module));
  for (const Module module : {Module::NeighbourCount, Module::InvertedNeighbourCount})
    if (has(method.conditions, module)) found.emplace_back(id_of(module));
  return found;
}

void warn_about_neighbours(const Method& method, const Campaign& campaign,
                           std::vector<std::string>& warnings) {
  const std::vector<std::string> modules = looking_for_neighbours(method);
  if (modules.empty()) return;
  for (const CampaignMission& mission : campaign.missions) {
    const Robot& robot = mission.mission.robot;
    const double nearest_m = 2 * inradius_of(robot.body.outline);
    if (robot.neighbours.range_m > nearest_m) continue;
    warnings.push_back("method \"" + method.name + "\": the robot of mission " +
                       mission.mission.name + " never sees a neighbour, because " +
                       "`neighbours.range` is " + json_number(robot.neighbours.range_m) +
                       " m, and the centres of two robots are at least " + json_number(nearest_m) +
                       " m apart; these look for neighbours: " + joined(modules));
  }
}

/// A robot cannot drive faster than its own maximum speed, even if the flavour is faster.
void warn_about_speed(const Method& method, const Flavour& flavour, const Campaign& campaign,
                      std::vector<std::string>& warnings) {
  for (const CampaignMission& mission : campaign.missions) {
    const double most_mps = mission.mission.robot.drive.max_speed_mps;
    if (flavour.speed_mps <= most_mps) continue;
    warnings.push_back("method \"" + method.name + "\": flavour " + method.flavour + " drives at " +
                       json_number(flavour.speed_mps) + " m/s; the robot of mission " +
                       mission.mission.name + " reaches " + json_number(most_mps) +
                       " m/s, and drives at that");
  }
}

/// A mission can change only the shape of its robots.
void warn_about_robot(const Mission& mission, std::vector<std::string>& warnings) {
  const auto kept = kept_constants(mission.robot);
  if (!kept) return;
  warnings.push_back("mission " + mission.name +
                     ": its robot has a shape of its own; everything else is that of the RVR: " +
                     json_number(kept->mass_kg) + " kg, a drive of " + json_number(kept->drive_N) +
                     " N, treads " + json_number(kept->treads_m) + " m apart, the ground sensor " +
                     json_number(kept->ground_sensor_m) + " m ahead of the centre, a height of " +
                     json_number(kept->height_m) + " m, neighbours up to " +
                     json_number(kept->neighbours_m) + " m");
}

}  // namespace

std::vector<std::string> warnings_about(const Campaign& campaign) {
  std::vector<std::string> warnings;
  if (campaign.target) return warnings;  // the modules are a matter of its programs
  for (const CampaignMission& mission : campaign.missions) {
    warn_about_robot(mission.mission, warnings);
    warn_about_ground_points(mission.mission, warnings);
    warn_about_low_walls(mission.mission, warnings);
    warn_about_objects(mission.mission, warnings);
  }
  for (const Method& method : campaign.methods) {
    const Flavour& flavour = **flavour_of(method);
    warn_about_black(method, flavour, campaign.profile, warnings);
    warn_about_range(method, flavour, campaign.profile, warnings);
    warn_about_light(method, campaign, warnings);
    warn_about_speed(method, flavour, campaign, warnings);
    warn_about_neighbours(method, campaign, warnings);
  }
  return warnings;
}

}  // namespace swarmsmith::cli
