#include "sim/engine/fitting.h"

#include "sim/engine/internal/ring.h"

namespace swarmsmith {
namespace {

bool gives_strengths(const Robot& robot) {
  return robot.proximity.reading == ProximityRing::Reading::Strength;
}

std::string noun_of(bool strengths) {
  return strengths ? "strengths" : "distances";
}

std::string profile_sentence(const Profile& profile, const Robot& robot, const std::string& key,
                             const std::string& why) {
  return "the profile `" + profile.name + "` is not one of the robot `" + robot.name + "`: `" +
         key + "` is of robots " + why + "; choose another --profile";
}

}  // namespace

std::optional<std::string> misfit(const Flavour& flavour, const Robot& robot) {
  const bool takes_strengths = flavour.obstacles.reading == ObstacleModel::Reading::Strength;
  if (takes_strengths == gives_strengths(robot)) return std::nullopt;
  return "the flavour `" + flavour.name + "` takes " + noun_of(takes_strengths) +
         " from proximity sensors, and the robot `" + robot.name + "` gives " +
         noun_of(!takes_strengths) + "; choose another flavour, or a mission of another robot";
}

std::optional<std::string> misfit(const Profile& profile, const Robot& robot) {
  const ProximitySensing& proximity = profile.proximity;
  const GroundColorSensing& ground = profile.ground_color;
  const bool votes = robot.ground.reading == GroundSensor::Reading::Vote;
  const bool by_radio = robot.neighbours.source == NeighbourSensor::Source::Radio;
  const auto sentence = [&](const std::string& key, const std::string& why) {
    return profile_sentence(profile, robot, key, why);
  };
  if (gives_strengths(robot)) {
    if (proximity.sd_m > 0 || proximity.scale_sd > 0 || proximity.largest_miss_rate > 0 ||
        proximity.phantom_rate > 0) {
      return sentence("proximity", "that measure distances");
    }
  } else if (proximity.half_width > 0) {
    return sentence("proximity.half_width", "whose sensors give strengths");
  }
  if (votes && (ground.sd > 0 || ground.bias_sd > 0 || ground.labeler)) {
    return sentence("ground_color", "that see colours");
  }
  if (!votes && ground.half_width > 0) {
    return sentence("ground_color.half_width", "whose ground sensors vote");
  }
  if (robot.light.reading != LightRing::Reading::Strength && profile.light.half_width > 0) {
    return sentence("light.half_width", "whose light sensors give strengths");
  }
  if (by_radio && (profile.neighbours.every_sub_steps > 0 ||
                   profile.neighbours.source != NeighbourSensing::Source::Camera)) {
    return sentence("neighbours", "that see each other");
  }
  return std::nullopt;
}

Flavour fitted(const Flavour& flavour, const Robot& robot) {
  Flavour result = flavour;
  if (const auto labels = labels_of(robot)) {
    result.obstacles.directions = *labels;
    result.light.directions = *labels;
  }
  return result;
}

}  // namespace swarmsmith
