#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith {

/// Files with a secret key, in TOML, with mode 0600. No error message shows their content.

/// The key file of a client, which needs no other file to connect.
struct ClientKeyFile {
  std::string name;
  Role role = Role::Worker;
  KeyPair pair;
  std::string server_key;  ///< the coordinator's public key

  ClientKeys keys() const { return {.secret_key = pair.secret_key, .server_key = server_key}; }
};

std::string text_of(const ClientKeyFile& key);
/// The file of the coordinator's own key.
std::string text_of_server_key(const KeyPair& pair);

/// `file` is the file's name in errors.
Expected<ClientKeyFile> parse_client_key(std::string_view text, const std::string& file);
Expected<KeyPair> parse_server_key(std::string_view text, const std::string& file);

/// These refuse a file that other users may read.
Expected<ClientKeyFile> read_client_key(const std::filesystem::path& file);
Expected<KeyPair> read_server_key(const std::filesystem::path& file);

}  // namespace swarmsmith
