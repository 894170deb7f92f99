#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace swarmsmith {

/// Array jobs of Slurm, each one worker.
struct SlurmOptions {
  std::int64_t jobs = 4;
  std::int64_t cpus_per_task = 4;    ///< slots of each worker
  std::string time;                  ///< as sbatch has it: "8:00:00"; empty: the partition's limit
  std::string partition;             ///< empty: the default one
  std::vector<std::string> options;  ///< more words for sbatch: "--account=swarm"

  friend bool operator==(const SlurmOptions&, const SlurmOptions&) = default;
};

/// One worker on each host of a file.
struct SshOptions {
  std::filesystem::path hosts;
  std::vector<std::string> options;  ///< more words for ssh: "-F", "ssh.config"

  friend bool operator==(const SshOptions&, const SshOptions&) = default;
};

/// Who starts workers for a campaign: `--workers` and `[workers]`.
struct LaunchOptions {
  enum class Kind { Local, Ssh, Slurm };
  Kind kind = Kind::Local;
  std::int64_t processes = 1;  ///< of this host; 0: none
  std::int64_t slots = 0;      ///< of this host, in all its processes; 0: a core each
  SshOptions ssh;
  SlurmOptions slurm;
  bool ship = false;  ///< whether ssh and Slurm's jobs get the worker from here

  friend bool operator==(const LaunchOptions&, const LaunchOptions&) = default;
};

/// What workers must know of the coordinator.
struct WorkerAddress {
  std::string endpoint;               ///< tcp://host:port
  std::filesystem::path coordinator;  ///< a coordinator file, which wins over `endpoint`; or empty
  std::filesystem::path key;          ///< the workers' secret key; or empty
};

}  // namespace swarmsmith
