#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A host and a port: "127.0.0.1:5555", "[fd00::1]:5555", "node1:*".
struct Address {
  std::string host;  ///< a name, or an IP address without brackets; "*": every interface
  int port = 0;      ///< 0: a free one

  friend bool operator==(const Address&, const Address&) = default;
};

/// The host without its brackets, and the port, if there is one. An empty host means that the text
/// has another form, such as an IPv6 address without brackets.
std::pair<std::string, std::optional<std::string>> split_address(std::string_view text);

/// Parses HOST:PORT. An IPv6 address is in brackets; port "*" or 0 means a free one. BadInput.
Expected<Address> parse_address(std::string_view text);
/// The form that `parse_address` reads.
std::string to_string(const Address& address);

/// Whether it is an IPv4 or IPv6 address. A link-local address may have its interface:
/// fe80::1%eth0.
bool is_host_number(const std::string& host);
/// Whether only this host can reach it: 127.x.x.x, ::1, localhost.
bool is_loopback(const std::string& host);
/// Whether a socket with this host listens on every interface: *, 0.0.0.0, ::.
bool is_wildcard(const std::string& host);

enum class Family { Any, Four };
/// The IP addresses of a host, in the order in which to try them; for an IP address, only itself.
/// Unavailable: the name is not known on this host, or there is no such interface.
Expected<std::vector<std::string>> numbers_of(const std::string& host, Family family = Family::Any);

/// The IP addresses at which others may reach this host: those of interfaces that are up, without
/// loopback and link-local addresses. IPv4 first.
std::vector<std::string> numbers_of_this_host(Family family = Family::Any);
std::string name_of_this_host();

}  // namespace swarmsmith
