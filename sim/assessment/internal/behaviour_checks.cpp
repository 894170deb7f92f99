#include "sim/assessment/internal/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <variant>

#include "base/assert.h"
#include "base/math.h"
#include "base/overloaded.h"
#include "sim/assessment/internal/contact.h"
#include "sim/assessment/internal/settings.h"

namespace swarmsmith::assessment {
namespace {

using Robots = std::span<const RobotRecord>;

/// The tiles of grid exploration: 10 x 10 over a square of 2.50001 m (rvr-automode facts, 8).
constexpr int kTiles = 10;
constexpr double kTilesSide_m = 2.50001;
constexpr int kLeastTiles = 40;
constexpr double kMostContact = 0.05;

/// Number of the tile at a point of the arena, which must be within the square.
int tile_at(Point point) {
  const auto index = [](double x) {
    return static_cast<int>((x / kTilesSide_m + 0.5) * static_cast<double>(kTiles));
  };
  return index(point.y) * kTiles + index(point.x);
}

std::vector<Check> check_exploration(const Machine& machine, const Subject& subject) {
  const Mission mission = mission_in(dodecagon_of_the_thesis(), subject.robot);
  std::vector<double> tiles;
  std::vector<double> contact;
  for (int seed = 1; seed <= kBehaviourRuns; ++seed) {
    std::set<int> entered;
    int touching = 0;
    const auto observe = [&](const Snapshot& now) {
      if (now.cycle == 0) return;
      std::vector<Pose> poses;
      for (const RobotRecord& robot : now.robots) {
        poses.push_back(robot.pose);
        entered.insert(tile_at(robot.pose.position()));
      }
      touching += any_contact(subject.robot.body.outline, poses, mission.arena) ? 1 : 0;
    };
    watch({machine, subject, mission}, starts_anywhere(mission, seed), seed, observe);
    tiles.push_back(static_cast<double>(entered.size()));
    contact.push_back(static_cast<double>(touching) / kCycles);
  }
  std::vector<double> percent = contact;
  for (double& share : percent)
    share *= 100;
  return {
      {.setting = "gray arena",
       .runs = kBehaviourRuns,
       .quantity = "tiles_entered",
       .values = tiles,
       .passes = std::ranges::all_of(tiles, [](double n) { return n >= kLeastTiles; }),
       .measured = range_text(tiles, 0) + " tiles",
       .expected = fmt::format("at least {}", kLeastTiles),
       .note = {}},
      {.setting = "gray arena",
       .runs = kBehaviourRuns,
       .quantity = "contact_share",
       .values = contact,
       .passes = std::ranges::all_of(contact, [](double share) { return share < kMostContact; }),
       .measured = range_text(percent, 1) + " % contact",
       .expected = fmt::format("below {:.0f} %", 100 * kMostContact),
       .note = {}},
  };
}

constexpr double kFarthestRest_m = 0.001;

std::vector<Check> check_stop(const Machine& machine, const Subject& subject) {
  const Mission mission = mission_in(dodecagon_of_the_thesis(), subject.robot);
  std::vector<double> moves_mm;
  for (int seed = 1; seed <= kBehaviourRuns; ++seed) {
    const std::vector<Pose> starts = starts_anywhere(mission, seed);
    double farthest = 0;
    const auto observe = [&](const Snapshot& now) {
      for (std::size_t i = 0; i < starts.size(); ++i) {
        const Pose& pose = now.robots[i].pose;
        farthest = std::max(farthest, hypot(pose.x - starts[i].x, pose.y - starts[i].y));
      }
    };
    watch({machine, subject, mission}, starts, seed, observe);
    moves_mm.push_back(1000 * farthest);
  }
  return {{.setting = "from rest",
           .runs = kBehaviourRuns,
           .quantity = "farthest_move_mm",
           .values = moves_mm,
           .passes = std::ranges::all_of(
               moves_mm, [](double move) { return move <= 1000 * kFarthestRest_m; }),
           .measured = range_text(moves_mm, 2) + " mm",
           .expected = fmt::format("at most {:.0f} mm", 1000 * kFarthestRest_m),
           .note = {}}};
}

constexpr int kLastCycles = 100;  ///< 10 s

/// Mean distance over all pairs of robots, metres.
double pair_distance(Robots robots) {
  double sum = 0;
  int pairs = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t j = i + 1; j < robots.size(); ++j, ++pairs) {
      sum += hypot(robots[i].pose.x - robots[j].pose.x, robots[i].pose.y - robots[j].pose.y);
    }
  }
  return sum / pairs;
}

/// Above the wall on the x axis, so that robots can flee to the other side.
constexpr Light kLight = {.x_m = 1.226, .y_m = 0};

/// Mean horizontal distance from the light, metres.
double light_distance(Robots robots) {
  double sum = 0;
  for (const RobotRecord& robot : robots)
    sum += hypot(robot.pose.x - kLight.x_m, robot.pose.y - kLight.y_m);
  return sum / static_cast<double>(robots.size());
}

struct DistanceTest {
  double (*distance)(Robots robots);
  bool falls = false;
  bool with_light = false;
};

/// The steering of robots that see neighbours, in control cycles.
struct Steering {
  int straight = 0;
  int towards = 0;  ///< to the side on which the neighbours are
  int away = 0;

  void add(const RobotRecord& robot) {
    if (robot.readings == nullptr || robot.readings->neighbours.empty()) return;
    double side = 0;
    for (const Neighbour& neighbour : robot.readings->neighbours)
      side += neighbour.direction_y;
    const double turn = robot.command.right_mps - robot.command.left_mps;
    ++(turn == 0 ? straight : turn * side > 0 ? towards : away);
  }

  bool saw_any() const { return straight + towards + away > 0; }

  std::string text() const {
    if (!saw_any()) return std::string(kNoneSeen);
    const double percent = 100.0 / (straight + towards + away);
    return fmt::format(
        "robots that saw a neighbour steered towards its side in {:.0f} % of the cycles, to the "
        "other in {:.0f} %, and went straight ahead in {:.0f} %",
        percent * towards, percent * away, percent * straight);
  }
};

std::vector<Check> check_distance(const DistanceTest& test, const Machine& machine,
                                  const Subject& subject) {
  Mission mission = mission_in(dodecagon_of_the_thesis(), subject.robot);
  if (test.with_light) mission.arena.lights.push_back(kLight);
  std::vector<double> changes;
  Steering steering;
  for (int seed = 1; seed <= kBehaviourRuns; ++seed) {
    double start = 0;
    double end = 0;
    const auto observe = [&](const Snapshot& now) {
      const double distance = test.distance(now.robots);
      if (now.cycle == 0) start = distance;
      if (now.cycle > kCycles - kLastCycles) end += distance / kLastCycles;
      for (const RobotRecord& robot : now.robots)
        steering.add(robot);
    };
    watch({machine, subject, mission}, starts_in_a_group(subject.robot, seed), seed,
          Recorder(observe, Sensor::Neighbours));
    changes.push_back(end - start);
  }
  const bool passes =
      (test.with_light || steering.saw_any()) && std::ranges::all_of(changes, [&](double change) {
        return test.falls ? change < 0 : change > 0;
      });
  const PairDistances pairs = pairs_of(subject.robot);
  return {{.setting = test.with_light ? "a light at the wall"
                                      : fmt::format("group, {:.2g} to {:.2g} m", pairs.nearest_m,
                                                    pairs.farthest_m),
           .runs = kBehaviourRuns,
           .quantity = test.with_light ? "change_of_light_distance_m" : "change_of_pair_distance_m",
           .values = changes,
           .passes = passes,
           .measured = range_text(changes, 2) + " m",
           .expected = test.falls ? "below 0 m" : "above 0 m",
           .note = passes || test.with_light ? std::string() : steering.text()}};
}

double parameter_value(const ParameterSpec& parameter) {
  if (parameter.name == "alpha") return kAlpha;
  if (parameter.name == "tau" || parameter.name == "step") return kTau;
  if (parameter.name == "rho") return kRho;
  SWARMSMITH_ASSERT(parameter.name == "mu", "the assessment knows the behaviour's parameters");
  return kMu;
}

}  // namespace

std::vector<Check> check_behaviour(const ModuleSpec& spec, const Subject& subject) {
  std::vector<double> parameters;
  for (const ParameterSpec& parameter : spec.parameters)
    parameters.push_back(parameter_value(parameter));
  const Behaviour behaviour = make_behaviour(spec.module, parameters);
  const Machine machine{{{behaviour, {}}}};
  // The expected result of a behaviour cannot be derived from its code: each has its own case here.
  return std::visit(
      Overloaded{[&](const Exploration&) { return check_exploration(machine, subject); },
                 [&](const RandomWalk&) { return check_exploration(machine, subject); },
                 [&](const LevyWalk&) { return check_exploration(machine, subject); },
                 [&](const Stop&) { return check_stop(machine, subject); },
                 [&](const Attraction&) {
                   return check_distance({pair_distance, true}, machine, subject);
                 },
                 [&](const Repulsion&) {
                   return check_distance({pair_distance, false}, machine, subject);
                 },
                 [&](const Phototaxis&) {
                   return check_distance({light_distance, true, true}, machine, subject);
                 },
                 [&](const AntiPhototaxis&) {
                   return check_distance({light_distance, false, true}, machine, subject);
                 },
                 [](const ExternalBehaviour&) { return std::vector<Check>(); }},
      behaviour);
}

}  // namespace swarmsmith::assessment
