#include "tracking/profile/lab_profile.h"

#include <cmath>
#include <stdexcept>

#include "sim/files/profile_file.h"
#include "tests/support/checks.h"
#include "tests/support/long_runs.h"
#include "tests/tracking/profile/virtual_lab.h"

namespace swarmsmith {
namespace {

Profile profile_of(const LabProfile& made) {
  const auto read = parse_profile(made.text, "lab.toml");
  if (!read) throw std::runtime_error(made.text + to_string(read.error().front()));
  return *read;
}

double mean_delay_ms(const Profile& profile) {
  double sum = 0;
  for (const ControlTiming::Delay& delay : profile.timing.delays)
    sum += 10.0 * delay.sub_steps * delay.probability;
  return sum;
}

LabProfile measured(const VirtualLab& lab, int runs = 4) {
  return lab_profile({.robots = lab.runs(runs), .base = "rvr", .program = "test"});
}

const LabFigure& figure(const LabProfile& made, const std::string& name) {
  for (const LabFigure& one : made.figures) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no figure " + name);
}

TEST(LabProfile, GivesAKnownLaboratoryBack) {
  struct Truth {
    int sub_steps;
    double way, turn, miss;
  };
  for (const Truth& truth :
       {Truth{20, 0.9, 0.8, 0.2}, Truth{12, 0.97, 0.6, 0.05}, Truth{35, 0.8, 1.1, 0.5}}) {
    VirtualLab lab{.truth = rvr_profile()};
    lab.truth.timing.delays = {{truth.sub_steps, 1}};
    lab.truth.treads = {.way = truth.way, .turn = truth.turn};
    lab.truth.neighbours.miss_rate = truth.miss;
    const LabProfile made = measured(lab, 3);
    SCOPED_TRACE(made.text);
    const Profile found = profile_of(made);
    EXPECT_NEAR(mean_delay_ms(found), 10 * truth.sub_steps, truth.sub_steps);
    EXPECT_NEAR(1 - found.treads.way, 1 - truth.way, 0.1 * std::fabs(1 - truth.way) + 0.001);
    EXPECT_NEAR(1 - found.treads.turn, 1 - truth.turn, 0.1 * std::fabs(1 - truth.turn) + 0.001);
    EXPECT_NEAR(found.neighbours.miss_rate, truth.miss, 0.1 * truth.miss);
    EXPECT_EQ(found.neighbours.weak_share, 0);
    EXPECT_LT(found.treads.way_sd, 0.01);
    EXPECT_LT(found.treads.turn_sd, 0.01);
    // All else is the base's.
    Profile rest = found;
    rest.name = "rvr";
    rest.timing.delays = {};
    rest.treads = {};
    rest.neighbours = {};
    EXPECT_EQ(rest, rvr_profile());
  }
}

/// Commands act when they do, however often the camera looks, and whatever treads make of them.
TEST(LabProfile, GivesALatencyBackAtEachFrameRate) {
  struct Treads {
    double way, turn, noise_rad;
  };
  const std::vector<Treads> all{{1, 1, 0.003}, {0.85, 0.7, 0.003}, {1, 0.8, 0.01}, {0.9, 1.15, 0}};
  const auto rates = times<std::vector<double>>({15, 30}, {15, 25, 30, 60});
  std::int64_t seed = 1;
  for (const int sub_steps : times<std::vector<int>>({10}, {10, 20, 35})) {
    for (const double rate_hz : rates) {
      for (const Treads& treads : times<std::vector<Treads>>({all[1]}, all)) {
        VirtualLab lab{.truth = rvr_profile(), .rate_hz = rate_hz, .noise_rad = treads.noise_rad};
        lab.truth.timing.delays = {{sub_steps, 1}};
        lab.truth.treads = {.way = treads.way, .turn = treads.turn};
        const auto robots = lab.run(++seed);
        const LabProfile made = lab_profile({.robots = robots, .base = "rvr", .program = "test"});
        SCOPED_TRACE(made.text);
        const Profile found = profile_of(made);
        EXPECT_NEAR(mean_delay_ms(found), 10 * sub_steps, 0.1 * 10 * sub_steps);
        EXPECT_NEAR(found.treads.way, treads.way, 0.1 * std::fabs(1 - treads.way) + 0.001);
        EXPECT_NEAR(found.treads.turn, treads.turn, 0.1 * std::fabs(1 - treads.turn) + 0.001);
        // What a run says of itself.
        for (const MeasuredRobot& robot : robots) {
          ASSERT_TRUE(robot.reality.latency.seconds) << robot.reality.latency.reason;
          EXPECT_NEAR(1000 * *robot.reality.latency.seconds, 10 * sub_steps, sub_steps);
        }
      }
    }
  }
}

TEST(LabProfile, GivesALatencyBackThatVariesFromCommandToCommand) {
  using Delays = std::vector<ControlTiming::Delay>;
  for (const Delays& delays :
       {Delays{{10, 0.25}, {20, 0.5}, {30, 0.25}}, Delays{{5, 0.7}, {40, 0.3}}}) {
    VirtualLab lab{.truth = rvr_profile()};
    lab.truth.timing.delays = delays;
    lab.truth.treads.turn = 0.8;
    const LabProfile made = measured(lab, 6);
    SCOPED_TRACE(made.text);
    const Profile found = profile_of(made);
    EXPECT_NEAR(mean_delay_ms(found), mean_delay_ms(lab.truth), 0.1 * mean_delay_ms(lab.truth));
    // Each value with its share.
    for (const ControlTiming::Delay& delay : delays) {
      double share = 0;
      for (const ControlTiming::Delay& one : found.timing.delays) {
        if (std::abs(one.sub_steps - delay.sub_steps) <= 2) share += one.probability;
      }
      EXPECT_NEAR(share, delay.probability, 0.1) << delay.sub_steps;
    }
  }
}

TEST(LabProfile, OfAWorldLikeTheBaseIsTheBase) {
  const LabProfile made = measured({.truth = rvr_profile()}, 2);
  SCOPED_TRACE(made.text);
  const Profile found = profile_of(made);
  EXPECT_LT(mean_delay_ms(found), 5);
  EXPECT_NEAR(found.treads.way, 1, 0.005);
  EXPECT_NEAR(found.treads.turn, 1, 0.005);
  EXPECT_LT(found.neighbours.miss_rate, 0.005);
}

TEST(LabProfile, FindsTheSpreadBetweenRobots) {
  VirtualLab lab{.truth = rvr_profile(), .tells_latency = false};
  lab.truth.treads = {.way = 0.9, .way_sd = 0.05, .turn = 0.8, .turn_sd = 0.1};
  const Profile found = profile_of(measured(lab, 16));
  EXPECT_NEAR(found.treads.way, 0.9, 0.02);
  EXPECT_NEAR(found.treads.way_sd, 0.05, 0.015);
  EXPECT_NEAR(found.treads.turn, 0.8, 0.04);
  EXPECT_NEAR(found.treads.turn_sd, 0.1, 0.03);
}

TEST(LabProfile, TellsRobotsThatHaveTroubleFromOthers) {
  VirtualLab lab{.truth = rvr_profile(), .tells_latency = false};
  lab.truth.neighbours = {.miss_rate = 0.05, .weak_share = 0.3, .weak_miss_rate = 0.6};
  const Profile found = profile_of(measured(lab, 12));
  EXPECT_NEAR(found.neighbours.miss_rate, 0.05, 0.01);
  EXPECT_NEAR(found.neighbours.weak_share, 0.3, 0.2);
  EXPECT_NEAR(found.neighbours.weak_miss_rate, 0.6, 0.06);
}

TEST(LabProfile, WhoPushesAWallDoesNotSlip) {
  VirtualLab lab{.truth = rvr_profile(), .tells_latency = false};
  lab.truth.proximity.largest_miss_rate = 1;  // they run into everything
  lab.truth.treads = {.way = 0.95, .turn = 0.9};
  const Profile found = profile_of(measured(lab, 8));
  EXPECT_NEAR(found.treads.way, 0.95, 0.01);
  EXPECT_NEAR(found.treads.turn, 0.9, 0.02);
}

TEST(LabProfile, APushIsNoSlip) {
  VirtualLab lab{.truth = rvr_profile(), .pushed_m = 0.3};
  lab.truth.timing.delays = {{20, 1}};
  lab.truth.treads = {.way = 0.85, .turn = 0.8};
  const LabProfile made = measured(lab, 2);
  const Profile found = profile_of(made);
  EXPECT_NEAR(found.treads.way, 0.85, 0.015);
  EXPECT_NEAR(found.treads.turn, 0.8, 0.002);
  EXPECT_NEAR(mean_delay_ms(found), 200, 5);
}

/// Also of one run with the log of one robot.
TEST(LabProfile, OfOneRobotInOneRunSaysSo) {
  VirtualLab lab{.truth = rvr_profile()};
  lab.truth.timing.delays = {{20, 1}};
  lab.truth.treads = {.way = 0.85, .turn = 0.8};
  std::vector<MeasuredRobot> robots = lab.run(1);
  robots.resize(1);
  const LabProfile made = lab_profile({.robots = robots, .base = "rvr", .program = "test"});
  const Profile found = profile_of(made);
  EXPECT_NEAR(found.treads.way, 0.85, 0.005);
  EXPECT_EQ(found.treads.way_sd, 0);
  EXPECT_NEAR(mean_delay_ms(found), 200, 5);
  EXPECT_EQ(figure(made, "latency").basis, "of 1 robot in 1 run");
}

TEST(LabProfile, AHeadingThatIsOffCostsTheNeighboursAndNoMore) {
  VirtualLab lab{.truth = rvr_profile(), .heading_off_rad = 2, .tells_latency = false};
  lab.truth.treads = {.way = 0.9, .turn = 0.8};
  const LabProfile made = measured(lab);
  const Profile found = profile_of(made);
  EXPECT_NEAR(found.treads.way, 0.9, 0.01);
  EXPECT_NEAR(found.treads.turn, 0.8, 0.02);
  EXPECT_FALSE(figure(made, "neighbours missed").value);
  EXPECT_THAT(made.text, HasSubstr("are where no robot was; is its heading calibrated"));
}

TEST(LabProfile, LeavesWhatRunsCannotTellAsInTheBase) {
  // Robots that stand.
  VirtualLab lab{.truth = rvr_profile(), .machine = "--nstates 1 --s0 1"};
  lab.truth.timing.delays = {{20, 1}};
  lab.truth.treads = {.way = 0.5, .turn = 0.5};
  const LabProfile made =
      lab_profile({.robots = lab.runs(2), .base = "pseudo-reality", .program = "test"});
  const Profile base = built_in_profile("pseudo-reality").value();
  const Profile found = profile_of(made);
  EXPECT_EQ(found.timing.delays, base.timing.delays);
  EXPECT_EQ(found.treads, base.treads);
  EXPECT_FALSE(figure(made, "latency").value);
  EXPECT_THAT(figure(made, "latency").reason,
              HasSubstr("run1, rvr1: its commands did not move it"));
  EXPECT_THAT(made.text,
              HasSubstr("# latency: as in `pseudo-reality`, because no robot's runs show "
                        "it: run1, rvr1: its commands did not move it"));
  EXPECT_THAT(made.text, HasSubstr("of 3 robots"));
}

TEST(LabProfile, SaysHowManyRobotsAndRunsItRestsOn) {
  VirtualLab lab{.truth = rvr_profile(), .tells_latency = false};
  lab.truth.treads.turn = 0.8;
  const LabProfile made = measured(lab, 2);
  EXPECT_THAT(made.text,
              HasSubstr("measured on 3 robots (rvr1, rvr2, rvr3) in 2 runs (run1, run2)"));
  EXPECT_THAT(made.text, HasSubstr("base   = \"rvr\""));
  const Pooled turn = *figure(made, "turn made, of that commanded").value;
  EXPECT_LT(turn.low, 0.8);
  EXPECT_GT(turn.high, 0.8);
  EXPECT_LT(turn.high - turn.low, 0.1);
}

TEST(LabProfile, OfNoRunsIsNotMeasured) {
  const LabProfile made = lab_profile({.robots = {}, .base = "rvr", .program = "test"});
  EXPECT_FALSE(made.is_measured());
  EXPECT_THAT(made.text, Not(HasSubstr("delays")));
}

}  // namespace
}  // namespace swarmsmith
