#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "proto/access/key_folder.h"
#include "proto/curve.h"

namespace swarmsmith {

/// What a person says about where the coordinator is, and about how to talk to it.
struct CoordinatorSearch {
  std::string endpoint;         ///< tcp://HOST:PORT; empty: `file` has it
  std::filesystem::path file;   ///< the coordinator's file
  std::filesystem::path key;    ///< the client's key file; empty: see `default_client_key`
  std::string role = "worker";  ///< which key is the default one
  /// Not to insist on encryption when the coordinator is on another host.
  bool insecure_plaintext = false;
};

struct FoundCoordinator {
  std::string endpoint;
  std::optional<ClientKeys> keys;     ///< none: not encrypted
  std::vector<std::string> others{};  ///< endpoints where it may be found, too
};

/// The file that SWARMSMITH_KEY names, else ROLE.key in the default folder of keys.
std::filesystem::path default_client_key(const std::string& role);

/// Reads what there is to read, afresh each time. Without a key of one's own choosing a coordinator
/// on loopback is talked to in plaintext, unless its file says that it has a key; all others only
/// with a key. NotFound: its file is not there (yet); BadInput: what must be mended first.
Expected<FoundCoordinator> find_coordinator(const CoordinatorSearch& search);

}  // namespace swarmsmith
