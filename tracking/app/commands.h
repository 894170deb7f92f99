#pragma once

#include <span>

#include "console/program.h"

namespace swarmsmith {

/// All commands of swarmsmith-track, in the order of the help. A new command needs its own file
/// with a `declare_` function, a line here, an entry in commands.cpp, and a section in
/// docs/tracking.md.
std::span<const ProgramCommand> track_commands();

CommandRun declare_track_score(Options& options);
CommandRun declare_track_rescore(Options& options);
CommandRun declare_track_override(Options& options);
CommandRun declare_track_init(Options& options);
CommandRun declare_track_check(Options& options);
CommandRun declare_calibrate_camera(Options& options);
CommandRun declare_calibrate_arena(Options& options);
CommandRun declare_calibrate_robot(Options& options);
CommandRun declare_detect(Options& options);
CommandRun declare_print_tags(Options& options);
CommandRun declare_print_board(Options& options);
CommandRun declare_print_survey(Options& options);
CommandRun declare_track_report(Options& options);
CommandRun declare_track_profile(Options& options);
CommandRun declare_record(Options& options);
CommandRun declare_overlay(Options& options);
CommandRun declare_live(Options& options);
CommandRun declare_track_version(Options& options);

/// The program and its libraries, as written into files and scores: "swarmsmith-track 0.1.0, OpenCV
/// 4.6.0, apriltag 3.3.0, ...".
std::string track_program_name();

/// Whether the first argument is not a command but an existing file or folder: `score` was omitted.
bool means_a_recording(const std::string& word);

/// The exit code for an error of tracking: 2 for wrong arguments, wrong settings files, and a
/// duplicate id in the arena file; 1 for all other errors.
ExitCode exit_code_of_tracking(const Error& error);

}  // namespace swarmsmith
