#include "sim/engine/fitting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "base/math.h"
#include "base/overloaded.h"
#include "sim/control/treads.h"
#include "sim/engine/internal/form.h"
#include "sim/engine/internal/ring.h"
#include "sim/engine/profile_fields.h"
#include "sim/mission/polygon.h"
#include "sim/robot/idle_fields.h"

namespace swarmsmith {
namespace {

bool gives_strengths(const Robot& robot) {
  return kOfStrengths.acts_on(robot);
}

/// The reference models that the robot's senses can serve (docs/flavours.md).
std::span<const std::string_view> models_of(const Robot& robot) {
  static constexpr std::array<std::string_view, 1> kOfDistances = {kRvrModel};
  if (gives_strengths(robot)) return kStrengthModels;
  return kOfDistances;
}

std::string noun_of(bool strengths) {
  return strengths ? "strengths" : "distances";
}

}  // namespace

std::optional<std::string> misfit(const Flavour& flavour, const Robot& robot) {
  const bool takes_strengths = flavour.obstacles.reading == ObstacleModel::Reading::AsSensed;
  if (takes_strengths != gives_strengths(robot)) {
    return "the flavour `" + flavour.name + "` takes " + noun_of(takes_strengths) +
           " from proximity sensors, but the robot `" + robot.name + "` gives " +
           noun_of(!takes_strengths);
  }
  const bool sees_light = flavour.find(Module::Phototaxis) != nullptr ||
                          flavour.find(Module::AntiPhototaxis) != nullptr;
  if (sees_light && takes_strengths != kOfLightStrengths.acts_on(robot)) {
    return "the flavour `" + flavour.name + "` takes " + (takes_strengths ? "strengths" : "lux") +
           " from light sensors, but the robot `" + robot.name + "` gives " +
           (takes_strengths ? "lux" : "strengths");
  }
  const std::span<const std::string_view> models = models_of(robot);
  if (std::ranges::find(models, flavour.reference) != models.end()) return std::nullopt;
  std::string known;
  for (const std::string_view model : models)
    known += (known.empty() ? "" : " and ") + std::string(model);
  return "the flavour `" + flavour.name + "` needs the reference model " + flavour.reference +
         ", but the robot `" + robot.name + "` is simulated with " + known;
}

std::optional<std::string> misfit(const Profile& profile, const Robot& robot) {
  // A value that is ideal does nothing on any robot, so profiles for all robots may contain it.
  static const Profile kIdeal;
  IdleFields fields(robot);
  visit_profile_fields(kIdeal, fields);
  fields.compare();
  visit_profile_fields(profile, fields);
  for (const IdleField& field : fields.found()) {
    const std::string key = field.device + "." + field.key;
    if (!field.differs && std::ranges::count(profile.ranges, key, &FieldRange::field) == 0)
      continue;
    return "the profile `" + profile.name + "` does not fit the robot `" + robot.name + "`: `" +
           key + "` is only for robots " + std::string(field.robots);
  }
  const NeighbourSensor rvr;
  if (profile.neighbours.source == NeighbourSensing::Source::Lidar &&
      (robot.neighbours.range_m != rvr.range_m || robot.neighbours.less_m != rvr.less_m)) {
    return "the profile `" + profile.name + "` does not fit the robot `" + robot.name +
           "`: it finds neighbours with the RVR's lidar, which has the RVR's `range` and `less`; "
           "use a profile with neighbours.source = \"camera\"";
  }
  if (profile.contacts == ContactModel::Box2d) {
    if (const auto flaw = friction_flaw(robot.body)) {
      return "the profile `" + profile.name + "` does not fit the robot `" + robot.name +
             "`: " + *flaw;
    }
  }
  return std::nullopt;
}

std::optional<std::string> friction_flaw(const RobotBody& body) {
  constexpr double kLeast = 1e-6;  // far above those that are 0 as single precision numbers
  if (body.robot_friction >= kLeast || body.wall_friction == 0 ||
      body.robot_friction == body.wall_friction)
    return std::nullopt;
  return "`robot_friction` must be at least 0.000001, or 0 with `wall_friction` = 0, where Box2D "
         "simulates contacts: with robots that are not discs, movable objects, or contacts = "
         "\"box2d\" in the profile";
}

std::optional<std::string> misfit(NetworkInputs inputs, const Robot& robot) {
  if (inputs != NetworkInputs::Rm11) return std::nullopt;
  const std::size_t rays = robot.proximity.rays_deg.size();
  const std::size_t lights = robot.light.angles_deg.empty() ? rays : robot.light.angles_deg.size();
  const bool gives_light = kOfLightStrengths.acts_on(robot);
  if (rays == kProximitySensors && lights == kProximitySensors && gives_light) return std::nullopt;
  const std::string each = std::to_string(kProximitySensors);
  return "a network with the inputs rm1.1 reads the strengths of " + each + " proximity and " +
         each + " light sensors, but the robot `" + robot.name + "` has " +
         (gives_light ? std::to_string(rays) + " and " + std::to_string(lights)
                      : "light sensors that give lux");
}

double plate_inertia_of(const RobotBody& body) {
  return body.mass_kg * form_of(body.outline, body.height_m).mean_radius2_m2;
}

std::vector<Point> ground_points_outside(const Robot& robot) {
  std::vector<Point> outside = robot.ground.places;
  std::erase_if(outside, [&robot](const Point& point) {
    return std::visit(
        Overloaded{
            [&](const CircleOutline& circle) { return hypot(point.x, point.y) < circle.radius_m; },
            [&](const BoxOutline& box) {
              return std::fabs(point.x) < box.length_m / 2 && std::fabs(point.y) < box.width_m / 2;
            },
            [&](const PolygonOutline& polygon) { return is_within(polygon.corners, point); }},
        robot.body.outline);
  });
  return outside;
}

Flavour fitted(const Flavour& flavour, const Robot& robot) {
  Flavour result = flavour;
  if (const auto labels = labels_of(robot)) {
    result.obstacles.directions = *labels;
    result.light.directions = *labels;
  }
  if (has_own_lights(robot))
    result.light.directions = directions_of(ring_of(robot.light.angles_deg));
  result.speed_mps = std::min(flavour.speed_mps, robot.drive.max_speed_mps);
  // The RVR's treads skid: a flavour may have a better effective distance between them than the
  // robot.
  if (robot.drive.track_m != kTreadDistance_m) result.exploration.track_m = robot.drive.track_m;
  return result;
}

}  // namespace swarmsmith
