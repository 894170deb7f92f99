#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace swarmsmith {

/// Array jobs of Slurm; each job is one worker.
struct SlurmOptions {
  std::int64_t jobs = 4;
  std::int64_t cpus_per_task = 4;    ///< slots of each worker
  std::string time;                  ///< for sbatch: "8:00:00"; empty: the partition's limit
  std::string partition;             ///< empty: the default partition
  std::vector<std::string> options;  ///< more options for sbatch: "--account=swarm"

  friend bool operator==(const SlurmOptions&, const SlurmOptions&) = default;
};

/// One worker on each host of a host file.
struct SshOptions {
  std::filesystem::path hosts;
  std::vector<std::string> options;  ///< more options for ssh: "-F", "ssh.config"

  friend bool operator==(const SshOptions&, const SshOptions&) = default;
};

/// How workers are started for a campaign: `--workers` and `[workers]`.
struct LaunchOptions {
  enum class Kind { Local, Ssh, Slurm };
  Kind kind = Kind::Local;
  std::int64_t processes = 1;  ///< on this host; 0: none
  std::int64_t slots = 0;      ///< on this host, in all its processes together; 0: one per core
  SshOptions ssh;
  SlurmOptions slurm;
  bool ship = false;  ///< whether to copy the worker program to ssh hosts and Slurm jobs

  friend bool operator==(const LaunchOptions&, const LaunchOptions&) = default;
};

/// How workers reach the coordinator.
struct WorkerAddress {
  std::string endpoint;               ///< tcp://host:port
  std::filesystem::path coordinator;  ///< a coordinator file, used before `endpoint`; or empty
  std::filesystem::path key;          ///< the workers' secret key; or empty
};

}  // namespace swarmsmith
