#include "tests/support/film/recorded_run.h"

#include <cmath>

#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"

namespace swarmsmith::film {
namespace {

const std::string kDesigns = SWARMSMITH_TEST_DATA "/argos/argos-thesis-designs.csv";
constexpr const char* kMachine =
    "--nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.3 --s1 1 --n1 1 --n1x0 0 "
    "--c1x0 1 --p1x0 0.1";

TEST(RecordedRunTest, IsTheRunThatTheSimulatorScores) {
  for (const char* mission : {"aggregation", "grid_exploration", "color_selection"}) {
    RunWish wish;
    wish.mission = mission;
    wish.machine = kMachine;
    wish.profile = "pseudo-reality";
    wish.seed = 11;
    wish.seconds = 30;
    const auto run = value_of(record_run(wish, kDesigns));
    // The robots' way beyond the end is not part of what is scored, and does not change it.
    const Flavour& flavour = **find_flavour(wish.flavour);
    const Machine machine = *parse_machine(kMachine, flavour);
    const auto profile = *find_profile(wish.profile, ".");
    const Measured result =
        simulate({machine, flavour, profile, run.mission, run.instance, wish.seed});
    EXPECT_EQ(run.score, result.score) << mission;
    EXPECT_EQ(run.trajectory.instants(), 300);
    EXPECT_GT(run.poses.front().size(), 301U);
    EXPECT_EQ(run.poses[1][300], run.trajectory.at(299)[1]);
  }
}

TEST(RecordedRunTest, TakesDesignsOfTheThesisByName) {
  RunWish wish;
  wish.machine = "tA4";
  wish.seconds = 1;
  EXPECT_TRUE(record_run(wish, kDesigns));
  wish.machine = "tA44";
  EXPECT_FALSE(record_run(wish, kDesigns));
}

TEST(RecordedRunTest, DistanceToAnotherScoreIsThatToTheBorder) {
  RunWish wish;
  wish.machine = kMachine;
  wish.seconds = 1;
  auto run = value_of(record_run(wish, kDesigns));
  // The spot of the mission is the disc that its arena shows.
  const Disc spot = std::get<Disc>(run.mission.arena.patches.front().shape);
  const double inside = spot.radius_m - 0.0102;
  run.trajectory.poses[static_cast<std::size_t>(3 * 9)] = {spot.centre.x + inside, spot.centre.y,
                                                           0};
  EXPECT_NEAR(distance_to_change(run, 0), 0.0102, 0.0006);
  run.trajectory.poses[static_cast<std::size_t>(3 * 9)] = {spot.centre.x, spot.centre.y, 0};
  EXPECT_EQ(distance_to_change(run, 0), 0.05);
}

}  // namespace
}  // namespace swarmsmith::film
