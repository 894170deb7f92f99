#pragma once

#include <span>

#include "console/program.h"

namespace swarmsmith {

/// All commands of swarmsmith-robot, in the order of the help. A new command needs its own file
/// with its `declare_` function, a line here, an entry in commands.cpp and a section in
/// docs/robot-runtime.md.
std::span<const ProgramCommand> robot_commands();

CommandRun declare_robot_run(Options& options);
CommandRun declare_robot_world(Options& options);
CommandRun declare_robot_start(Options& options);
CommandRun declare_robot_stop(Options& options);
CommandRun declare_robot_check(Options& options);
CommandRun declare_robot_replay(Options& options);
CommandRun declare_robot_version(Options& options);

/// Replaces arguments in the syntax of ROS: `_seed:=7` by `--seed 7`, `ranges:=/teraranger/ranges`
/// by `--topic`.
std::vector<std::string> without_ros_words(std::vector<std::string> words);

/// "swarmsmith-robot 0.1.0".
std::string robot_program_name();

}  // namespace swarmsmith
