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

/// Flags that say who may connect to a new coordinator, and how clients find it.
struct AccessFlags {
  std::string keys;  ///< folder of the keys; empty: the default folder, if keys are needed
  bool insecure_plaintext = false;
  std::string coordinator_file;  ///< empty: a file beside the store
  std::string
      advertise;  ///< host name for clients; empty: the listening address, or this host's name

  /// Declares --keys, --insecure-plaintext, --coordinator-file and --advertise.
  void declare(Options& options);
};

/// The result of the flags and files, for a coordinator that listens on `bind`.
struct Access {
  std::optional<ServerKeys> keys;   ///< none: plaintext
  std::string public_key;           ///< of the coordinator
  std::filesystem::path local_key;  ///< key file for the coordinator's own workers
  bool insecure_plaintext = false;  ///< allow plaintext beyond loopback
  std::shared_ptr<AllowListWatch> watch;
};

/// Reads the keys if they are given or needed. They are always needed beyond loopback, except with
/// --insecure-plaintext. Returns all errors, each with its file.
tl::expected<Access, std::vector<Error>> open_access(const AccessFlags& flags,
                                                     const std::string& bind);

/// The file that tells clients where the coordinator is.
CoordinatorFile coordinator_file(const AccessFlags& flags, const Access& access,
                                 const std::string& endpoint);

}  // namespace swarmsmith::cli
