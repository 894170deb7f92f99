#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "sim/engine/internal/motion.h"
#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/internal/walls.h"
#include "tests/sim/engine/open_loop.h"
#include "tests/sim/engine/reference_data.h"
#include "tests/sim/engine/reference_runs.h"

namespace swarmsmith {
namespace {

using Poses = std::array<Pose, 3>;

Poses poses_of(const std::array<LoggedTick, 3>& tick) {
  return {tick[0].pose, tick[1].pose, tick[2].pose};
}

/// Whether the robot is so far from the others and the walls that nothing can touch it.
bool in_the_open(const Poses& poses, std::size_t robot, const Walls& walls) {
  const Pose& self = poses[robot];
  for (std::size_t other = 0; other < 3; ++other) {
    if (other != robot && hypot(poses[other].x - self.x, poses[other].y - self.y) <= 0.41) {
      return false;
    }
  }
  return std::all_of(walls.planes.begin(), walls.planes.end(),
                     [&](const WallPlane& wall) { return wall.depth_of(self.x, self.y) > 0.21; });
}

/// Physical length of the original's rays (rvr-automode facts, section 3.1).
constexpr double kRayLength_m = 2.0;

/// What ideal sensors of proximity range R read at the given poses, one a robot.
std::vector<Readings> readings_at(const Poses& poses, const Arena& arena, double range_m) {
  Profile profile;
  profile.proximity.range_m = range_m;
  const World world(arena, rvr(), poses, ContactModel::Exact);
  std::vector<Readings> all;
  for (int robot = 0; robot < world.robots(); ++robot) {
    RobotSenses senses(world, arena, profile, robot, Rng(1));
    senses.begin_cycle({.number = 1});
    all.push_back(senses.read(Sensor::GroundColor | Sensor::Proximity | Sensor::Neighbours));
  }
  return all;
}

class LoggedRuns : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, LoggedRuns, testing::ValuesIn(kLoggedRuns), [](const auto& instance) {
  const std::string name = instance.param;
  return name.substr(0, name.find('-'));
});

TEST_P(LoggedRuns, FreeMotionPredictsEachTickFromItsCommands) {
  const LoggedRun run = logged_run(GetParam());
  ASSERT_EQ(run.size(), 1201);
  const Walls walls = walls_of(dodecagon_of_the_thesis());
  double worst_m = 0;
  double worst_rad = 0;
  int judged = 0;
  for (std::size_t robot = 0; robot < 3; ++robot) {
    Body body;
    int ticks_in_the_open = 0;
    for (std::size_t tick = 1; tick < run.size(); ++tick) {
      // The pose is the logged one, rounded to 1e-5; the velocity, which is not logged, comes from
      // the law alone.
      const LoggedTick& before = run[tick - 1][robot];
      const Body placed = body_at(before.pose);
      body.x = placed.x;
      body.y = placed.y;
      body.cos = placed.cos;
      body.sin = placed.sin;
      const Command command = {before.left_cmps / 100, before.right_cmps / 100};
      advance_freely(body, set_point_of(command, body), 10);
      const bool open = in_the_open(poses_of(run[tick]), robot, walls);
      ticks_in_the_open = open ? ticks_in_the_open + 1 : 0;
      if (ticks_in_the_open < 6 && tick > 5) continue;
      ++judged;
      const Pose& truth = run[tick][robot].pose;
      const Pose predicted = pose_of(body);
      worst_m = std::max(worst_m, hypot(predicted.x - truth.x, predicted.y - truth.y));
      worst_rad = std::max(worst_rad, std::fabs(wrap_angle(predicted.theta - truth.theta)));
    }
  }
  RecordProperty("judged", judged);
  RecordProperty("worst_m", testing::PrintToString(worst_m));
  RecordProperty("worst_rad", testing::PrintToString(worst_rad));
  EXPECT_GT(judged, 3000);
  EXPECT_LT(worst_m, 2e-5);
  EXPECT_LT(worst_rad, 2e-5);
}

TEST_P(LoggedRuns, EveryReadingIsTheOriginals) {
  const LoggedRun run = logged_run(GetParam());
  const Arena arena = dodecagon_of_the_thesis();
  int proximity_differs = 0;
  int neighbours_differ = 0;
  int read = 0;
  for (std::size_t tick = 1; tick < run.size(); ++tick) {
    const std::vector<Readings> readings = readings_at(poses_of(run[tick]), arena, 0.4);
    const std::vector<Readings> far = readings_at(poses_of(run[tick]), arena, kRayLength_m);
    for (std::size_t robot = 0; robot < 3; ++robot) {
      const LoggedTick& logged = run[tick][robot];
      for (std::size_t i = 0; i < kProximitySensors; ++i) {
        double want = logged.proximity[i];
        // The original writes 0 where a ray meets nothing within its length.
        const bool nothing = want == 0;
        if (nothing) want = std::numeric_limits<double>::infinity();
        const double got = readings[robot].proximity_m[i];
        const bool same = std::isinf(want) ? got == want : std::fabs(got - want) < 2e-4;
        const bool nothing_too =
            far[robot].proximity_m[i] == std::numeric_limits<double>::infinity();
        proximity_differs += same && nothing == nothing_too ? 0 : 1;
        ++read;
      }
      const auto neighbours = static_cast<int>(readings[robot].neighbours.size());
      neighbours_differ += neighbours == logged.neighbours ? 0 : 1;
    }
  }
  EXPECT_EQ(read, 28'800);
  EXPECT_EQ(proximity_differs, 0);
  EXPECT_EQ(neighbours_differ, 0);
}

TEST_P(LoggedRuns, TheFloorIsTheOriginals) {
  const std::string name = GetParam();
  const LoggedRun run = logged_run(name);
  const std::string theirs = name.substr(0, name.find('-'));
  const auto* mission =
      std::find_if(kReferenceMissions.begin(), kReferenceMissions.end(),
                   [&](const ReferenceMission& candidate) { return candidate.theirs == theirs; });
  const ReferenceRuns runs(mission->ours);
  const Arena arena = arena_of(runs.mission, runs.instances[0]);
  int differs = 0;
  for (std::size_t tick = 1; tick < run.size(); ++tick) {
    const std::vector<Readings> readings = readings_at(poses_of(run[tick]), arena, 0.4);
    for (std::size_t robot = 0; robot < 3; ++robot) {
      differs += readings[robot].ground_color == run[tick][robot].floor ? 0 : 1;
    }
  }
  // Poses are logged to 1e-5 m: on a border the colour may be the neighbour's.
  EXPECT_LE(differs, 1);
}

TEST_P(LoggedRuns, ItsOwnCommandsDriveItAgainUntilTheFirstContact) {
  const OpenLoop again = drive_again(logged_run(GetParam()));
  RecordProperty("first_contact", again.first_contact);
  RecordProperty("worst_m", testing::PrintToString(again.worst_m));
  std::printf("first contact in tick %d, worst %.3g m\n", again.first_contact, again.worst_m);
  EXPECT_LT(again.worst_m, 1e-3);
}

class ClosedLoop : public testing::TestWithParam<ContactModel> {};
INSTANTIATE_TEST_SUITE_P(Both, ClosedLoop,
                         testing::Values(ContactModel::Exact, ContactModel::Box2d),
                         [](const auto& instance) {
                           return instance.param == ContactModel::Exact ? "Exact" : "Box2d";
                         });

TEST_P(ClosedLoop, AMachineWithoutRandomDrawsFollowsTheOriginalForAllTwelveHundredTicks) {
  const LoggedRun logged = logged_run("grid-hG5-seed1");
  ReferenceRuns runs("grid_exploration");
  runs.profile.contacts = GetParam();
  std::string text;
  for (const ReferenceMachine& machine : reference_machines()) {
    if (machine.id == "hG5") text = machine.text;
  }
  double worst_m = 0;
  runs.run(machine_of(text), 1, 0, [&](const Snapshot& now) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose& truth = logged.at(static_cast<std::size_t>(now.cycle))[i].pose;
      worst_m =
          std::max(worst_m, hypot(now.robots[i].pose.x - truth.x, now.robots[i].pose.y - truth.y));
      if (now.cycle == 0) continue;
      EXPECT_NEAR(now.robots[i].command.left_mps * 100,
                  logged[static_cast<std::size_t>(now.cycle)][i].left_cmps, 0.01);
    }
  });
  RecordProperty("worst_m", testing::PrintToString(worst_m));
  EXPECT_LT(worst_m, 2e-5);
}

}  // namespace
}  // namespace swarmsmith
