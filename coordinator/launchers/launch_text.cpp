#include "coordinator/launchers/launch_text.h"

#include <charconv>
#include <optional>
#include <string>

namespace swarmsmith {
namespace {

constexpr std::int64_t kMostProcesses = 1000;
constexpr std::int64_t kMostJobs = 10'000;
constexpr std::int64_t kMostCpus = 1024;

/// Parses digits, optionally in groups (1_000), as a number from 1 to `most`.
std::optional<std::int64_t> number_in(std::string_view text, std::int64_t most) {
  std::string digits(text);
  std::erase(digits, '_');
  std::int64_t number = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc() || stop != end || number < 1 || number > most) return std::nullopt;
  return number;
}

Unexpected wrong(std::string_view text, const std::string& why) {
  return bad_input("Value " + std::string(text) + " " + why);
}

Expected<LaunchOptions> local(std::string_view text, std::string_view number,
                              LaunchOptions options) {
  const auto processes = number_in(number, kMostProcesses);
  if (!processes) {
    return wrong(text,
                 "is not one of: auto, N, local:N, ssh:HOSTFILE, slurm, slurm:JOBSxCPUS (N is a "
                 "number of local worker processes, 1 to 1000)");
  }
  options.kind = LaunchOptions::Kind::Local;
  options.processes = *processes;
  options.slots = *processes;
  return options;
}

}  // namespace

Expected<LaunchOptions> parse_workers(std::string_view text, const LaunchOptions& defaults) {
  LaunchOptions options = defaults;
  if (text == "auto" || text == "local") {
    options.kind = LaunchOptions::Kind::Local;
    options.processes = 1;
    options.slots = 0;
    return options;
  }
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  const bool has_more = colon != std::string_view::npos;
  const std::string_view more = has_more ? text.substr(colon + 1) : std::string_view();
  if (kind == "ssh") {
    if (more.empty() && (has_more || options.ssh.hosts.empty())) {
      return wrong(text, "names no host file; write ssh:HOSTFILE");
    }
    options.kind = LaunchOptions::Kind::Ssh;
    if (has_more) options.ssh.hosts = std::string(more);
    return options;
  }
  if (kind == "slurm") {
    options.kind = LaunchOptions::Kind::Slurm;
    if (!has_more) return options;
    const std::size_t cross = more.find('x');
    const auto jobs = number_in(more.substr(0, cross), kMostJobs);
    const auto cpus = cross == std::string_view::npos
                          ? std::optional(options.slurm.cpus_per_task)
                          : number_in(more.substr(cross + 1), kMostCpus);
    if (!jobs || !cpus) {
      return wrong(text,
                   "is not slurm:JOBSxCPUS, such as slurm:16x64 (jobs 1 to 10000, CPUs of "
                   "each 1 to 1024)");
    }
    options.slurm.jobs = *jobs;
    options.slurm.cpus_per_task = *cpus;
    return options;
  }
  return local(text, kind == "local" && has_more ? more : text, std::move(options));
}

}  // namespace swarmsmith
