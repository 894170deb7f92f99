#pragma once

#include <chrono>
#include <string>

#include "base/expected.h"
#include "proto/access/find_coordinator.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Address of a running coordinator, from flags.
struct CoordinatorArgument {
  std::string connect;      ///< HOST:PORT
  std::string coordinator;  ///< its file
  std::string key;
  bool insecure_plaintext = false;

  /// Whether flags give the address.
  bool is_named() const { return !connect.empty() || !coordinator.empty(); }
  /// For `find_coordinator`, with an operator's key. `file` where no flag says more.
  CoordinatorSearch search(const std::string& file) const;
};

/// Sends the command to the coordinator and waits until it is carried out and on disk. `campaign`:
/// its digest, empty if there is only one. Errors: BadInput with the coordinator's sentence when it
/// refuses; NotFound or BadInput when there is no way to it; Unavailable when it does not answer:
/// the command may then still be carried out.
Expected<std::string> command_by_wire(const CoordinatorSearch& search, const std::string& campaign,
                                      const CommandRow& command,
                                      std::chrono::seconds patience = std::chrono::seconds(10));

/// The status of a running coordinator as JSON (docs/observability.md), asked over the wire.
/// Errors: Unavailable (no answer in time), BadInput (it does not let this program read).
Expected<std::string> ask_status(const FoundCoordinator& coordinator,
                                 std::chrono::milliseconds patience);

/// user@host of this process, for the record.
std::string user_and_host();

}  // namespace swarmsmith::cli
