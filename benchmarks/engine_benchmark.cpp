#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/sim/engine/reference_data.h"
#include "tests/sim/engine/reference_runs.h"

// The cost of one evaluation: three robots, 120 s, 1200 control cycles, on one core. The counter
// ms_each is CPU time per evaluation; bare_loops is the same time in units of a bare Box2D loop of
// the same world.

namespace swarmsmith {
namespace {

/// Control software, and the runs on which it is measured.
struct Subject {
  Controller controller;
  const ReferenceRuns* runs;
};

/// The missions with the original's instances, with the given flavour and profile.
std::map<std::string, ReferenceRuns> missions_in(const char* flavour, const char* profile) {
  std::map<std::string, ReferenceRuns> missions;
  for (const ReferenceMission& mission : kReferenceMissions) {
    ReferenceRuns runs(mission.ours);
    runs.flavour = find_flavour(flavour).value();
    runs.profile = built_in_profile(profile).value();
    missions.emplace(mission.theirs, runs);
  }
  return missions;
}

/// The reference for times: the same bodies and walls, one step for each cycle, no sensors, no
/// control software. The robots drive in circles of 0.2 m without meeting each other, so that
/// contacts cost nothing. Continuous collision is off, since nothing here is fast enough to need
/// it: with it, Box2D 2.4 also computes when each robot would hit each wall whose box it is in, and
/// reads the clock twice each time, which doubles the loop's time.
void run_bare_loop() {
  static constexpr std::array<Pose, 3> kStarts = {Pose{0.7, -0.2, 0}, Pose{-0.35, 0.4, 0},
                                                  Pose{-0.35, -0.8, 0}};
  b2World world(b2Vec2_zero);
  world.SetContinuousPhysics(false);
  b2BodyDef ground_definition;
  b2Body* ground = world.CreateBody(&ground_definition);
  for (const Wall& wall : dodecagon_of_the_thesis().walls) {
    b2EdgeShape edge;
    edge.SetTwoSided({static_cast<float>(wall.from.x), static_cast<float>(wall.from.y)},
                     {static_cast<float>(wall.to.x), static_cast<float>(wall.to.y)});
    ground->CreateFixture(&edge, 0);
  }
  std::vector<b2Body*> robots;
  for (const Pose& start : kStarts) {
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = {static_cast<float>(start.x), static_cast<float>(start.y)};
    definition.angle = static_cast<float>(start.theta);
    robots.push_back(world.CreateBody(&definition));
    b2PolygonShape square;
    square.SetAsBox(0.143F, 0.143F);
    robots.back()->CreateFixture(&square, 24.45F);
  }
  for (int cycle = 0; cycle < 1200; ++cycle) {
    for (b2Body* robot : robots) {
      robot->SetLinearVelocity(0.3F * robot->GetWorldVector({1, 0}));
      robot->SetAngularVelocity(1.5F);
    }
    world.Step(0.1F, 8, 3);
  }
  benchmark::DoNotOptimize(robots[0]->GetPosition());
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// CPU time of one bare loop, seconds.
double time_bare_loop() {
  constexpr int kLoops = 10;
  const double begin = cpu_seconds();
  for (int i = 0; i < kLoops; ++i)
    run_bare_loop();
  return (cpu_seconds() - begin) / kLoops;
}

/// One evaluation of each subject with a seed.
using Round = std::function<void(int seed)>;

/// Runs rounds of `evaluations` each on the seeds 1 to 100, alternating with the bare loop, so that
/// noise of the machine affects both.
void run_rounds(benchmark::State& state, double evaluations, const Round& round) {
  int seed = 0;
  double spent_s = 0;
  double bare_s = 0;
  double rounds = 0;
  for (auto _ : state) {
    seed = seed % 100 + 1;
    const double begin = cpu_seconds();
    round(seed);
    spent_s += cpu_seconds() - begin;
    state.PauseTiming();
    bare_s += time_bare_loop();
    state.ResumeTiming();
    ++rounds;
  }
  const double each_s = spent_s / rounds / evaluations;
  state.counters["ms_each"] = each_s * 1000;
  state.counters["bare_loops"] = each_s / (bare_s / rounds);
}

void run_all(benchmark::State& state, const std::vector<Subject>& subjects) {
  run_rounds(state, static_cast<double>(subjects.size()), [&](int seed) {
    for (const Subject& subject : subjects)
      benchmark::DoNotOptimize(subject.runs->run(subject.controller, seed).score);
  });
}

/// The thirty machines of the thesis on their missions; `only` selects the ten of one mission.
void thesis_designs_on(benchmark::State& state, const char* flavour, const char* profile,
                       ContactModel contacts, const char* only) {
  std::map<std::string, ReferenceRuns> missions = missions_in(flavour, profile);
  for (auto& [name, runs] : missions)
    runs.profile.contacts = contacts;
  std::vector<Subject> subjects;
  for (const ReferenceMachine& design : thesis_designs()) {
    const std::string mission = design.mission == "grid_exploration"  ? "grid"
                                : design.mission == "color_selection" ? "color"
                                                                      : design.mission;
    if (*only != 0 && mission != only) continue;
    const ReferenceRuns& runs = missions.at(mission);
    subjects.push_back({machine_of(design.text, *runs.flavour), &runs});
  }
  run_all(state, subjects);
}

/// The twenty reference machines on all three missions.
void reference_machines_on(benchmark::State& state, const char* flavour, const char* profile) {
  const std::map<std::string, ReferenceRuns> missions = missions_in(flavour, profile);
  std::vector<Subject> subjects;
  for (const ReferenceMachine& machine : reference_machines()) {
    for (const auto& [name, runs] : missions) {
      subjects.push_back({machine_of(machine.text, *runs.flavour), &runs});
    }
  }
  run_all(state, subjects);
}

/// Ten networks on each mission, with weights drawn from the whole search space.
void networks_on(benchmark::State& state, const char* flavour, const char* profile) {
  const std::map<std::string, ReferenceRuns> missions = missions_in(flavour, profile);
  std::vector<Subject> subjects;
  Rng rng = Rng(1).split("networks");
  for (const auto& [name, runs] : missions) {
    for (int i = 0; i < 10; ++i) {
      Network network{.inputs = NetworkInputs::Rvr, .weights = {}};
      for (std::size_t weight = 0; weight < kWheels * input_count(network.inputs); ++weight)
        network.weights.push_back(rng.uniform(-kMostWeight, kMostWeight));
      subjects.push_back({network, &runs});
    }
  }
  run_all(state, subjects);
}

constexpr const char* kAll = "";
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_argos3, "watermelon-argos3", "argos3",
                  ContactModel::Exact, kAll);
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_argos3_aggregation, "watermelon-argos3", "argos3",
                  ContactModel::Exact, "aggregation");
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_argos3_grid, "watermelon-argos3", "argos3",
                  ContactModel::Exact, "grid");
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_argos3_color, "watermelon-argos3", "argos3",
                  ContactModel::Exact, "color");
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_argos3_box2d, "watermelon-argos3", "argos3",
                  ContactModel::Box2d, kAll);
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_rvr, "watermelon", "rvr", ContactModel::Exact,
                  kAll);
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_rvr_aggregation, "watermelon", "rvr",
                  ContactModel::Exact, "aggregation");
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_rvr_grid, "watermelon", "rvr", ContactModel::Exact,
                  "grid");
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_rvr_color, "watermelon", "rvr", ContactModel::Exact,
                  "color");
// The same flavour without noise: the difference to rvr is the cost of the noise.
BENCHMARK_CAPTURE(thesis_designs_on, watermelon_without_noise, "watermelon", "argos3",
                  ContactModel::Exact, kAll);
BENCHMARK_CAPTURE(networks_on, watermelon_rvr, "watermelon", "rvr");
BENCHMARK_CAPTURE(networks_on, watermelon_without_noise, "watermelon", "argos3");
BENCHMARK_CAPTURE(reference_machines_on, watermelon_argos3, "watermelon-argos3", "argos3");

/// The thesis' designs for grid exploration, in an arena with as much space for each robot as in
/// the thesis. With `lidar`, all 719 rays of each robot in each cycle.
void swarm(benchmark::State& state, bool lidar) {
  constexpr double kInradius_m = 1.226;
  const auto robots = static_cast<int>(state.range(0));
  Mission mission = built_in_mission("grid_exploration").value();
  const double scale = std::sqrt(robots / 3.0);
  mission.robots = robots;
  mission.arena = regular_dodecagon(area_of(mission.arena) * robots / 3);
  mission.placement = PlaceInDisc{.centre = {}, .radius_m = scale * (kInradius_m - 0.026)};
  mission.rule = Coverage{.tiles = 10, .side_m = 2.50001 * scale};
  const Profile profile = built_in_profile("argos3").value();
  std::vector<Machine> machines;
  for (const ReferenceMachine& design : thesis_designs()) {
    if (design.mission == "grid" || design.mission == "grid_exploration")
      machines.push_back(machine_of(design.text));
  }
  const Recorder recorder = lidar ? Recorder([](const Snapshot&) {}, Sensor::Lidar) : Recorder();
  run_rounds(state, static_cast<double>(machines.size()), [&](int seed) {
    const Instance instance = instance_of(mission, seed).value();
    for (const Machine& machine : machines) {
      benchmark::DoNotOptimize(simulate({.controller = machine,
                                         .flavour = watermelon_argos3(),
                                         .profile = profile,
                                         .mission = mission,
                                         .instance = instance,
                                         .seed = seed},
                                        recorder)
                                   .score);
    }
  });
  state.counters["ns_per_robot_cycle"] = state.counters["ms_each"].value * 1e6 / (1200.0 * robots);
}
BENCHMARK_CAPTURE(swarm, lidar_off, false)->Arg(3)->Arg(10)->Arg(30)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(swarm, lidar_on, true)->Arg(3)->Arg(10)->Arg(30)->Arg(100);

}  // namespace
}  // namespace swarmsmith
