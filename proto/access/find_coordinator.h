#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "proto/access/key_folder.h"
#include "proto/curve.h"

namespace swarmsmith {

/// What a user gives to find a coordinator, and to connect to it.
struct CoordinatorSearch {
  std::string endpoint;         ///< tcp://HOST:PORT; empty: `file` names it
  std::filesystem::path file;   ///< the coordinator's file
  std::filesystem::path key;    ///< the client's key file; empty: see `default_client_key`
  std::string role = "worker";  ///< selects the default key
  /// Whether to connect without encryption to a coordinator on another host.
  bool insecure_plaintext = false;
};

struct FoundCoordinator {
  std::string endpoint;
  std::optional<ClientKeys> keys;     ///< none: not encrypted
  std::vector<std::string> others{};  ///< other endpoints where it may be found
};

/// The file that SWARMSMITH_KEY names, else ROLE.key in the default folder of keys.
std::filesystem::path default_client_key(const std::string& role);

/// Reads all files again each time. A coordinator on loopback is contacted in plaintext, unless a
/// key is given or its file says that it has a key. Any other needs a key (or
/// `insecure_plaintext`). NotFound: its file does not exist (yet); BadInput: an error that must be
/// corrected first.
Expected<FoundCoordinator> find_coordinator(const CoordinatorSearch& search);

}  // namespace swarmsmith
