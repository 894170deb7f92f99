#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Host and port of tcp://HOST:PORT. The host of an IPv6 address is in brackets.
struct Address {
  std::string host;
  std::string port;
};

/// Nothing for what is none (see is_tcp_address).
std::optional<Address> address_of(std::string_view endpoint);

/// Whether only this host can reach it: 127.x.x.x, [::1], localhost.
bool is_loopback(const Address& address);
/// Whether a socket there listens on every interface: *, 0.0.0.0, [::].
bool is_wildcard(const Address& address);

/// Where others find what listens at `endpoint`: with `advertise` in place of the host if it is not
/// empty, and with this host's name, or its address when the name is not known, in place of a
/// wildcard.
std::string advertised_endpoint(const std::string& endpoint, const std::string& advertise);
/// Where processes of this host find it.
std::string local_endpoint(const std::string& endpoint);

std::string name_of_this_host();

}  // namespace swarmsmith
