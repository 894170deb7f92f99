
#include <cmath>
#include <stdexcept>

#include "sim/mission/instance_csv.h"
#include "sim/mission/trajectory.h"
#include "tests/sim/reference_run.h"
#include "tests/support/checks.h"

// Scores of the recorded runs against those that the original simulator printed for them
// (tests/golden/argos/README.md).

namespace swarmsmith {
namespace {

double printed_score(const std::string& mission, const std::string& machine) {
  for (const auto& row : golden_rows("argos-scores.csv")) {
    if (row.at(0) == mission && row.at(1) == machine && row.at(2) == "1") {
      return std::stod(row.at(3));
    }
  }
  throw std::runtime_error("no score");
}

Trajectory trajectory_of(const RecordedRun& run) {
  Trajectory trajectory{.robots = 3, .poses = {}};
  for (std::size_t tick = 1; tick < run.ticks.size(); ++tick) {
    for (const RecordedTick& robot : run.ticks[tick])
      trajectory.poses.push_back(robot.pose);
  }
  return trajectory;
}

double our_score(const std::string& mission_name, const std::string& file_mission,
                 const std::string& machine) {
  const Mission mission = built_in_mission(mission_name).value();
  const ExplicitInstances given{
      .starts = parse_starts_csv(golden_text("argos-starts.csv")).value(),
      .patches = parse_patches_csv(golden_text("argos-patches.csv")).value()};
  const Instance instance = instance_of(mission, 1, given).value();
  return score_of(mission, instance, trajectory_of(recorded_run(file_mission, machine)));
}

TEST(RecordedScores, AggregationIsThePrintedOne) {
  EXPECT_EQ(our_score("aggregation", "aggregation", "hA6"), printed_score("aggregation", "hA6"));
}

TEST(RecordedScores, ColorSelectionIsThePrintedOne) {
  EXPECT_EQ(our_score("color_selection", "color", "hC1"), printed_score("color", "hC1"));
}

TEST(RecordedScores, GridExplorationIsMinusThePrintedCost) {
  // Printed with six digits.
  EXPECT_NEAR(our_score("grid_exploration", "grid", "hG5"), -printed_score("grid", "hG5"), 0.5);
}

TEST(RecordedScores, StartsOfTheFilesAreTheStartsOfTheRuns) {
  const StartsBySeed starts = parse_starts_csv(golden_text("argos-starts.csv")).value();
  ASSERT_EQ(starts.size(), 100U);
  const RecordedRun run = recorded_run("grid", "hG5");
  for (std::size_t robot = 0; robot < 3; ++robot) {
    EXPECT_NEAR(starts.at(1)[robot].x, run.ticks[0][robot].pose.x, 1e-5);
    EXPECT_NEAR(starts.at(1)[robot].theta, run.ticks[0][robot].pose.theta, 1e-5);
  }
}

TEST(RecordedScores, AllReferenceInstancesAreValid) {
  const ExplicitInstances given{
      .starts = parse_starts_csv(golden_text("argos-starts.csv")).value(),
      .patches = parse_patches_csv(golden_text("argos-patches.csv")).value()};
  for (const char* name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Mission mission = built_in_mission(name).value();
    for (int seed = 1; seed <= 100; ++seed) {
      const auto instance = value_of(instance_of(mission, seed, given));
      EXPECT_EQ(instance.patches.size(), mission.shuffled.places.size());
    }
  }
}

}  // namespace
}  // namespace swarmsmith
