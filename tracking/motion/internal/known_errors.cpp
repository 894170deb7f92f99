#include "tracking/motion/internal/known_errors.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

double square(double value) {
  return value * value;
}

/// The variance of a robot's place without noise.
double variance_of(const TaggedRobot& robot, const TagEvidence& evidence,
                   const TrackedCamera& camera, const Rig& rig, const Point& at, double speed_m_s) {
  const Point3 centre = camera.view.place.centre();
  const double above_m = centre.z - robot.setup.height_m;
  const double height_off = std::max(robot.setup.height_error_m, evidence.height_off_m);
  const double tilt = std::max(rig.tilt_error_rad, evidence.tilt_rad);
  return square(rig.survey_error_m) + square(camera.lens_error_rad * above_m) +
         square(speed_m_s * camera.time_error_s) +
         square(hypot(at.x - centre.x, at.y - centre.y) / above_m * height_off) +
         square(robot.setup.height_m * std::sin(tilt));
}

}  // namespace

void add_known_errors(const std::vector<TrackedTag>& tags, const std::vector<TagEvidence>& evidence,
                      std::span<const TrackedCamera> cameras, const Rig& rig, TrackedRun& run) {
  SWARMSMITH_ASSERT(tags.size() == evidence.size(), "each tag has its evidence");
  SWARMSMITH_ASSERT(run.starts.size() == run.robots.size(), "each robot has its start");
  const int cycles = run.trajectory.instants();
  for (std::size_t i = 0; i < run.robots.size(); ++i) {
    TrackedRobot& robot = run.robots[i];
    SWARMSMITH_ASSERT(robot.sigmas.size() >= static_cast<std::size_t>(cycles),
                      "each cycle has its sigma");
    double sum = 0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      const Point at = run.trajectory.at(cycle)[i].position();
      const Point before =
          (cycle == 0 ? run.starts[i] : run.trajectory.at(cycle - 1)[i]).position();
      const double speed = hypot(at.x - before.x, at.y - before.y) / kControlPeriod_s;
      // The cameras differ little, so the largest variance counts, whichever camera saw the robot
      // best.
      double variance = 0;
      // For a robot with several tags, the worst tag counts as if it were the only one.
      for (std::size_t t = 0; t < tags.size(); ++t) {
        if (tags[t].robot != i) continue;
        for (const TrackedCamera& camera : cameras) {
          variance =
              std::max(variance, variance_of(*tags[t].tag, evidence[t], camera, rig, at, speed));
        }
      }
      Scatter& sigma = robot.sigmas[static_cast<std::size_t>(cycle)];
      sigma.sigma_m = std::sqrt(square(sigma.sigma_m) + variance);
      sum += variance;
    }
    if (cycles > 0) robot.sigma.sigma_m = std::sqrt(square(robot.sigma.sigma_m) + sum / cycles);
  }
}

}  // namespace swarmsmith
