#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "proto/role.h"

namespace swarmsmith {

/// Keys of CURVE, the encryption and authentication of ZeroMQ's connections
/// (rfc.zeromq.org/spec/26, over Curve25519), as texts of 40 characters in Z85
/// (rfc.zeromq.org/spec/32), which need no escapes in TOML.

struct KeyPair {
  std::string public_key;
  std::string secret_key;
};

/// A new pair, from the system's random bytes. Throws std::runtime_error when libzmq was built
/// without CURVE.
KeyPair make_key_pair();

/// Whether the text has the form of a key.
bool is_key(std::string_view text);

/// The public key that belongs to a secret key; the text must have the form of a key.
std::string public_key_of(const std::string& secret_key);

/// A client that a coordinator may admit.
struct ListedClient {
  std::string name;
  Role role = Role::Worker;
  std::string public_key;
  bool expired = false;  ///< known, but expired: refused

  friend bool operator==(const ListedClient&, const ListedClient&) = default;
};

/// A server's own key, and the clients that it admits; it refuses all others.
struct ServerKeys {
  std::string secret_key;
  std::vector<ListedClient> clients;
};

/// A client's own key, and the key of the only server that it trusts.
struct ClientKeys {
  std::string secret_key;
  std::string server_key;  ///< the public key; a server without the secret key for it cannot answer

  friend bool operator==(const ClientKeys&, const ClientKeys&) = default;
};

}  // namespace swarmsmith
