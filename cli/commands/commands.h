#pragma once

#include <span>
#include <string>
#include <vector>

#include "console/program.h"

namespace swarmsmith::cli {

/// All commands, in the order of the help. A new one: a file of its own with its `declare_`
/// function, which CMakeLists.txt lists, a line here, an entry in commands.cpp, a section in
/// docs/command-line.md.
std::span<const ProgramCommand> commands();

/// Runs `swarmsmith` with the words after its name (console/program.h).
ExitCode run_program(const std::vector<std::string>& arguments, Output& output);

/// docs/command-line.md tells what each does.
Run declare_run(Options& options);
Run declare_init(Options& options);
Run declare_check(Options& options);
Run declare_serve(Options& options);
Run declare_worker(Options& options);
Run declare_pause(Options& options);
Run declare_resume(Options& options);
Run declare_cancel(Options& options);
Run declare_extend(Options& options);
Run declare_forgive(Options& options);
Run declare_keygen(Options& options);
Run declare_evaluate(Options& options);
Run declare_replay(Options& options);
Run declare_profile(Options& options);
Run declare_status(Options& options);
Run declare_dashboard(Options& options);
Run declare_ls(Options& options);
Run declare_explain(Options& options);
Run declare_show(Options& options);
Run declare_query(Options& options);
Run declare_compare(Options& options);
Run declare_assess(Options& options);
Run declare_figure(Options& options);
Run declare_export(Options& options);
Run declare_import(Options& options);
Run declare_report(Options& options);
Run declare_supplement(Options& options);
Run declare_digest(Options& options);
Run declare_verify(Options& options);
Run declare_backup(Options& options);
Run declare_merge(Options& options);
Run declare_recover(Options& options);
Run declare_version(Options& options);

/// Becomes the program swarmsmith-track, whose commands docs/tracking.md tells.
ExitCode run_track(const std::vector<std::string>& words, Output& output);
/// Becomes the program swarmsmith-robot, whose commands docs/robot-runtime.md tells.
ExitCode run_robot(const std::vector<std::string>& words, Output& output);

}  // namespace swarmsmith::cli
