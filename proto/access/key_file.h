#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith {

/// Files with a secret key, TOML with mode 0600. No error shows what is in them.

/// A client's: one file is enough to connect.
struct ClientKeyFile {
  std::string name;
  Role role = Role::Worker;
  KeyPair pair;
  std::string server_key;  ///< the coordinator's public one

  ClientKeys keys() const { return {.secret_key = pair.secret_key, .server_key = server_key}; }
};

std::string text_of(const ClientKeyFile& key);
/// The coordinator's own.
std::string text_of_server_key(const KeyPair& pair);

/// `file` is the file's name in errors.
Expected<ClientKeyFile> parse_client_key(std::string_view text, const std::string& file);
Expected<KeyPair> parse_server_key(std::string_view text, const std::string& file);

/// Refuses a file that others may read.
Expected<ClientKeyFile> read_client_key(const std::filesystem::path& file);
Expected<KeyPair> read_server_key(const std::filesystem::path& file);

}  // namespace swarmsmith
