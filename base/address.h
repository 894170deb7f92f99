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
  std::string host;  ///< a name, or a number without brackets; "*": every interface
  int port = 0;      ///< 0: a free one

  friend bool operator==(const Address&, const Address&) = default;
};

/// The host without its brackets, and the port, if there is one. An empty host: the text has
/// another form, such as an IPv6 number without brackets.
std::pair<std::string, std::optional<std::string>> split_address(std::string_view text);

/// HOST:PORT. An IPv6 number is in brackets; "*" or 0 as port: a free one. BadInput.
Expected<Address> parse_address(std::string_view text);
/// As `parse_address` takes it.
std::string to_string(const Address& address);

/// Whether it is an IPv4 or IPv6 number. A link-local one may have its interface: fe80::1%eth0.
bool is_host_number(const std::string& host);
/// Whether only this host can reach it: 127.x.x.x, ::1, localhost.
bool is_loopback(const std::string& host);
/// Whether a socket there listens on every interface: *, 0.0.0.0, ::.
bool is_wildcard(const std::string& host);

enum class Family { Any, Four };
/// The numbers of a host, in the order in which to try them; a number is its own. Unavailable: the
/// name is not known here, or there is no such interface.
Expected<std::vector<std::string>> numbers_of(const std::string& host, Family family = Family::Any);

/// The numbers by which others may reach this host: of interfaces that are up, without loopback
/// and link-local ones. IPv4 first.
std::vector<std::string> numbers_of_this_host(Family family = Family::Any);
std::string name_of_this_host();

}  // namespace swarmsmith
