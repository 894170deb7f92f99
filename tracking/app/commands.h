#pragma once

#include <span>

#include "console/program.h"

namespace swarmsmith {

/// All commands of swarmsmith-track, in the order of the help. A new one: a file of its own with
/// its `declare_` function, a line here, an entry in commands.cpp, a section in docs/tracking.md.
std::span<const ProgramCommand> track_commands();

Run declare_track_score(Options& options);
Run declare_track_rescore(Options& options);
Run declare_track_override(Options& options);
Run declare_track_init(Options& options);
Run declare_track_check(Options& options);
Run declare_calibrate_camera(Options& options);
Run declare_calibrate_arena(Options& options);
Run declare_calibrate_robot(Options& options);
Run declare_detect(Options& options);
Run declare_print_tags(Options& options);
Run declare_print_board(Options& options);
Run declare_print_survey(Options& options);
Run declare_track_report(Options& options);
Run declare_track_profile(Options& options);
Run declare_record(Options& options);
Run declare_overlay(Options& options);
Run declare_live(Options& options);
Run declare_track_version(Options& options);

/// "swarmsmith-track 0.1.0, OpenCV 4.6.0, apriltag 3.3.0, ...": what made a file or a score.
std::string track_program_name();

/// Whether the first word is not a command but an existing file or folder: `score` was omitted.
bool means_a_recording(const std::string& word);

/// What to exit with after an error of tracking: 2 for wrong words, files of settings and a
/// duplicate id in the map, 1 for all else.
ExitCode exit_code_of_tracking(const Error& error);

}  // namespace swarmsmith
