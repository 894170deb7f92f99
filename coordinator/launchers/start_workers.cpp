#include "coordinator/launchers/start_workers.h"

#include <algorithm>
#include <utility>

#include "coordinator/launchers/host_file.h"
#include "coordinator/launchers/local_workers.h"
#include "coordinator/launchers/slurm_workers.h"
#include "coordinator/launchers/ssh_workers.h"
#include "coordinator/launchers/worker_bundle.h"

namespace swarmsmith {
namespace {

using Started = tl::expected<std::unique_ptr<Launcher>, std::vector<Error>>;

template <class Kind>
Started boxed(Expected<Kind> started) {
  if (!started) return tl::unexpected(std::vector<Error>{started.error()});
  return std::make_unique<Kind>(std::move(*started));
}

Started start_local(const WorkersSetup& setup) {
  std::vector<std::string> arguments = setup.arguments;
  if (!setup.address.key.empty()) {
    arguments.emplace_back("--key");
    arguments.push_back(setup.address.key.string());
  }
  // The total number of slots must not exceed the requested number.
  std::int64_t processes = setup.launch.processes;
  if (setup.launch.slots > 0) processes = std::min(processes, setup.launch.slots);
  const int each = static_cast<int>(setup.launch.slots / processes);
  const int rest = static_cast<int>(setup.launch.slots % processes);
  return boxed(LocalWorkers::start({.endpoint = setup.address.endpoint,
                                    .processes = static_cast<int>(processes),
                                    .slots = setup.local_slots > 0 ? setup.local_slots : each,
                                    .more = setup.local_slots > 0 ? 0 : rest,
                                    .arguments = std::move(arguments),
                                    .secret = setup.local_secret}));
}

/// The bundles to send; none if `ship` is off.
Expected<std::vector<WorkerBundle>> bundles_of(const WorkersSetup& setup) {
  return setup.launch.ship ? find_bundles() : std::vector<WorkerBundle>();
}

Started start_ssh(const WorkersSetup& setup) {
  auto hosts = read_hosts(setup.launch.ssh.hosts);
  if (!hosts) return tl::unexpected(std::move(hosts.error()));
  auto bundles = bundles_of(setup);
  if (!bundles) return tl::unexpected(std::vector<Error>{bundles.error()});
  return boxed(SshWorkers::start({.hosts = std::move(*hosts),
                                  .options = setup.launch.ssh.options,
                                  .address = setup.address,
                                  .arguments = setup.arguments,
                                  .bundles = std::move(*bundles)}));
}

Started start_slurm(const WorkersSetup& setup) {
  auto bundles = bundles_of(setup);
  if (!bundles) return tl::unexpected(std::vector<Error>{bundles.error()});
  return boxed(SlurmWorkers::start(
      {.slurm = setup.launch.slurm,
       .job_name = slurm_job_name(setup.campaign_digest, setup.store),
       .folder = setup.shared_folder / (setup.store.filename().string() + ".slurm"),
       .address = setup.address,
       .arguments = setup.arguments,
       .bundles = std::move(*bundles)}));
}

}  // namespace

Started start_workers(const WorkersSetup& setup) {
  if (!setup.wants_workers()) return nullptr;
  switch (setup.launch.kind) {
    case LaunchOptions::Kind::Local:
      return start_local(setup);
    case LaunchOptions::Kind::Ssh:
      return start_ssh(setup);
    case LaunchOptions::Kind::Slurm:
      return start_slurm(setup);
  }
  return nullptr;
}

}  // namespace swarmsmith
