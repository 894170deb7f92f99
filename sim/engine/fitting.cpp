#include "sim/engine/fitting.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "sim/engine/internal/ring.h"

namespace swarmsmith {
namespace {

bool gives_strengths(const Robot& robot) {
  return robot.proximity.reading == ProximityRing::Reading::Strength;
}

/// The reference models that the robot's senses are (docs/flavours.md).
std::span<const std::string_view> models_of(const Robot& robot) {
  static constexpr std::array<std::string_view, 1> kOfDistances = {kRvrModel};
  static constexpr std::array<std::string_view, 3> kOfStrengths = {"rm1.1", "rm1.2", "rm1-2018"};
  if (gives_strengths(robot)) return kOfStrengths;
  return kOfDistances;
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
  const bool takes_strengths = flavour.obstacles.reading == ObstacleModel::Reading::AsSensed;
  if (takes_strengths != gives_strengths(robot)) {
    return "the flavour `" + flavour.name + "` takes " + noun_of(takes_strengths) +
           " from proximity sensors, and the robot `" + robot.name + "` gives " +
           noun_of(!takes_strengths) + "; choose another flavour, or a mission of another robot";
  }
  const std::span<const std::string_view> models = models_of(robot);
  if (std::ranges::find(models, flavour.reference) != models.end()) return std::nullopt;
  std::string known;
  for (const std::string_view model : models)
    known += (known.empty() ? "" : " and ") + std::string(model);
  return "the flavour `" + flavour.name + "` needs the reference model " + flavour.reference +
         ", and the robot `" + robot.name + "` is simulated with " + known;
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
