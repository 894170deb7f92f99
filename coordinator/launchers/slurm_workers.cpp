#include "coordinator/launchers/slurm_workers.h"

#include <unistd.h>
#include <algorithm>
#include <fstream>
#include <random>
#include <utility>

#include "base/hash.h"
#include "coordinator/launchers/slurm_script.h"
#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};

/// Removes the variables of a job in which this process itself may be running: sbatch passes them
/// on, and the workers would get the coordinator's SLURM_RESTART_COUNT.
std::vector<std::string> outside_of_jobs(std::vector<std::string> words) {
  std::vector<std::string> line{"env"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string name = std::string(*variable).substr(0, std::string(*variable).find('='));
    if (!name.starts_with("SLURM_") || name == "SLURM_CONF" || name == "SLURM_CLUSTERS") continue;
    line.emplace_back("-u");
    line.push_back(name);
  }
  std::ranges::move(words, std::back_inserter(line));
  return line;
}

/// A message of the program, on one line and without the program's name.
std::string sentence(std::string text) {
  while (text.ends_with('\n'))
    text.pop_back();
  for (std::size_t at = 0; (at = text.find('\n')) != std::string::npos;)
    text.replace(at, 1, "; ");
  for (const char* name : {"sbatch: ", "squeue: ", "scancel: ", "slurm_load_jobs ", "error: "}) {
    const std::string prefix = name;
    for (std::size_t at = 0; (at = text.find(prefix)) != std::string::npos;)
      text.erase(at, prefix.size());
  }
  return text;
}

std::string user() {
  return "--user=" + std::to_string(getuid());
}

Expected<void> write_script(const fs::path& file, const std::string& text) {
  std::error_code failed;
  // The workers' output is written to this folder.
  if (fs::create_directories(file.parent_path(), failed))
    fs::permissions(file.parent_path(), fs::perms::owner_all, failed);
  // Another process may be submitting the script right now, so it is replaced atomically.
  const fs::path next = file.string() + ".new";
  std::ofstream stream(next, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (stream) fs::permissions(next, fs::perms(0755), failed);
  if (stream && !failed) fs::rename(next, file, failed);
  if (stream && !failed) return {};
  return unexpected(ErrorKind::Unavailable, "the batch script cannot be written", file.string());
}

}  // namespace

std::string slurm_job_name(const std::string& campaign_digest, const fs::path& store) {
  Digest digest;
  digest.add(campaign_digest);
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(store), failed);
  digest.add(failed ? store.string() : whole.string());
  return "swarmsmith-" + digest.hex().substr(0, 12);
}

SlurmWorkers::SlurmWorkers(SlurmWorkersOptions options)
    : options_(std::move(options)),
      jobs_(options_.slurm.jobs, options_.times, Rng(std::random_device()())) {}

Expected<SlurmWorkers> SlurmWorkers::start(SlurmWorkersOptions options) {
  for (const char* program : {"sbatch", "squeue", "scancel"}) {
    if (find_program(program)) continue;
    return unexpected(ErrorKind::NotFound,
                      "this host has no such program; start the run where jobs are submitted, "
                      "with Slurm's programs in PATH",
                      program);
  }
  std::vector<std::string> command = address_arguments(options.address);
  std::ranges::copy(options.arguments, std::back_inserter(command));
  fs::path cache;
  for (const WorkerBundle& bundle : options.bundles) {
    Expected<fs::path> installed = install_here(bundle);
    if (!installed) return Unexpected(installed.error());
    cache = std::move(*installed);
  }
  if (!options.bundles.empty()) {
    command = start_words(options.bundles, cache, command);
  } else {
    if (options.program.empty()) {
      Expected<fs::path> found = find_worker_program();
      if (!found) return Unexpected(found.error());
      options.program = std::move(*found);
    }
    command.insert(command.begin(), options.program.string());
  }
  std::error_code failed;
  options.folder = fs::absolute(options.folder, failed);
  const auto written =
      write_script(options.folder / "worker.sh", text_of({.job_name = options.job_name,
                                                          .folder = options.folder,
                                                          .command = std::move(command),
                                                          .options = options.slurm}));
  if (!written) return Unexpected(written.error());
  return SlurmWorkers(std::move(options));
}

SlurmWorkers::~SlurmWorkers() {
  // Stops the program if one is running, and with it the thread that waits for it.
  if (interrupt_) interrupt_->trigger();
}

void SlurmWorkers::ask(std::vector<std::string> words) {
  ProcessCall call{.words = outside_of_jobs(std::move(words)), .limit = kPatience};
  answer_ = std::async(std::launch::async, [call, interrupt = interrupt_.get()] {
    const auto end = run_process(call, *interrupt);
    if (!end) return Answer{false, to_string(end.error())};
    if (end->why == ProcessEnd::Why::Limit) return Answer{false, "it did not answer in time"};
    const bool ok = end->signal == 0 && end->exit_code == 0;
    if (ok) return Answer{true, end->output.text};
    const std::string said = sentence(end->errors.text);
    return Answer{false, said.empty() ? "exit code " + std::to_string(end->exit_code) : said};
  });
}

void SlurmWorkers::take_answer(TimePoint now) {
  const Answer answer = answer_.get();
  if (submitting_ > 0) {
    const std::int64_t jobs = std::exchange(submitting_, 0);
    if (answer.ok) {
      jobs_.on_submitted(jobs, now);
    } else {
      jobs_.on_refused(answer.text, now);
    }
  } else if (answer.ok) {
    jobs_.on_queue(parse_queue(answer.text), now);
  } else {
    jobs_.on_no_queue(answer.text, now);
  }
}

std::string SlurmWorkers::tend(TimePoint now) {
  if (stopped_) return {};
  if (answer_.valid()) {
    if (answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    take_answer(now);
  }
  const SlurmJobs::Action action = jobs_.next(now);
  if (const auto* submit = std::get_if<SlurmJobs::Submit>(&action)) {
    submitting_ = submit->jobs;
    ask({"sbatch", "--parsable", "--array=0-" + std::to_string(submit->jobs - 1),
         (options_.folder / "worker.sh").string()});
  } else if (std::holds_alternative<SlurmJobs::LookAtQueue>(action)) {
    ask({"squeue", "--noheader", "--array", "--states=all", user(), "--name=" + options_.job_name,
         "--format=%i|%T|%r"});
  }
  return jobs_.trouble().empty() ? "" : "slurm: " + jobs_.trouble();
}

std::string SlurmWorkers::stop(Duration /*grace*/) {
  if (std::exchange(stopped_, true)) return {};
  // The cancellation would miss a submission that is still under way.
  if (answer_.valid()) answer_.get();
  ask({"scancel", user(), "--name=" + options_.job_name});
  const Answer answer = answer_.get();
  if (answer.ok) return {};
  return "jobs of this campaign may be left in Slurm's queue (" + answer.text +
         "); end them with: scancel --name=" + options_.job_name;
}

LauncherStatus SlurmWorkers::status() const {
  return jobs_.status();
}

}  // namespace swarmsmith
