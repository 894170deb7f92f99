#pragma once

#include <span>
#include <string>
#include <vector>

#include "console/program.h"

namespace swarmsmith::cli {

/// All commands, in the order of the help. A new command needs: its own file with its `declare_`
/// function, listed in CMakeLists.txt; a line here; an entry in commands.cpp; a section in
/// docs/command-line.md.
std::span<const ProgramCommand> commands();

/// Runs `swarmsmith` with the arguments after its name (console/program.h).
ExitCode run_program(const std::vector<std::string>& arguments, Output& output);

/// docs/command-line.md describes each command.
CommandRun declare_run(Options& options);
CommandRun declare_init(Options& options);
CommandRun declare_check(Options& options);
CommandRun declare_serve(Options& options);
CommandRun declare_worker(Options& options);
CommandRun declare_pause(Options& options);
CommandRun declare_resume(Options& options);
CommandRun declare_cancel(Options& options);
CommandRun declare_extend(Options& options);
CommandRun declare_forgive(Options& options);
CommandRun declare_keygen(Options& options);
CommandRun declare_evaluate(Options& options);
CommandRun declare_replay(Options& options);
CommandRun declare_profile(Options& options);
CommandRun declare_flavour(Options& options);
CommandRun declare_status(Options& options);
CommandRun declare_dashboard(Options& options);
CommandRun declare_ls(Options& options);
CommandRun declare_explain(Options& options);
CommandRun declare_show(Options& options);
CommandRun declare_query(Options& options);
CommandRun declare_compare(Options& options);
CommandRun declare_assess(Options& options);
CommandRun declare_figure(Options& options);
CommandRun declare_export(Options& options);
CommandRun declare_import(Options& options);
CommandRun declare_report(Options& options);
CommandRun declare_supplement(Options& options);
CommandRun declare_digest(Options& options);
CommandRun declare_verify(Options& options);
CommandRun declare_backup(Options& options);
CommandRun declare_merge(Options& options);
CommandRun declare_recover(Options& options);
CommandRun declare_version(Options& options);

/// Replaces this process by swarmsmith-track; docs/tracking.md describes its commands.
ExitCode run_track(const std::vector<std::string>& words, Output& output);
/// Replaces this process by swarmsmith-robot; docs/robot-runtime.md describes its commands.
ExitCode run_robot(const std::vector<std::string>& words, Output& output);

}  // namespace swarmsmith::cli
