#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/launchers/launch_options.h"
#include "coordinator/launchers/launcher.h"

namespace swarmsmith {

/// What a campaign's workers need, however they are started.
struct WorkersSetup {
  LaunchOptions launch;
  WorkerAddress address;
  int local_slots = 0;                 ///< of each local process; 0: the cores, shared
  std::vector<std::string> arguments;  ///< more of them, for the worker program
  std::string local_secret;            ///< by which the coordinator knows those of this host
  std::string campaign_digest;
  std::filesystem::path store;
  /// Where files for workers elsewhere go: all of them must see it.
  std::filesystem::path shared_folder;

  bool wants_workers() const {
    return launch.kind != LaunchOptions::Kind::Local || launch.processes > 0;
  }
};

/// Starts them. Null when none are wanted. Errors: everything that is wrong.
tl::expected<std::unique_ptr<Launcher>, std::vector<Error>> start_workers(
    const WorkersSetup& setup);

}  // namespace swarmsmith
