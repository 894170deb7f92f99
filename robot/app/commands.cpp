#include "robot/app/commands.h"

#include <array>

namespace swarmsmith {
namespace {

constexpr std::string_view kRunDetails = R"(Examples:
  swarmsmith robot run --robot 1 --machine best.fsm --color-scale 255 --logs runs/
  swarmsmith robot run --robot 1 --machine best.fsm --color-scale 255 \
      ground_color:=/rvr/ground_color wheels_speed:=/rvr/wheels_speed --wheels floats
  swarmsmith robot run --robot 2 --machine best.fsm --lock-step senses

The node of one robot. It waits until `swarmsmith robot start` begins a run, steps the machine
ten times a second, and writes a log of each run. When a sensor that the machine needs is
silent, the treads stand still. Ctrl-C or SIGTERM stops the treads and then the node.)";
constexpr std::string_view kWorldDetails = R"(Examples:
  swarmsmith robot world --mission aggregation --seeds 1-20 --lock-step \
      --compare --machine best.fsm
  swarmsmith robot world --mission aggregation --seeds 7 --real-time --csv truth.csv

A simulated world in place of the robots' drivers, with the nodes of `swarmsmith robot run`.
In lock-step (nodes: --lock-step senses, or topics) it prints the scores of `evaluate`, bit for
bit. In real time it is a laboratory: `swarmsmith robot start` begins the run, a command acts
when it comes, and the drivers stop the treads 300 ms after the last one. Exit code 1: bits or
answers are wrong; 5: a robot's node is not connected or does not answer.)";
constexpr std::string_view kStartDetails = R"(Examples:
  swarmsmith robot start --run run07 --robots 1-3 --seconds 120
  swarmsmith robot start --run run07 --robots 1-3 --mission aggregation --design d3 \
      --video run07.mkv --robot-logs logs/

Checks all nodes and measures their clocks. If something is missing, it says what, and starts
nothing. Otherwise all robots begin at the same instant. If one does not answer or fails, all
stop; Ctrl-C stops all. Use the computer that records the video: then the run log has the
start. Exit code 6: the run is INVALID; 1: nothing was started; 5: a robot does not answer.)";
constexpr std::string_view kStopDetails = R"(Examples:
  swarmsmith robot stop --robots 1-3
  swarmsmith robot stop --robots 1-3 --kill

Exit code 5: a robot did not confirm that it stopped.)";
constexpr std::string_view kCheckDetails = R"(Example:
  swarmsmith robot check --robots 1-3

Exit code 0: all are ready; 1: something is missing or differs; 5: a robot does not answer.)";
constexpr std::string_view kReplayDetails = R"(Examples:
  swarmsmith robot replay run07.rvr1.log.csv
  swarmsmith robot replay runs/*.log.csv

Steps the machine of the log through the readings of the log. Exit code 0: each command,
state and random number has the same bits as in the log; 1: it prints the first cycle that
differs; 2: the log cannot be read.)";

constexpr std::array kCommands = {
    ProgramCommand{"run", "Run a machine on a robot", kRunDetails, declare_robot_run, nullptr,
                   without_ros_words},
    ProgramCommand{"world", "Play the world for robots' nodes", kWorldDetails, declare_robot_world,
                   nullptr, without_ros_words},
    ProgramCommand{"start", "Start a run on all robots, and watch it", kStartDetails,
                   declare_robot_start, nullptr, without_ros_words},
    ProgramCommand{"stop", "Stop robots", kStopDetails, declare_robot_stop, nullptr,
                   without_ros_words},
    ProgramCommand{"check", "Say which robots are there, and whether a run can start",
                   kCheckDetails, declare_robot_check, nullptr, without_ros_words},
    ProgramCommand{"replay", "Step a machine through robots' logs, and compare", kReplayDetails,
                   declare_robot_replay},
    ProgramCommand{"version", "Print the version, and whether it includes ROS", "",
                   declare_robot_version},
};

}  // namespace

std::span<const ProgramCommand> robot_commands() {
  return kCommands;
}

std::vector<std::string> without_ros_words(std::vector<std::string> words) {
  std::vector<std::string> plain;
  for (std::string& word : words) {
    const std::size_t at = word.find(":=");
    if (at == std::string::npos || at == 0 || word[0] == '-') {
      plain.push_back(std::move(word));
      continue;
    }
    if (word[0] != '_') {
      if (!plain.empty() && plain.back() == "--topic") {
        plain.push_back(std::move(word));
      } else {
        plain.insert(plain.end(), {"--topic", std::move(word)});
      }
      continue;
    }
    if (word[1] == '_') continue;  // __name, __log and the like are for ROS itself
    std::string name = "--" + word.substr(1, at - 1);
    for (char& letter : name)
      letter = letter == '_' ? '-' : letter;
    plain.insert(plain.end(), {std::move(name), word.substr(at + 2)});
  }
  return plain;
}

}  // namespace swarmsmith
