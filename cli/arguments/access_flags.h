#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console/options.h"
#include "coordinator/service/service.h"
#include "proto/access/allow_list_watch.h"
#include "proto/access/coordinator_file.h"

namespace swarmsmith::cli {

/// Who may connect to a coordinator that is being started, and how it is found.
struct AccessFlags {
  std::string keys;  ///< folder; empty: the default one, where keys are needed
  bool insecure_plaintext = false;
  std::string coordinator_file;  ///< empty: beside the store
  std::string advertise;         ///< host; empty: what it listens on, or this host's name

  /// Declares --keys, --insecure-plaintext, --coordinator-file and --advertise.
  void declare(Options& options);
};

/// What flags and files come to for a coordinator that listens on `bind`.
struct Access {
  std::optional<ServerKeys> keys;   ///< none: plaintext
  std::string public_key;           ///< the coordinator's
  std::filesystem::path local_key;  ///< key file for workers of its own
  bool insecure_plaintext = false;  ///< plaintext beyond loopback
  std::shared_ptr<AllowListWatch> watch;
};

/// Reads the keys when they are named or needed: always beyond loopback, except with --insecure.
/// All that is wrong, each with its file.
tl::expected<Access, std::vector<Error>> open_access(const AccessFlags& flags,
                                                     const std::string& bind);

/// What others need to find the coordinator.
CoordinatorFile coordinator_file(const AccessFlags& flags, const Access& access,
                                 const std::string& endpoint);

}  // namespace swarmsmith::cli
