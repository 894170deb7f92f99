#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"
#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

/// The settings for a campaign's workers, for every kind of launcher.
struct WorkersSetup {
  LaunchOptions launch;
  WorkerAddress address;
  int local_slots = 0;                 ///< for each local process; 0: the cores, shared among them
  std::vector<std::string> arguments;  ///< additional arguments for the worker program
  std::string local_secret;            ///< identifies the workers on this host
  std::string campaign_digest;
  std::filesystem::path store;
  /// A folder for the files of workers on other hosts; all these hosts must see it.
  std::filesystem::path shared_folder;

  bool wants_workers() const {
    return launch.kind != LaunchOptions::Kind::Local || launch.processes > 0;
  }
};

/// Starts the workers. Null if no workers are wanted. Errors: all problems that were found.
tl::expected<std::unique_ptr<Launcher>, std::vector<Error>> start_workers(
    const WorkersSetup& setup);

}  // namespace swarmsmith
