#pragma once

#include <vector>

#include "tests/support/film/virtual_camera.h"

namespace swarmsmith::film {

/// The lens of the facts' arena for an image that is so wide, 16 to 9.
inline CameraModel lens_of(int width) {
  const double f = 0.583 * width;
  const int height = width * 9 / 16;
  return {{width, height},
          Lens::Pinhole,
          f,
          f * 1.001,
          width * 0.5 + 4.3,
          height * 0.5 - 3.6,
          {-0.285, 0.095, 0.0006, -0.0004, 0}};
}

inline Shooting shooting_of(int width) {
  Shooting shooting;
  shooting.view = {lens_of(width), looking_at({0.10, -0.12, 2.7}, {0.01, 0.02}, 0.02)};
  return shooting;
}

inline FilmedRobot robot_at(int tag, const Pose& pose) {
  FilmedRobot robot;
  robot.tag = tag;
  robot.offset = {0.03, -0.05, 0.2};
  robot.path = Path({pose});
  return robot;
}

}  // namespace swarmsmith::film
