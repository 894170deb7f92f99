#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "coordinator/campaign/internal/argos_parts.h"
#include "embedded/kNaXor2Mission.h"
#include "embedded/kOcScaMission.h"
#include "embedded/kRtAacMission.h"
#include "embedded/kRtForMission.h"
#include "embedded/kRtGridMission.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

/// The loop functions of a mission in the original software, and our equal mission.
struct LoopFunctions {
  std::string_view mission;  ///< the text of our mission file
  std::string_view library;
  std::string_view label;
  std::string_view repository;
};

constexpr std::string_view kLoopFunctionsOfAll = "experiments-loop-functions";
constexpr std::string_view kOfTransferability = "Results-Transferability, Experiment 1";
constexpr std::array<LoopFunctions, 5> kLoopFunctions = {
    {{kRtAacMission, "libchocolate_aac_loopfunc.so", "chocolate_aac_loop_functions",
      kLoopFunctionsOfAll},
     {kOcScaMission, "libchocolate_sca_loopfunc.so", "chocolate_sca_loop_functions",
      kLoopFunctionsOfAll},
     {kRtForMission, "libforaging_loopfunc.so", "foraging_loop_functions", kOfTransferability},
     {kRtGridMission, "libgrid_exploration.so", "grid_exploration", kOfTransferability},
     {kNaXor2Mission, "libaggregation_xor2.so", "aggregation_xor2", kLoopFunctionsOfAll}}};

/// The keys, as `table.key`, of the lines in `sections` that `others` lacks.
std::vector<std::string> keys_beside(const std::vector<Section>& sections,
                                     const std::vector<Section>& others) {
  std::set<std::pair<std::string, std::string>> known;
  for (const Section& section : others)
    for (const SectionLine& line : section.lines)
      known.emplace(section.header + line.key, line.value);
  std::vector<std::string> keys;
  for (const Section& section : sections) {
    const std::string header = section.header.substr(1, section.header.size() - 2);
    const std::size_t dot = header.find('.');
    const std::string table = dot == std::string::npos ? "" : header.substr(dot + 1) + ".";
    for (const SectionLine& line : section.lines)
      if (!known.contains({section.header + line.key, line.value}))
        keys.push_back(table + line.key);
  }
  return keys;
}

/// The original simulates RVRs and e-pucks, the latter with any radio range. Gives an error with
/// the first difference from the more similar one.
Expected<void> check_robot(const Mission& mission) {
  std::vector<std::string> fewest;
  std::string nearest;
  for (const std::string& name : robot_names()) {
    Robot known = find_robot(name, {}).value();
    known.name = mission.robot.name;
    if (name != rvr().name) known.neighbours.range_m = mission.robot.neighbours.range_m;
    if (known == mission.robot) return {};
    std::vector<std::string> keys =
        keys_beside(robot_sections(mission.robot, "robot"), robot_sections(known, "robot"));
    if (!nearest.empty() && keys.size() >= fewest.size()) continue;
    fewest = std::move(keys);
    nearest = name;
  }
  return bad_input(".argos files are for the robots rvr and epuck; the robot `" +
                   mission.robot.name + "` of the mission " + mission.name +
                   " differs from the built-in " + nearest +
                   (fewest.empty() ? "" : " in `" + fewest.front() + "`"));
}

/// Finds the original mission that equals this one, except for name, duration, number of robots,
/// light and radio range, which the file can set.
Expected<LoopFunctions> loop_functions_of(const Mission& mission) {
  for (const LoopFunctions& known : kLoopFunctions) {
    auto original = parse_mission(known.mission, "mission.toml");
    if (!original) return Unexpected(original.error().front());
    original->mission.name = mission.name;
    original->mission.cycles = mission.cycles;
    original->mission.robots = mission.robots;
    original->mission.arena.lights = mission.arena.lights;
    original->mission.robot.name = mission.robot.name;
    original->mission.robot.neighbours.range_m = mission.robot.neighbours.range_m;
    if (original->mission == mission) return known;
  }
  return bad_input("the original software has no loop functions for the mission " + mission.name +
                   ": its arena, floor, placement or score differ from those of "
                   "examples/missions/epuck (rt-aac, rt-for, rt-grid, oc-aac, "
                   "oc-sca, na-xor2)");
}

/// The original's names for the control software of an architecture.
struct Program {
  std::string_view controller;
  std::string_view library;
  std::string_view option;
  const Flavour* flavour;  ///< whose module numbers it uses
};

Expected<Program> program_of(const Controller& controller) {
  if (std::holds_alternative<Machine>(controller)) {
    return Program{"automode_controller", "libautomode.so", "fsm-config",
                   find_flavour("chocolate-epuck").value()};
  }
  if (std::holds_alternative<Tree>(controller)) {
    return Program{"automode_controller_bt", "libautomode_bt.so", "bt-config",
                   find_flavour("maple-epuck").value()};
  }
  return bad_input(
      "the control software is a network, and .argos files of e-pucks can hold only state machines "
      "and trees");
}

/// The devices of the published files, with the profile's noise. The attribute for the noise of the
/// radio's range is misspelled there and has no effect (epuck facts, section 3.4).
std::string controllers_text(const ArgosExperiment& experiment, const Program& program,
                             const std::string& text) {
  const Profile& profile = experiment.profile;
  return fmt::format(
      "  <controllers>\n"
      "    <{0} id=\"automode\" library=\"{1}\">\n"
      "      <actuators>\n"
      "        <epuck_wheels implementation=\"default\" noise_std_dev=\"{2}\"/>\n"
      "        <epuck_rgb_leds implementation=\"default\" medium=\"leds\"/>\n"
      "        <epuck_range_and_bearing implementation=\"medium\" medium=\"rab\" data_size=\"4\""
      " range=\"{3}\"/>\n"
      "      </actuators>\n"
      "      <sensors>\n"
      "        <epuck_proximity implementation=\"default\" show_rays=\"false\" noise_level=\"{4}\""
      " calibrated=\"false\"/>\n"
      "        <epuck_range_and_bearing implementation=\"medium\" medium=\"rab\" data_size=\"4\""
      " loss_probability=\"{5}\" calibrated=\"false\"/>\n"
      "        <epuck_light implementation=\"default\" show_rays=\"false\" noise_level=\"{6}\""
      " calibrated=\"false\"/>\n"
      "        <epuck_ground implementation=\"rot_z_only\" noise_level=\"{7}\""
      " calibrated=\"false\"/>\n"
      "        <epuck_omnidirectional_camera implementation=\"rot_z_only\" medium=\"leds\""
      " show_rays=\"false\"/>\n"
      "      </sensors>\n"
      "      <params {8}=\"{9}\"/>\n"
      "    </{0}>\n"
      "  </controllers>\n",
      program.controller, program.library, profile.treads.sd,
      experiment.mission.robot.neighbours.range_m, profile.proximity.half_width,
      profile.neighbours.miss_rate, profile.light.half_width, profile.ground_color.half_width,
      program.option, text);
}

/// The loop functions move the robots. They are called epuck0, epuck1, ... because the original
/// reads a robot's id from its name; with other names, all robots would have the same id (epuck
/// facts, section 4.1).
std::string arena_text(const Mission& mission) {
  // If the mission has no light, a dark one is added, because the original's sensors need one.
  const Light dark{.x_m = 0, .y_m = -1.25, .z_m = 0.75, .intensity_cd = 0};
  const Light& light = mission.arena.lights.empty() ? dark : mission.arena.lights.front();
  return fmt::format(
             "  <arena size=\"3, 3, 2\" center=\"0,0,0\">\n"
             "    <floor id=\"floor\" source=\"loop_functions\" pixels_per_meter=\"300\"/>\n"
             "    <light id=\"light\" position=\"{},{},{}\" orientation=\"0,0,0\" color=\"yellow\""
             " intensity=\"{}\" medium=\"leds\"/>\n",
             light.x_m, light.y_m, light.z_m, light.intensity_cd) +
         argos_walls() +
         fmt::format(
             "    <distribute>\n"
             "      <position method=\"uniform\" min=\"-1.2,-1.2,0\" max=\"1.2,1.2,0\"/>\n"
             "      <orientation method=\"gaussian\" mean=\"0,0,0\" std_dev=\"360,0,0\"/>\n"
             "      <entity quantity=\"{}\" max_trials=\"100\">\n"
             "        <e-puck id=\"epuck\">\n"
             "          <controller config=\"automode\"/>\n"
             "        </e-puck>\n"
             "      </entity>\n"
             "    </distribute>\n"
             "  </arena>\n",
             mission.robots);
}

}  // namespace

std::vector<std::string> left_out_of_argos(const Profile& profile) {
  Profile said = built_in_profile("epuck-ideal").value();
  said.name = profile.name;
  said.treads.sd = profile.treads.sd;
  said.proximity.half_width = profile.proximity.half_width;
  said.light.half_width = profile.light.half_width;
  said.ground_color.half_width = profile.ground_color.half_width;
  said.neighbours.miss_rate = profile.neighbours.miss_rate;
  return keys_beside(profile_sections(profile, "profile"), profile_sections(said, "profile"));
}

Expected<std::string> argos_experiment_of_epucks(const ArgosExperiment& experiment) {
  const Mission& mission = experiment.mission;
  if (auto known = check_robot(mission); !known) return Unexpected(known.error());
  const auto functions = loop_functions_of(mission);
  if (!functions) return Unexpected(functions.error());
  if (mission.arena.lights.size() > 1)
    return bad_input("an experiment file has one light, and the mission " + mission.name +
                     " has more");
  if (!experiment.profile.ranges.empty()) {
    return bad_input("an experiment file has numbers, and the profile " + experiment.profile.name +
                     " has ranges, which are drawn for each run (docs/profiles.md)");
  }
  const auto program = program_of(experiment.controller);
  if (!program) return Unexpected(program.error());
  if (auto runs = check_for_argos(experiment.controller, *program->flavour); !runs)
    return Unexpected(runs.error());
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- {}\n"
      "     For ARGoS 3.0.0-beta48 with argos3-epuck, demiurge-epuck-dao, AutoMoDe, and the loop\n"
      "     functions of {}. ARGOS_PLUGIN_PATH has to name the\n"
      "     folders of their libraries. -->\n"
      "<argos-configuration>\n"
      "{}"
      "  <loop_functions library=\"{}\" label=\"{}\">\n"
      "    <params dist_radius=\"1.2\" number_robots=\"{}\"/>\n"
      "  </loop_functions>\n"
      "{}{}"
      "  <physics_engines>\n"
      "    <dynamics2d id=\"dyn2d\"/>\n"
      "  </physics_engines>\n"
      "  <media>\n"
      "    <led id=\"leds\" grid_size=\"1,1,1\"/>\n"
      "    <range_and_bearing id=\"ircom\"/>\n"
      "    <range_and_bearing id=\"rab\"/>\n"
      "  </media>\n"
      "</argos-configuration>\n",
      argos_comment(experiment.title), functions->repository, argos_framework(experiment),
      functions->library, functions->label, mission.robots,
      controllers_text(experiment, *program,
                       print_controller(experiment.controller, *program->flavour)),
      arena_text(mission));
}

}  // namespace swarmsmith
