#include <gtest/gtest.h>

#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/mission/trajectory.h"

namespace swarmsmith {
namespace {

/// A robot drives straight ahead and pushes a light box off the black floor.
TEST(Simulate, ScoresObjectsThatAreMovedAsTheRecordedTrajectoryDoes) {
  const Flavour& flavour = watermelon_argos3();
  const Machine machine = parse_machine("--nstates 1 --s0 0 --rwm0 10", flavour).value();
  const Profile profile = built_in_profile("argos3").value();
  Mission mission = built_in_mission("aggregation").value();
  mission.cycles = 60;
  mission.arena.objects = {{.outline = BoxOutline{0.1, 0.1},
                            .start = {0.3, 0, 0},
                            .mass_kg = 0.1,
                            .friction_N = 0.05,
                            .height_m = 0.02}};
  mission.rule = ObjectsOn{.color = {0, 0, 0}, .at = When::Sum};
  const Instance instance{.starts = {{0, 0, 0}}, .patches = {}};

  Trajectory trajectory{.robots = 1, .poses = {}, .objects = 1, .object_poses = {}};
  const Measured result =
      simulate({machine, flavour, profile, mission, instance, 1}, [&](const Snapshot& now) {
        if (now.cycle == 0) return;
        trajectory.poses.push_back(now.robots[0].pose);
        trajectory.object_poses.push_back(now.objects[0]);
      });
  EXPECT_EQ(result.score, score_of(mission, instance, trajectory));
  EXPECT_GT(result.score, 0);
  EXPECT_LT(result.score, 60) << "the box has left the black floor";
  EXPECT_GT(trajectory.object_poses.back().x, 0.5);
}

}  // namespace
}  // namespace swarmsmith
