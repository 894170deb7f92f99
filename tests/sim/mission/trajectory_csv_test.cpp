#include "sim/mission/trajectory_csv.h"

#include <limits>

#include "base/rng.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// A table of all instants, with a column more than a reader wants.
std::string table_of(const RecordedTrajectory& recorded) {
  std::string text = std::string(kTrajectoryColumns) + ",behaviour";
  text += kCsvLineEnd;
  const auto add = [&](int cycle, std::span<const Pose> poses) {
    int robot = 0;
    for (const Pose& pose : poses) {
      append_pose_cells(text, cycle, robot++, pose);
      text += ",stop";
      text += kCsvLineEnd;
    }
  };
  add(0, recorded.starts);
  for (int i = 0; i < recorded.trajectory.instants(); ++i)
    add(i + 1, recorded.trajectory.at(i));
  return text;
}

std::vector<Pose> random_poses(std::size_t count) {
  Rng rng(11);
  std::vector<Pose> poses(count);
  for (Pose& pose : poses)
    pose = {rng.uniform(-2, 2), rng.uniform(-1e-9, 1e-9), rng.uniform(-3, 3)};
  return poses;
}

TEST(TrajectoryCsv, WritesTimesAsPeopleDo) {
  std::string line;
  append_pose_cells(line, 3, 1, {0.5, -0.25, 1});
  EXPECT_EQ(line, "3,0.3,1,0.5,-0.25,1");
}

TEST(TrajectoryCsv, WritesInfinitiesAsWords) {
  std::string line;
  append_number(line, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(line, "-inf");
}

TEST(TrajectoryCsv, ReadsBackTheSameBits) {
  const RecordedTrajectory recorded{.starts = random_poses(4),
                                    .trajectory = {.robots = 4, .poses = random_poses(200)}};
  const auto read = value_of(parse_trajectory_csv(table_of(recorded)));
  EXPECT_EQ(read, recorded);
}

TEST(TrajectoryCsv, FindsItsColumnsWhereverTheyStandAndNeedsNoStart) {
  const auto read =
      value_of(parse_trajectory_csv("x,y,tag,theta,robot,cycle\n"
                                    "1,2,a,3,0,1\n"
                                    "4,5,b,-1,1,1\n"));
  EXPECT_TRUE(read.starts.empty());
  EXPECT_EQ(read.trajectory, (Trajectory{.robots = 2, .poses = {{1, 2, 3}, {4, 5, -1}}}));
}

TEST(TrajectoryCsv, ATableWithoutRowsIsAnEmptyTrajectory) {
  EXPECT_EQ(*parse_trajectory_csv("cycle,time_s,robot,x,y,theta\n"), RecordedTrajectory{});
}

TEST(TrajectoryCsv, SaysWhatIsWrongAndWhere) {
  struct Wrong {
    const char* text;
    const char* sentence;
  };
  const Wrong cases[] = {
      {"",
       "line 1: a trajectory has the columns cycle,time_s,robot,x,y,theta; there is no `cycle`"},
      {"cycle,robot,x,y\n",
       "line 1: a trajectory has the columns cycle,time_s,robot,x,y,theta; "
       "there is no `theta`"},
      {"cycle,robot,x,y,theta\n0,0,1,2\n", "line 2: the line is too short"},
      {"cycle,robot,x,y,theta\n0,0,1,2,3\n\n", "line 3: the line is too short"},
      {"cycle,robot,x,y,theta\n0,0,1,2,nan\n",
       "line 2: column theta must be a finite number, not `nan`"},
      {"cycle,robot,x,y,theta\n0,0.5,1,2,3\n",
       "line 2: column robot must be an integer, not `0.5`"},
      {"cycle,robot,x,y,theta\n2,0,1,2,3\n", "line 2: expected robot 0 of cycle 0"},
      {"cycle,robot,x,y,theta\n0,0,1,2,3\n2,0,1,2,3\n", "found robot 0 of cycle 2"},
      {"cycle,robot,x,y,theta\n0,1,1,2,3\n", "found robot 1 of cycle 0"},
      {"cycle,robot,x,y,theta\n0,0,1,2,3\n1,0,1,2,3\n1,1,1,2,3\n", "line 4: expected robot 1"},
      {"cycle,robot,x,y,theta\n0,0,1,2,3\n0,1,1,2,3\n1,0,1,2,3\n2,0,1,2,3\n",
       "line 5: cycle 1 has 1 robot, the one before it 2"},
      {"cycle,robot,x,y,theta\n0,0,1,2,3\n0,1,1,2,3\n1,0,1,2,3\n",
       "line 4: cycle 1 has 1 robot, the one before it 2"},
  };
  for (const Wrong& wrong : cases) {
    EXPECT_THAT(complaint_of(parse_trajectory_csv(wrong.text)), HasSubstr(wrong.sentence))
        << wrong.text;
  }
}

}  // namespace
}  // namespace swarmsmith
