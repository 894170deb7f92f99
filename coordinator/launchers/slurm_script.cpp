#include "coordinator/launchers/slurm_script.h"

#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

/// A line of options. sbatch accepts quotes like a shell.
std::string directive(const std::vector<std::string>& words) {
  return "#SBATCH " + shell_line(words) + "\n";
}

/// Escapes %: Slurm replaces patterns such as %A in file names.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char letter : path) {
    text += letter;
    if (letter == '%') text += letter;
  }
  return text;
}

}  // namespace

std::string text_of(const SlurmScript& script) {
  const SlurmOptions& options = script.options;
  const std::string file = (script.folder / "worker.sh").string();
  std::string text = "#!/bin/sh\n";
  text +=
      "# Workers for a campaign, one per job; `swarmsmith run` writes this file at each start.\n";
  text += "# More workers, at any time:   sbatch --array=0-15 " + shell_line({file}) + "\n";
  text += "# Fewer, at any time:          scancel JOB   (nothing is lost)\n";
  text += directive({"--job-name=" + script.job_name});
  text += directive({"--array=0-" + std::to_string(options.jobs - 1)});
  text += directive({"--cpus-per-task=" + std::to_string(options.cpus_per_task)});
  // Slurm restarts the job itself after its node has died (docs/cluster.md, "Slurm").
  text += directive({"--requeue"});
  // A minute before the time limit, to the batch shell, which `exec` replaces with the worker: it
  // drains.
  text += directive({"--signal=B:TERM@60"});
  // The log of a job that is requeued keeps what it has.
  text += directive({"--open-mode=append"});
  text += directive({"--output=" + without_patterns(script.folder.string()) + "/%A_%a.log"});
  if (!options.time.empty()) text += directive({"--time=" + options.time});
  if (!options.partition.empty()) text += directive({"--partition=" + options.partition});
  if (!options.options.empty()) text += directive(options.options);
  return text + "exec " + shell_line(script.command) + "\n";
}

}  // namespace swarmsmith
