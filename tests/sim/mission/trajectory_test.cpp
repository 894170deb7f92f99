#include "sim/mission/trajectory.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace swarmsmith {
namespace {

TEST(Trajectory, IsCutIntoInstants) {
  const Trajectory trajectory{.robots = 2, .poses = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  EXPECT_EQ(trajectory.instants(), 2);
  EXPECT_EQ(trajectory.at(1)[0], (Pose{0, 1, 0}));
  EXPECT_EQ(trajectory.at(1)[1], (Pose{1, 1, 0}));
  EXPECT_EQ(Trajectory{}.instants(), 0);
}

TEST(Trajectory, IsScoredLikeARunThatIsWatched) {
  const Mission mission = built_in_mission("grid_exploration").value();
  const Instance instance = instance_of(mission, 1).value();
  Trajectory trajectory{.robots = 3, .poses = {}};
  for (int instant = 0; instant < 1200; ++instant) {
    for (const double x : {-0.9, 0.1, 0.6})
      trajectory.poses.push_back({x, 0.1, 0});
  }
  EXPECT_EQ(score_of(mission, instance, trajectory), -697818);
}

TEST(Trajectory, TheInstancesPatchesCount) {
  const Mission mission = built_in_mission("color_selection").value();
  const Instance instance{.starts = {},
                          .patches = {{Rectangle{{0.25, 0.25}, 0.3, 0.3}, {255, 255, 0}}}};
  const Trajectory trajectory{.robots = 1, .poses = {{0, 0, 0}, {0.25, 0.25, 0}}};
  EXPECT_EQ(score_of(mission, instance, trajectory), 2);
}

TEST(Trajectory, ObjectsAreScoredWithTheRobots) {
  Mission mission = built_in_mission("aggregation").value();
  mission.rule = ObjectsOn{.color = {0, 0, 0}, .at = When::Sum};
  Trajectory trajectory{.robots = 1,
                        .poses = {{0, 0, 0}, {0, 0, 0}},
                        .objects = 2,
                        .object_poses = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {0.2, 0, 1}}};
  EXPECT_EQ(trajectory.objects_at(1)[1], (Pose{0.2, 0, 1}));
  EXPECT_EQ(score_of(mission, Instance{}, trajectory), 3);
  trajectory.object_poses.pop_back();
  EXPECT_THROW(score_of(mission, Instance{}, trajectory), std::invalid_argument);
}

TEST(Trajectory, AnIncompleteInstantIsRefused) {
  const Mission mission = built_in_mission("aggregation").value();
  const Trajectory trajectory{.robots = 2, .poses = {{0, 0, 0}}};
  EXPECT_THROW(score_of(mission, Instance{}, trajectory), std::invalid_argument);
  EXPECT_EQ(score_of(mission, Instance{}, Trajectory{}), 0);
}

}  // namespace
}  // namespace swarmsmith
