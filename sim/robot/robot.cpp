#include "sim/robot/robot.h"

#include <utility>

namespace swarmsmith {

RingAngles ProximityRing::rvr_ring() {
  return {kProximityDirections_deg.begin(), kProximityDirections_deg.end()};
}

Robot rvr() {
  return {};
}

Robot rvr_with(Outline outline) {
  Robot robot = rvr();
  robot.body.outline = std::move(outline);
  return robot;
}

bool is_rvr(const Robot& robot) {
  return robot == rvr_with(robot.body.outline);
}

}  // namespace swarmsmith
