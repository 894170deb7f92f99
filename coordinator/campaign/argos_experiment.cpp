#include "coordinator/campaign/argos_experiment.h"

#include <array>
#include <variant>

#include <fmt/format.h>

#include "base/shown_text.h"
#include "coordinator/campaign/internal/argos_parts.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// The loop functions of a mission in the original software.
struct LoopFunctions {
  std::string_view mission;  ///< our name of the mission
  std::string_view library;
  std::string_view label;
};

constexpr std::array<LoopFunctions, 3> kLoopFunctions = {
    {{"aggregation", "librvr_pow_aggregation_loopfunc.so", "aggregation_one_spot_loop_functions"},
     {"grid_exploration", "librvr_pow_grid_exploration_loopfunc.so",
      "grid_exploration_loop_functions"},
     {"color_selection", "librvr_pow_color_aggregation_loopfunc.so",
      "color_aggregation_loop_functions"}}};

/// The controller reads a robot's number from the sixth character of its id.
constexpr int kMostRobots = 9;
/// The numbers at the end of robot ids: first those of the thesis' robots, then arbitrary ones.
constexpr std::array<int, kMostRobots> kRobotLabels = {30, 40, 50, 51, 55, 56, 57, 58, 59};

/// Centre of a wall in metres, and its rotation in degrees (rvr-automode facts, section 7).
struct ArgosWall {
  double x;
  double y;
  int turn_deg;
};

constexpr std::array<ArgosWall, 12> kWalls = {{{-1.231, 0, 0},
                                               {1.231, 0, 0},
                                               {0, 1.231, 90},
                                               {0, -1.231, 90},
                                               {-0.615, -1.066, 60},
                                               {-1.066, -0.615, 30},
                                               {0.615, 1.066, 60},
                                               {1.066, 0.615, 30},
                                               {-0.615, 1.066, -60},
                                               {-1.066, 0.615, -30},
                                               {0.615, -1.066, -60},
                                               {1.066, -0.615, -30}}};

/// Finds the thesis' mission that equals this one, except for name, duration and number of robots,
/// which the file can set. Patches, walls and score are compiled into the loop functions, or
/// checked here against our own.
Expected<LoopFunctions> loop_functions_of(const Mission& mission) {
  for (const LoopFunctions& known : kLoopFunctions) {
    auto original = built_in_mission(known.mission);
    if (!original) return Unexpected(original.error());
    original->name = mission.name;
    original->cycles = mission.cycles;
    original->robots = mission.robots;
    original->robot.name = mission.robot.name;
    if (*original == mission) return known;
  }
  return bad_input(
      "the mission " + mission.name +
      " is not one of the thesis' three (aggregation, grid_exploration, color_selection): its "
      "arena, floor, placement or score differ, and the original has no loop functions for it");
}

/// The settings with which the thesis' machines were run: range 0.4 m, 30 cm/s, no noise.
std::string controllers_text(const std::string& machine) {
  return fmt::format(
      "  <controllers>\n"
      "    <automode_controller id=\"automode\" library=\"libautomode.so\">\n"
      "      <actuators>\n"
      "        <rvr_wheels implementation=\"default\"/>\n"
      "        <rvr_rgb_leds implementation=\"default\" medium=\"leds\"/>\n"
      "      </actuators>\n"
      "      <sensors>\n"
      "        <rvr_proximity implementation=\"default\" range=\"0.4\" show_rays=\"false\"/>\n"
      "        <rvr_light implementation=\"default\" show_rays=\"false\"/>\n"
      "        <rvr_lidar implementation=\"default\" show_rays=\"false\"/>\n"
      "        <rvr_ground implementation=\"rot_z_only\"/>\n"
      "        <colored_blob_omnidirectional_camera implementation=\"rot_z_only\" medium=\"leds\""
      " show_rays=\"false\"/>\n"
      "      </sensors>\n"
      "      <params fsm-config=\"{}\" real-robot=\"false\" velocity=\"30\"/>\n"
      "    </automode_controller>\n"
      "  </controllers>\n",
      machine);
}

std::string robots_text(int robots) {
  std::string text;
  for (int i = 1; i <= robots; ++i) {
    // The loop functions move the robots; until then they are where the original puts them.
    text += fmt::format(
        "    <rvr id=\"rvr_{:02}_{:02}\">\n"
        "      <body position=\"{}\" orientation=\"0,0,0\"/>\n"
        "      <controller config=\"automode\"/>\n"
        "    </rvr>\n",
        i, kRobotLabels[static_cast<std::size_t>(i - 1)], i == 1 ? "0,-0.4,0" : "0.4,-0.6,0");
  }
  return text;
}

std::string arena_text(int robots) {
  std::string text =
      "  <arena size=\"10, 10, 2\" center=\"0,0,0\">\n"
      "    <floor id=\"floor\" source=\"loop_functions\" pixels_per_meter=\"300\"/>\n"
      "    <light id=\"light\" position=\"0,-4.25,0.75\" orientation=\"0,0,0\" color=\"yellow\""
      " intensity=\"0.0\" medium=\"leds\"/>\n";
  return text + argos_walls() + robots_text(robots) + "  </arena>\n";
}

Expected<std::string> experiment_of_rvrs(const ArgosExperiment& experiment) {
  const Mission& mission = experiment.mission;
  const auto* machine = std::get_if<Machine>(&experiment.controller);
  if (machine == nullptr) {
    return bad_input(fmt::format(
        "the control software is a {}, and .argos files of RVRs can hold only state machines",
        name_of(architecture_of(experiment.controller))));
  }
  const auto functions = loop_functions_of(mission);
  if (!functions) return Unexpected(functions.error());
  if (mission.robots > kMostRobots) {
    return bad_input(fmt::format("an experiment file has at most {} robots", kMostRobots));
  }
  if (auto runs = check_for_argos(experiment.controller, watermelon_argos3()); !runs)
    return Unexpected(runs.error());
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- {}\n"
      "     For ARGoS 3.0.0-beta48 with the RVR plugin, the RVR loop functions and the AutoMoDe "
      "of\n"
      "     August 2022. ARGOS_PLUGIN_PATH has to name the folders of their libraries. -->\n"
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
      "    <led id=\"leds\"/>\n"
      "  </media>\n"
      "</argos-configuration>\n",
      argos_comment(experiment.title), argos_framework(experiment), functions->library,
      functions->label, mission.robots,
      controllers_text(print_machine(*machine, watermelon_argos3())), arena_text(mission.robots));
}

}  // namespace

std::string argos_comment(std::string_view text) {
  std::string result;
  for (const char letter : as_shown(text, Layout::Escaped)) {
    if (letter == '-' && !result.empty() && result.back() == '-') result += ' ';
    result += letter;
  }
  return result;
}

std::string argos_framework(const ArgosExperiment& experiment) {
  return fmt::format(
      "  <framework>\n"
      "    <experiment length=\"{}\" ticks_per_second=\"10\" random_seed=\"{}\"/>\n"
      "  </framework>\n",
      experiment.mission.cycles / 10.0, experiment.seed);
}

std::string argos_walls() {
  std::string text;
  for (std::size_t i = 0; i < kWalls.size(); ++i) {
    text += fmt::format(
        "    <box id=\"wall_{}\" size=\"0.01,0.66,0.08\" movable=\"false\">\n"
        "      <body position=\"{},{},0\" orientation=\"{},0,0\"/>\n"
        "    </box>\n",
        i + 1, kWalls[i].x, kWalls[i].y, kWalls[i].turn_deg);
  }
  return text;
}

Expected<void> check_for_argos(const Controller& controller, const Flavour& flavour) {
  const auto wrong = check(controller, flavour);
  if (!wrong) return {};
  return unexpected(wrong->kind, "the original AutoMoDe cannot run this machine: " + wrong->message,
                    wrong->where);
}

Expected<std::string> argos_experiment(const ArgosExperiment& experiment) {
  Robot robot = experiment.mission.robot;
  robot.name = rvr().name;
  return robot == rvr() ? experiment_of_rvrs(experiment) : argos_experiment_of_epucks(experiment);
}

}  // namespace swarmsmith
