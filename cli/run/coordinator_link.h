#pragma once

#include <chrono>
#include <string>

#include "base/expected.h"
#include "proto/access/find_coordinator.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Flags with the address of a running coordinator.
struct CoordinatorArgument {
  std::string connect;      ///< HOST:PORT
  std::string coordinator;  ///< path of its file
  std::string key;
  bool insecure_plaintext = false;

  /// Whether the flags give the address.
  bool is_named() const { return !connect.empty() || !coordinator.empty(); }
  /// The same flags without the address: each store's own coordinator is asked.
  CoordinatorArgument of_store() const {
    return {.connect = {}, .coordinator = {}, .key = key, .insecure_plaintext = insecure_plaintext};
  }
  /// Arguments for `find_coordinator`, with an operator's key. `file` is used if the flags name no
  /// other place.
  CoordinatorSearch search(const std::string& file) const;
};

/// Sends the command to the coordinator and waits until it is carried out and on disk. `campaign`:
/// its digest, empty if there is only one. Errors: BadInput with the coordinator's sentence if it
/// refuses; NotFound or BadInput if it cannot be reached; Unavailable if it does not answer: the
/// command may then still be carried out.
Expected<std::string> command_by_wire(const CoordinatorSearch& search, const std::string& campaign,
                                      const CommandRow& command,
                                      std::chrono::seconds patience = std::chrono::seconds(10));

/// Asks a running coordinator for its status as JSON (docs/observability.md). Errors: Unavailable
/// (no answer in time), BadInput (it does not let this program read).
Expected<std::string> ask_status(const FoundCoordinator& coordinator,
                                 std::chrono::milliseconds patience);

/// user@host of this process, for the record.
std::string user_and_host();

}  // namespace swarmsmith::cli
