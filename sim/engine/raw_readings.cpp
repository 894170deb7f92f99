#include "sim/engine/raw_readings.h"

#include <limits>

#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/internal/sensing.h"

namespace swarmsmith {

ProximityReadings RawReadings::proximity(double range_m) const {
  ProximityReadings readings;
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = limited(distances_m[i], range_m);
  return readings;
}

std::vector<RawReadings> raw_readings(const Arena& arena, std::span<const Pose> robots) {
  const World world(arena, BoxOutline{kBodySide_m, kBodySide_m}, robots, ContactModel::Exact);
  std::vector<RawReadings> all(robots.size());
  for (int robot = 0; robot < world.robots(); ++robot) {
    RawReadings& readings = all[static_cast<std::size_t>(robot)];
    readings.distances_m = ray_distances(world, robot, kRayLength_m);
    for (double& distance : readings.distances_m) {
      if (distance > kRayLength_m) distance = std::numeric_limits<double>::infinity();
    }
    const Body& body = world.body(robot);
    readings.floor = floor_at(arena, {body.x + kGroundSensorAhead_m * body.cos,
                                      body.y + kGroundSensorAhead_m * body.sin});
    find_neighbours(world, robot, readings.neighbours);
  }
  return all;
}

}  // namespace swarmsmith
