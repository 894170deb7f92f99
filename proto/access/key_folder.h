#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith {

/// The folder with the keys of a coordinator and of its clients:
///
///     server.key                             the coordinator's
///     worker.key operator.key reader.key     one for each role, and further clients' NAME.key
///     clients.toml                           who may connect
struct KeyFolder {
  std::filesystem::path path;

  std::filesystem::path server_key() const { return path / "server.key"; }
  std::filesystem::path clients() const { return path / "clients.toml"; }
  std::filesystem::path client_key(const std::string& name) const { return path / (name + ".key"); }
};

/// SWARMSMITH_KEYS, else swarmsmith/keys in XDG_CONFIG_HOME, else in ~/.config.
KeyFolder default_key_folder();

/// Makes the folder (0700) with all of these files (0600), or nothing: Conflict when one of the
/// files exists. Returns the files in the order above.
Expected<std::vector<std::filesystem::path>> make_key_folder(const KeyFolder& folder);

struct NewClient {
  std::string name;
  Role role = Role::Worker;
  std::optional<std::chrono::year_month_day> expires;
};
/// Makes NAME.key and adds the client to the list, or changes nothing if the name exists already.
/// Returns the key file.
Expected<std::filesystem::path> add_client(const KeyFolder& folder, const NewClient& client);

}  // namespace swarmsmith
