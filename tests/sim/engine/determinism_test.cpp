#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "sim/control/machine_text.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "tests/support/not_empty.h"

// One hash of the whole trajectory per mission, flavour and profile, the same in every build type,
// compiler and thread. Another value means other scores for every recorded campaign: when that is
// wanted, raise kEngineVersion; the failing test prints the new table.

namespace swarmsmith {
namespace {

constexpr std::array kMissions = {"aggregation", "grid_exploration", "color_selection"};
constexpr std::array kProfiles = {"argos3", "rvr", "pseudo-reality"};

/// Machines that use every module of their flavour.
const std::map<std::string, std::string>& machines() {
  static const std::map<std::string, std::string> kMachines = {
      {"watermelon",
       "--nstates 4 --s0 0 --rwm0 12 --n0 3 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 4.5 --n0x1 1 --c0x1 "
       "0 --p0x1 0.8 --n0x2 2 --c0x2 6 --p0x2 0.7 --l0x2 3 --s1 2 --att1 3.25 --n1 3 --n1x0 0 "
       "--c1x0 5 --p1x0 0.03 --n1x1 1 --c1x1 0 --p1x1 1 --n1x2 2 --c1x2 2 --p1x2 0.9 --s2 1 --n2 2 "
       "--n2x0 0 --c2x0 1 --p2x0 0.2 --n2x1 2 --c2x1 5 --p2x1 0.02 --s3 3 --rep3 2.5 --n3 2 --n3x0 "
       "0 --c3x0 4 --p3x0 2 --w3x0 7.5 --n3x1 1 --c3x1 5 --p3x1 0.05"},
      {"watermelon-argos3",
       "--nstates 4 --s0 0 --rwm0 12 --n0 3 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 4.5 --n0x1 1 --c0x1 "
       "0 --p0x1 0.8 --n0x2 2 --c0x2 6 --p0x2 0.7 --l0x2 3 --s1 2 --att1 4.75 --n1 3 --n1x0 0 "
       "--c1x0 5 --p1x0 0.03 --n1x1 1 --c1x1 0 --p1x1 1 --n1x2 2 --c1x2 2 --p1x2 0.9 --s2 1 --n2 2 "
       "--n2x0 0 --c2x0 1 --p2x0 0.2 --n2x1 2 --c2x1 5 --p2x1 0.02 --s3 3 --rep3 3.5 --n3 2 --n3x0 "
       "0 --c3x0 4 --p3x0 2 --w3x0 7.5 --n3x1 1 --c3x1 5 --p3x1 0.05"},
      {"chocolate",
       "--nstates 4 --s0 0 --rwm0 12 --n0 3 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 4.5 --n0x1 1 --c0x1 "
       "0 --p0x1 0.8 --n0x2 2 --c0x2 5 --p0x2 0.05 --s1 4 --att1 3.25 --n1 3 --n1x0 0 --c1x0 5 "
       "--p1x0 0.03 --n1x1 1 --c1x1 0 --p1x1 1 --n1x2 2 --c1x2 2 --p1x2 0.9 --s2 2 --n2 2 --n2x0 0 "
       "--c2x0 1 --p2x0 0.02 --n2x1 2 --c2x1 5 --p2x1 0.02 --s3 5 --rep3 2.5 --n3 2 --n3x0 0 "
       "--c3x0 4 --p3x0 2 --w3x0 7.5 --n3x1 1 --c3x1 5 --p3x1 0.05"}};
  return kMachines;
}

void add(const Pose& pose, Digest& digest) {
  digest.add(pose.x);
  digest.add(pose.y);
  digest.add(pose.theta);
}

/// An L with a pillar, a bar and a box that gets pushed: all of it through Box2D.
Mission mission_with_solids() {
  Mission mission = built_in_mission("aggregation").value();
  const std::vector<Point> corners = {{-1.6, -1.2}, {1.6, -1.2}, {1.6, 0.4},
                                      {0.2, 0.4},   {0.2, 1.2},  {-1.6, 1.2}};
  mission.arena.walls.clear();
  for (std::size_t i = 0; i < corners.size(); ++i)
    mission.arena.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  mission.arena.obstacles = {{.outline = CircleOutline{0.15}, .pose = {0.9, -0.5, 0}},
                             {.outline = BoxOutline{0.6, 0.1}, .pose = {-0.9, 0.6, 0.7}}};
  mission.arena.objects = {{.outline = BoxOutline{0.3, 0.3},
                            .start = {-0.5, -0.6, 0.3},
                            .mass_kg = 0.5,
                            .friction_N = 0.5,
                            .height_m = 0.03}};
  mission.placement = PlaceAnywhere{};
  return mission;
}

/// The hash of all poses of all 1200 cycles, final velocities and states, and the score.
std::string hash_of(Mission mission, const std::string& flavour_name,
                    const std::string& profile_name, const std::string& machine_text = {}) {
  mission.arena.lights.push_back({.x_m = 0.4, .y_m = -0.8, .z_m = 0.75, .intensity_cd = 900});
  const Flavour& flavour = **find_flavour(flavour_name);
  const std::string& text = machine_text.empty() ? machines().at(flavour_name) : machine_text;
  const Machine machine = parse_machine(text, flavour).value();
  const Profile profile = built_in_profile(profile_name).value();
  const Instance instance = instance_of(mission, 17).value();
  Digest digest;
  const Measured result = simulate({.controller = machine,
                                    .flavour = flavour,
                                    .profile = profile,
                                    .mission = mission,
                                    .instance = instance,
                                    .seed = 17},
                                   [&](const Snapshot& now) {
                                     for (const RobotRecord& robot : now.robots)
                                       add(robot.pose, digest);
                                     for (const Pose& object : now.objects)
                                       add(object, digest);
                                   });
  digest.add(result.state_digest);
  digest.add(result.score);
  return digest.hex();
}

/// One row a mission, flavour and profile.
std::string table_of_hashes() {
  std::string table;
  for (const char* mission : kMissions) {
    for (const auto& [flavour, machine] : machines()) {
      for (const char* profile : kProfiles) {
        table += std::string(mission) + " " + flavour + " " + profile + " " +
                 hash_of(built_in_mission(mission).value(), flavour, profile) + "\n";
      }
    }
  }
  return table;
}

constexpr const char* kTable =
    "aggregation chocolate argos3 1da78f92bf91db8f3d80f0d3dd791430\n"
    "aggregation chocolate rvr 6f55bedac1e74adda86c7db1ae7aca67\n"
    "aggregation chocolate pseudo-reality afd11c64ffa516a761353c5cafaabdc7\n"
    "aggregation watermelon argos3 bc0c0f41ff45a475923213e1e7dd7ffa\n"
    "aggregation watermelon rvr 3c7b5d976be0ca82a34e9bab1d87164b\n"
    "aggregation watermelon pseudo-reality c6dd10890587fc9f9934a186e83a118d\n"
    "aggregation watermelon-argos3 argos3 3d9867f85a9df69af10b5c09e4038228\n"
    "aggregation watermelon-argos3 rvr 6feee5f28ad89a0d1cdae326c4aa2414\n"
    "aggregation watermelon-argos3 pseudo-reality ed9be802d6576fc3d2dc6d7d13849cbc\n"
    "grid_exploration chocolate argos3 0e1e2da6aa500df4b5a4c5b579ed8103\n"
    "grid_exploration chocolate rvr 219ccbfd04ef03743904a64e1bf47b3d\n"
    "grid_exploration chocolate pseudo-reality e6989d061e01cdf491af102fe08e35e4\n"
    "grid_exploration watermelon argos3 6fd25942c264f526651be0e891c5fbd3\n"
    "grid_exploration watermelon rvr 75c9dc9b7e9fe035e8c88977ca01c963\n"
    "grid_exploration watermelon pseudo-reality c84ed1df644f49b50e55805f66034084\n"
    "grid_exploration watermelon-argos3 argos3 b7ee546ed457a6d7426dbd86b5675f5c\n"
    "grid_exploration watermelon-argos3 rvr e7f1afe6df1868b3d818c976867c3465\n"
    "grid_exploration watermelon-argos3 pseudo-reality 51d72bdba84e44b5f71bea07c780a9aa\n"
    "color_selection chocolate argos3 ab9ad97b1372f9e5ff427b3373ac710f\n"
    "color_selection chocolate rvr e4acab918f4cfa58e32e10b4285c3706\n"
    "color_selection chocolate pseudo-reality 7c35f109ffbccb2991668e24cdaec164\n"
    "color_selection watermelon argos3 68ef928659e6797241ec40a3a5da944d\n"
    "color_selection watermelon rvr 28c50bbf8fb8e1cfad4fba735164cce2\n"
    "color_selection watermelon pseudo-reality 2e4c06f4163c36d2e17b1e93c8fff833\n"
    "color_selection watermelon-argos3 argos3 277ed443fb7cb41bf9345c257192f189\n"
    "color_selection watermelon-argos3 rvr 028b34bbaa8bda5b17984242cbf93512\n"
    "color_selection watermelon-argos3 pseudo-reality 0d62c0db8c0b3c7ce716e730fea2df46\n";

TEST(Determinism, TheTrajectoriesHaveTheirFixedHashes) {
  EXPECT_EQ(table_of_hashes(), kTable);
}

TEST(Determinism, TheSelfTestOfWorkersHasItsFixedDigest) {
  // Also with Box2D and with neighbours from the lidar, which the table above leaves out.
  EXPECT_EQ(self_test_digest(Architecture::Machine), "c5ced327cd00f045361f073e48598c8e");
  EXPECT_EQ(self_test_digest(Architecture::Tree), "41d92aa26fbeaa3b5bd580c503a7070b");
  EXPECT_EQ(self_test_digest(Architecture::Network), "448145cc8e3993f07db205cf97c3ac2d");
  EXPECT_EQ(self_test_digest(), "9960631e0b2902b9dc10015e228d52b0");
}

TEST(Determinism, AWorldOfSolidsHasItsFixedHash) {
  EXPECT_EQ(hash_of(mission_with_solids(), "watermelon", "rvr"),
            "568338e4ec873ed8f67f363bbd9bdaa5");
}

TEST(Determinism, ObstaclesHaveTheirFixedHash) {
  Mission mission = built_in_mission("aggregation").value();
  // Below the camera.
  constexpr double kLow_m = 0.15;
  mission.arena.obstacles = {
      {BoxOutline{0.2, 0.3}, {0.4, 0.3, 0.3}, kLow_m},
      {CircleOutline{0.12}, {-0.4, 0.3, 0}, kLow_m},
      {PolygonOutline{{{0.15, 0}, {-0.1, 0.12}, {-0.1, -0.12}}}, {0, -0.4, 1}, kLow_m}};
  EXPECT_EQ(hash_of(mission, "watermelon", "rvr"), "04371ef059ef935d4359ef67e163e181");
  for (Obstacle& obstacle : mission.arena.obstacles)
    obstacle.height_m = 0.3;  // they hide robots from each other
  EXPECT_EQ(hash_of(mission, "watermelon", "rvr"), "d88faef5d81f192e91a8f9b9a9720175");
}

/// Contacts of discs begin, end and come again in another order.
TEST(Determinism, EpucksThatPressIntoEachOtherHaveTheirFixedHash) {
  const auto file =
      read_mission_file(SWARMSMITH_SOURCE_DIR "/examples/missions/epuck/mp-agg.toml").value();
  EXPECT_EQ(hash_of(file.mission, "chocolate-epuck", "epuck", "--nstates 1 --s0 4 --att0 5"),
            "69d32be182f76412f9e1f386d6cb74d4");
}

TEST(EngineVersion, IsAnotherWhereTheExactModelMeetsObstacles) {
  const Profile exact{};
  Profile box2d{};
  box2d.contacts = ContactModel::Box2d;
  const Obstacle post{CircleOutline{0.1}, {0, 0, 0}, 0.15};
  for (const char* name : kMissions)
    EXPECT_EQ(engine_version_of(built_in_mission(name).value(), exact), kEngineVersion) << name;
  const Mission open = built_in_mission("aggregation").value();
  Mission mission = open;
  mission.arena.obstacles = {post};
  EXPECT_EQ(engine_version_of(mission, exact), kObstaclesVersion);
  EXPECT_EQ(engine_version_of(mission, box2d), kEngineVersion);
  // Those that Box2D plays have its bits as before.
  Mission round = mission;
  round.robot.body.outline = CircleOutline{0.1};
  EXPECT_EQ(engine_version_of(round, exact), kEngineVersion);
  Mission bent = mission;
  bent.arena.walls = walls_around({{1, -1}, {1, 1}, {0, 0.5}, {-1, 1}, {-1, -1}});
  EXPECT_EQ(engine_version_of(bent, exact), kEngineVersion);
  // What is as high as the camera hides neighbours under both contact models.
  EXPECT_EQ(engine_version_of(mission_with_solids(), exact), kSightVersion);
  Mission votes = open;
  votes.robot.ground.reading = GroundSensor::Reading::Vote;
  EXPECT_EQ(engine_version_of(votes, exact), kEngineVersion);
  Profile with_driver{};
  with_driver.timing.driver_sub_steps = 20;
  EXPECT_EQ(engine_version_of(votes, with_driver), kVoteVersion);
  EXPECT_EQ(engine_version_of(open, with_driver), kEngineVersion);
  mission.arena.obstacles.front().height_m = 0.154;
  EXPECT_EQ(engine_version_of(mission, box2d), kSightVersion);
}

/// The disc solver, radio, votes of the ground sensors, noise of wheels, and numbers that are
/// ranges.
TEST(Determinism, TwentyEpucksHaveTheirFixedHash) {
  const auto file = read_mission_file(SWARMSMITH_SOURCE_DIR "/examples/missions/epuck/rt-aac.toml");
  ASSERT_TRUE(file);
  EXPECT_EQ(hash_of(file->mission, "chocolate-epuck", "epuck", machines().at("chocolate")),
            "280a672e05d6d43462422080f29a04d7");
  EXPECT_EQ(
      hash_of(file->mission, "chocolate-epuck", "epuck-pseudo-reality", machines().at("chocolate")),
      "960290df2df796834aa8c99c1afd5c66");
}

TEST(Determinism, TheLidarOfThirtyRobotsHasItsFixedHash) {
  Mission mission = built_in_mission("grid_exploration").value();
  mission.robots = 30;
  mission.cycles = 200;
  mission.arena = regular_dodecagon(49);
  mission.placement = PlaceInDisc{.centre = {}, .radius_m = 3.6};
  const Machine machine = parse_machine(machines().at("watermelon"), watermelon()).value();
  const Profile profile = built_in_profile("argos3").value();
  const Instance instance = instance_of(mission, 3).value();
  Digest digest;
  simulate({.controller = machine,
            .flavour = watermelon(),
            .profile = profile,
            .mission = mission,
            .instance = instance,
            .seed = 3},
           Recorder(
               [&](const Snapshot& now) {
                 for (const RobotRecord& robot : now.robots) {
                   if (robot.readings == nullptr) continue;
                   for (const double range : robot.readings->lidar_m)
                     digest.add(range);
                 }
               },
               Sensor::Lidar));
  EXPECT_EQ(digest.hex(), "76ea48c85afd6102dbe2d664b9020b81");
}

TEST(Determinism, ThreadsChangeNothing) {
  const std::string alone = table_of_hashes();
  for (const std::size_t threads : {2U, 5U}) {
    std::vector<std::string> tables(threads);
    std::vector<std::thread> running;
    for (std::string& table : tables)
      running.emplace_back([&table] { table = table_of_hashes(); });
    for (std::thread& thread : running)
      thread.join();
    for (const std::string& table : not_empty(tables))
      EXPECT_EQ(table, alone);
  }
}

}  // namespace
}  // namespace swarmsmith
