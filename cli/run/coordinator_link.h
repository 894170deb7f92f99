#pragma once

#include <chrono>
#include <string>

#include "base/expected.h"
#include "proto/access/find_coordinator.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Where a running coordinator is, as a person's flags have it.
struct CoordinatorArgument {
  std::string connect;      ///< HOST:PORT
  std::string coordinator;  ///< its file
  std::string key;
  bool insecure_plaintext = false;

  /// Whether flags say where it is.
  bool is_named() const { return !connect.empty() || !coordinator.empty(); }
  /// For `find_coordinator`, with an operator's key. `file` where no flag says more.
  CoordinatorSearch search(const std::string& file) const;
};

/// Sends the command to the coordinator and waits until it is carried out and on disk. `campaign`:
/// digest of the one that is meant, empty when there is only one. Errors: BadInput with the
/// coordinator's sentence when it refuses; NotFound or BadInput when there is no way to it;
/// Unavailable when it does not answer: then the command may be carried out all the same.
Expected<std::string> command_by_wire(const CoordinatorSearch& search, const std::string& campaign,
                                      const CommandRow& command,
                                      std::chrono::seconds patience = std::chrono::seconds(10));

/// user@host of this process, for the record.
std::string user_and_host();

}  // namespace swarmsmith::cli
