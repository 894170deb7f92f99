#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "base/text/csv.h"
#include "sim/control/controller.h"
#include "sim/control/readings.h"
#include "sim/engine/internal/robot_senses.h"
#include "sim/engine/internal/sight.h"
#include "sim/engine/internal/world.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"
#include "tests/sim/engine/statistics.h"
#include "tests/support/long_runs.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

// The e-puck against traces of its original program (tests/golden/epuck).

namespace swarmsmith {
namespace {

/// A row by the names of its columns.
using Row = std::map<std::string, std::string>;

double number_in(const Row& row, const std::string& column) {
  return std::stod(row.at(column));
}

std::vector<Row> rows_of(const std::string& name) {
  const std::string text = whole_file(SWARMSMITH_TEST_DATA "/epuck/" + name);
  CsvReader reader(text);
  const std::vector<std::string> head = reader.next().value();
  std::vector<Row> rows;
  while (!reader.at_end()) {
    const std::vector<std::string> cells = reader.next().value();
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < head.size(); ++i)
      row[head[i]] = cells.at(i);
  }
  return rows;
}

Mission golden_mission(const std::string& name) {
  auto mission =
      read_mission_file(SWARMSMITH_SOURCE_DIR "/examples/missions/epuck/" + name + ".toml");
  if (!mission) throw std::runtime_error(to_string(mission.error().front()));
  return std::move(mission->mission);
}

const Profile& ideal() {
  static const Profile kIdeal = built_in_profile("epuck-ideal").value();
  return kIdeal;
}

/// Robots that stand at their places, and the senses of the first.
struct Stand {
  Stand(const Mission& mission, std::vector<Pose> at, const Profile& profile = ideal())
      : arena(mission.arena),
        poses(std::move(at)),
        world(arena, mission.robot, poses, ContactModel::Exact),
        senses(world, arena, profile, 0, Rng(1)) {
    senses.remember(Sensors::all());
    begin(1);
  }
  void begin(int cycle) {
    senses.begin_cycle({.number = cycle, .time_s = 0.1 * cycle, .acted = {}});
  }

  Arena arena;
  std::vector<Pose> poses;
  World world;
  RobotSenses senses;
};

void expect_readings(const Row& row, const std::string& stem, std::span<const double> readings,
                     double within) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(readings[i], number_in(row, stem + std::to_string(i)), within)
        << stem << i << " at " << row.begin()->second;
  }
}

TEST(Epuck, ReadsAWallAsTheOriginalDoes) {
  const Mission mission = golden_mission("rt-aac");
  for (const Row& row : not_empty(rows_of("module-proximity-wall.csv"))) {
    Stand stand(mission, {{1.226 - 0.035 - number_in(row, "gap"), 0,
                           number_in(row, "heading_deg") * kPi / 180}});
    expect_readings(row, "prox", stand.senses.proximity(), 1e-6);
  }
}

TEST(Epuck, ReadsAnotherRobotAsTheOriginalDoes) {
  const Mission mission = golden_mission("rt-aac");
  for (const Row& row : not_empty(rows_of("module-proximity-robot.csv"))) {
    const double bearing = number_in(row, "bearing_deg") * kPi / 180;
    const double distance = number_in(row, "distance");
    Stand stand(mission, {{0, 0, 0}, {distance * cos(bearing), distance * sin(bearing), 0}});
    expect_readings(row, "prox", stand.senses.proximity(), 1e-6);
  }
}

TEST(Epuck, ReadsTheLightAsTheOriginalDoes) {
  const Mission mission = golden_mission("rt-aac");
  int hidden = 0;
  for (const Row& row : not_empty(rows_of("module-light.csv"))) {
    std::vector<Pose> poses = {
        {number_in(row, "x"), number_in(row, "y"), number_in(row, "heading_deg") * kPi / 180}};
    if (!row.at("neighbour_x").empty())
      poses.push_back({number_in(row, "neighbour_x"), number_in(row, "neighbour_y"), 0});
    Stand stand(mission, poses);
    expect_readings(row, "light", stand.senses.light(), 1e-6);
    hidden += number_in(row, "light_value") == 0 ? 1 : 0;
    const Flavour flavour = **find_flavour("chocolate-epuck");
    LightModel model = flavour.light;
    model.directions = labels_of(mission.robot);
    const Vector2 light = light_vector(stand.senses.light(), model);
    EXPECT_NEAR(hypot(light.x, light.y), number_in(row, "light_value"), 1e-6);
    if (number_in(row, "light_value") > 0) {
      EXPECT_NEAR(wrap_angle(atan2(light.y, light.x) - number_in(row, "light_angle")), 0, 1e-5);
    }
  }
  EXPECT_GT(hidden, 3);
}

/// Where there is nothing to read, noise is seen where it is positive.
TEST(Epuck, EachSensorHasUniformNoiseOfItsOwn) {
  constexpr int kCycles = 1000;
  Profile noisy = ideal();
  noisy.proximity.half_width = noisy.light.half_width = 0.05;
  Mission mission = golden_mission("rt-aac");
  mission.arena.lights.clear();
  Stand stand(mission, {{0, 0, 0}}, noisy);
  std::array<int, 2 * kProximitySensors> above{};
  std::vector<double> strengths;
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    stand.begin(cycle);
    for (std::size_t i = 0; i < above.size(); ++i) {
      const std::size_t sensor = i % kProximitySensors;
      const double strength =
          i < kProximitySensors ? stand.senses.proximity()[sensor] : stand.senses.light()[sensor];
      if (strength == 0) continue;
      ++above.at(i);
      strengths.push_back(strength);
    }
  }
  for (const int count : above)
    EXPECT_LT(std::fabs(binomial_z(count, kCycles, 0.5)), 3.3);
  EXPECT_LT(ks_statistic(strengths, [](double x) { return x / 0.05; }), kKsLimit);
}

TEST(Epuck, HearsOthersAsTheOriginalDoes) {
  int hidden = 0;
  for (const Row& row : not_empty(rows_of("module-radio.csv"))) {
    Mission mission = golden_mission("rt-aac");
    mission.robot.neighbours.range_m = number_in(row, "range");
    const double distance = number_in(row, "distance");
    const bool has_hider = !row.at("hider_offset").empty();
    const double bearing = has_hider ? 0 : 0.7;
    std::vector<Pose> poses = {{0, 0, number_in(row, "heading_deg") * kPi / 180},
                               {distance * cos(bearing), distance * sin(bearing), 0}};
    if (has_hider) {
      const double offset = number_in(row, "hider_offset");
      poses.push_back({distance / 2, offset, 0});
    }
    Stand stand(mission, poses);
    for (int cycle = 2; cycle <= static_cast<int>(number_in(row, "tick")); ++cycle)
      stand.begin(cycle);
    EXPECT_EQ(stand.senses.neighbour_count(), number_in(row, "neighbours"))
        << distance << " " << row.at("hider_offset");
    EXPECT_EQ(static_cast<double>(stand.senses.neighbours().size()), number_in(row, "buffered"));
    hidden += has_hider ? 1 : 0;
    Vector2 sum;
    for (const Neighbour& heard : stand.senses.neighbours()) {
      const double strength = 1 / (1 + 100 * heard.distance_m);
      sum.x += strength * heard.direction_x;
      sum.y += strength * heard.direction_y;
    }
    EXPECT_NEAR(hypot(sum.x, sum.y), number_in(row, "attr1_length"), 1e-6);
    EXPECT_NEAR(wrap_angle(atan2(sum.y, sum.x) - number_in(row, "attr1_angle")), 0, 1e-4);
  }
  EXPECT_GT(hidden, 0);
}

/// Few robots are tried one by one, many by a search for near ones.
TEST(Epuck, RobotsHideEachOtherHoweverManyThereAre) {
  const Robot robot = golden_mission("rt-aac").robot;
  const double radius_m = std::get<CircleOutline>(robot.body.outline).radius_m;
  for (const int robots : {20, 90}) {
    Rng rng(7);
    std::vector<Pose> poses;
    for (int i = 0; i < robots; ++i)
      poses.push_back({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3)});
    const Arena arena = dodecagon_of_the_thesis();
    const World world(arena, robot, poses, ContactModel::Exact);
    const Sight sight(world, arena.wall_height_m);
    std::vector<int> room;
    int hidden = 0;
    for (int a = 0; a < robots; ++a) {
      for (int b = 0; b < a; ++b) {
        const auto hides = [&](int third) {
          if (third == a || third == b) return false;
          const Pose from = poses.at(static_cast<std::size_t>(a));
          const Pose to = poses.at(static_cast<std::size_t>(b));
          const Pose at = poses.at(static_cast<std::size_t>(third));
          const double x = to.x - from.x;
          const double y = to.y - from.y;
          const double on =
              std::clamp(((at.x - from.x) * x + (at.y - from.y) * y) / (x * x + y * y), 0.0, 1.0);
          return std::hypot(from.x + on * x - at.x, from.y + on * y - at.y) <= radius_m;
        };
        bool expected = false;
        for (int third = 0; third < robots; ++third)
          expected = expected || hides(third);
        EXPECT_EQ(sight.is_hidden(a, b, room), expected) << robots << " " << a << " " << b;
        EXPECT_EQ(sight.is_hidden(b, a, room), expected) << robots << " " << a << " " << b;
        hidden += expected ? 1 : 0;
      }
    }
    EXPECT_GT(hidden, robots);
    EXPECT_LT(hidden, robots * robots / 2 - robots);
  }
}

/// Lets the robots drive by the commands of a trace.
class Trace final : public Decider {
 public:
  explicit Trace(std::vector<std::vector<Row>> ticks) : ticks_(std::move(ticks)) {}

  void ask(const Question& question) override {
    const auto cycle = static_cast<std::size_t>(question.cycle) - 1;
    if (cycle >= ticks_.size()) return;
    const Row& row = ticks_[cycle].at(static_cast<std::size_t>(question.robot));
    command_ = {number_in(row, "cmd_left") / 100, number_in(row, "cmd_right") / 100};
    answers_.resize(ticks_.front().size());
    answers_[static_cast<std::size_t>(question.robot)] = Answer{command_, 0};
  }
  std::optional<Answer> answer(int robot) override {
    return answers_.empty() ? std::nullopt : answers_.at(static_cast<std::size_t>(robot));
  }
  const std::vector<std::vector<Row>>& ticks() const { return ticks_; }

 private:
  std::vector<std::vector<Row>> ticks_;
  std::vector<std::optional<Answer>> answers_;
  Command command_;
};

std::vector<std::vector<Row>> ticks_of(const std::string& file) {
  std::vector<std::vector<Row>> ticks;
  for (const Row& row : rows_of(file)) {
    const auto tick = static_cast<std::size_t>(number_in(row, "tick"));
    if (ticks.size() < tick) ticks.emplace_back();
    ticks.back().push_back(row);
  }
  return ticks;
}

/// In the first cycle no robot has moved yet.
std::vector<Pose> starts_of(const std::vector<Row>& first_tick) {
  std::vector<Pose> starts;
  for (const Row& row : first_tick)
    starts.push_back({number_in(row, "x"), number_in(row, "y"), number_in(row, "theta")});
  return starts;
}

/// The farthest that a robot is from where it was in the original, over `cycles` cycles.
double farthest_off(const std::string& mission_name, const std::string& file, int cycles,
                    bool reads) {
  Mission mission = golden_mission(mission_name);
  Trace trace(ticks_of(file));
  const std::size_t robots = trace.ticks().front().size();
  mission.robots = static_cast<int>(robots);
  mission.cycles = cycles;
  const Instance instance{.starts = starts_of(trace.ticks().front()), .patches = {}};
  double farthest = 0;
  const Recorder recorder(
      [&](const Snapshot& snapshot) {
        if (snapshot.cycle == 0) return;
        const auto& tick = trace.ticks().at(static_cast<std::size_t>(snapshot.cycle) - 1);
        for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
          const Pose& pose = snapshot.robots[i].pose;
          farthest = std::max(
              farthest, hypot(pose.x - number_in(tick[i], "x"), pose.y - number_in(tick[i], "y")));
          if (!reads) continue;
          expect_readings(tick[i], "prox", snapshot.robots[i].readings->proximity_m, 2e-4);
          expect_readings(tick[i], "light", snapshot.robots[i].readings->light_lux, 2e-4);
          const double gray = number_in(tick[i], "ground");
          EXPECT_EQ(snapshot.robots[i].readings->ground_color.r, gray == 0   ? 0
                                                                 : gray == 1 ? 255
                                                                             : 127)
              << snapshot.cycle;
        }
      },
      Sensors(Sensor::Proximity) | Sensor::LightRing | Sensor::GroundColor);
  const Controller idle = Machine{.states = {{.behaviour = Stop{}, .transitions = {}}}};
  simulate({.controller = idle,
            .flavour = **find_flavour("chocolate-epuck"),
            .profile = ideal(),
            .mission = mission,
            .instance = instance},
           recorder, &trace);
  return farthest;
}

TEST(Epuck, DrivesAsTheOriginalDoes) {
  for (const char* run : {"rt-aac-hc03", "rt-for-hc07", "rt-grid-hc04"}) {
    const std::string name = run;
    EXPECT_LT(farthest_off(name.substr(0, name.rfind('-')), "traj-" + name + "-nonoise-1robots.csv",
                           600, true),
              1e-3)
        << name;
  }
}

TEST(Epuck, DrivesInASwarmAsTheOriginalDoesForSixSeconds) {
  EXPECT_LT(farthest_off("rt-aac", "traj-rt-aac-hc03-nonoise-20robots.csv", 60, false), 1e-3);
}

/// The reading of the start is of the same kind as the later ones.
TEST(Epuck, SeesThreeGraysUnderItBeforeItsDriversFirstBeat) {
  Mission mission = golden_mission("rt-aac");
  mission.arena.floor = {255, 255, 255};
  mission.arena.patches.clear();
  mission.shuffled = {};
  mission.cycles = 3;
  Profile profile = ideal();
  profile.timing.driver_sub_steps = 100;
  const Flavour& flavour = **find_flavour("chocolate-epuck-2018");
  ASSERT_TRUE(flavour.floor.any_channel);
  const Controller machine = parse_controller("--nstates 1 --s0 1", flavour).value();
  int seen = 0;
  const Recorder recorder(
      [&](const Snapshot& snapshot) {
        for (const RobotRecord& robot : snapshot.robots) {
          if (robot.readings == nullptr) continue;
          EXPECT_EQ(robot.readings->ground_color, (Rgb{255, 255, 255})) << snapshot.cycle;
          ++seen;
        }
      },
      Sensor::GroundColor);
  simulate({.controller = machine,
            .flavour = flavour,
            .profile = profile,
            .mission = mission,
            .instance = instance_of(mission, 1).value()},
           recorder);
  EXPECT_EQ(seen, 3 * mission.robots);
}

/// Each wheel's speed is multiplied by 1 + a normal number, drawn anew in each tick (epuck facts,
/// section 2). It acts from the second of the ten sub-steps on.
TEST(Epuck, EachWheelHasNormalNoiseOfItsOwn) {
  constexpr double kSd = 0.05;
  constexpr double kSubStep_s = 0.01;
  Mission mission = golden_mission("rt-aac");
  mission.robots = 1;
  mission.cycles = 60;  // the robot does not reach a wall
  Profile profile = ideal();
  profile.treads.sd = kSd;
  const Flavour& flavour = **find_flavour("chocolate-epuck");
  const Controller machine = parse_controller("--nstates 1 --s0 0 --rwm0 5", flavour).value();
  std::vector<double> sums;         // of both wheels' normal numbers, with variance 1
  std::vector<double> differences;  // the same
  double product = 0;
  for (std::int64_t seed = 1; seed <= 40; ++seed) {
    Pose last;
    double speed_mps = 0;
    double spin_radps = 0;
    const Recorder recorder([&](const Snapshot& now) {
      const auto& [pose, command, state, readings] = now.robots.front();
      const double way_m = std::hypot(pose.x - last.x, pose.y - last.y);
      speed_mps = (way_m / kSubStep_s - speed_mps) / 9;
      spin_radps = ((pose.theta - last.theta) / kSubStep_s - spin_radps) / 9;
      last = pose;
      if (now.cycle < 2) return;
      sums.push_back((speed_mps / command.left_mps - 1) * std::sqrt(2.0) / kSd);
      differences.push_back(spin_radps * mission.robot.drive.track_m / command.left_mps /
                            (std::sqrt(2.0) * kSd));
      product += sums.back() * differences.back();
    });
    simulate({.controller = machine,
              .flavour = flavour,
              .profile = profile,
              .mission = mission,
              .instance = {.starts = {{0, 0, 0}}, .patches = {}},
              .seed = seed},
             recorder);
  }
  const auto n = static_cast<double>(sums.size());
  ASSERT_GT(n, 2000);
  EXPECT_LT(ks_statistic(sums, normal_cdf), kKsLimit);
  EXPECT_LT(ks_statistic(differences, normal_cdf), kKsLimit);
  EXPECT_LT(std::fabs(product), 3.3 * std::sqrt(n)) << "the wheels' numbers depend on each other";
}

/// As in the original, where a mission's walls come after the robots (epuck facts, section 6.1).
TEST(Epuck, DrivesOutOfAWallInWhichItStarts) {
  Mission mission = golden_mission("oc-sca");
  EXPECT_TRUE(mission.ignores_obstacles);
  mission.robots = 1;
  const Flavour& flavour = **find_flavour("chocolate-epuck");
  const Controller machine = parse_controller("--nstates 1 --s0 0 --rwm0 5", flavour).value();
  for (const Point start : {Point{0, -0.1}, Point{0.3125, -0.02}, Point{-0.2, -0.09}}) {
    mission.placement = PlaceAt{{{start.x, start.y, 0.4}}};
    const Instance instance = instance_of(mission, 1).value();
    Point last = start;
    double longest_m = 0;
    const Recorder recorder([&](const Snapshot& snapshot) {
      const Point here = snapshot.robots[0].pose.position();
      longest_m = std::max(longest_m, hypot(here.x - last.x, here.y - last.y));
      last = here;
    });
    simulate({.controller = machine,
              .flavour = flavour,
              .profile = ideal(),
              .mission = mission,
              .instance = instance},
             recorder);
    EXPECT_GT(hypot(last.x - start.x, last.y - start.y), 0.1) << start.x << " " << start.y;
    EXPECT_LT(longest_m, 0.0121) << "no wall throws it out";
  }
}

/// A machine's scores there, and here.
struct Compared {
  std::string machine;
  double theirs = 0;
  double half_width_99 = 0;
  double ours = 0;
  double z = 0;  ///< the difference in its standard errors
};

std::vector<Compared> compared(const std::string& mission_name, int seeds) {
  const Mission mission = golden_mission(mission_name);
  const Profile profile = built_in_profile("epuck").value();
  std::vector<Compared> all;
  for (const Row& row : rows_of("scores.csv")) {
    if (row.at("mission") != mission_name) continue;
    const Flavour& flavour = **find_flavour(row.at("flavour"));
    const Controller machine = parse_controller(row.at("text"), flavour).value();
    double sum = 0;
    double squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Instance instance = instance_of(mission, seed).value();
      const double score = simulate({.controller = machine,
                                     .flavour = flavour,
                                     .profile = profile,
                                     .mission = mission,
                                     .instance = instance,
                                     .seed = seed})
                               .score;
      sum += score;
      squares += score * score;
    }
    const double mean = sum / seeds;
    const double variance = std::max(0.0, squares / seeds - mean * mean) / (seeds - 1);
    const double theirs = number_in(row, "sd");
    const double error = std::sqrt(variance + theirs * theirs / number_in(row, "n"));
    all.push_back({.machine = row.at("machine"),
                   .theirs = number_in(row, "mean"),
                   .half_width_99 = number_in(row, "half_width_99"),
                   .ours = mean,
                   .z = (mean - number_in(row, "mean")) / std::max(error, 1e-9)});
  }
  return all;
}

/// Spearman's, of means that are all different.
double rank_correlation(const std::vector<Compared>& all) {
  const auto rank = [&](double Compared::*of, const Compared& one) {
    return std::ranges::count_if(all, [&](const Compared& other) { return other.*of < one.*of; });
  };
  double squares = 0;
  for (const Compared& one : all) {
    const auto apart =
        static_cast<double>(rank(&Compared::theirs, one) - rank(&Compared::ours, one));
    squares += apart * apart;
  }
  const auto n = static_cast<double>(all.size());
  return 1 - 6 * squares / (n * (n * n - 1));
}

TEST(Epuck, ScoresItsMachinesAsTheOriginalDoes) {
  const std::vector<std::pair<std::string, double>> least_correlations = {
      {"rt-for", 0.95}, {"rt-grid", 0.95}, {"rt-aac", 0.8}, {"mp-for", 0.95}};
  const auto missions = static_cast<std::size_t>(times(1, 4));
  for (std::size_t i = 0; i < missions; ++i) {
    const auto& [mission, least_correlation] = least_correlations[i];
    const std::vector<Compared> all = compared(mission, 5);
    ASSERT_GT(all.size(), 15U);
    double squares = 0;
    for (const Compared& one : all) {
      EXPECT_LT(std::fabs(one.z), 4.5) << mission << " " << one.machine << ": " << one.theirs
                                       << " there, " << one.ours << " here";
      squares += one.z * one.z;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(all.size())), 1.6) << mission;
    EXPECT_GE(rank_correlation(all), least_correlation) << mission;
  }
}

}  // namespace
}  // namespace swarmsmith
