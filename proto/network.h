#pragma once

#include <string>

namespace swarmsmith {

/// An IPv4 number within IPv6, as a socket of both families has it, without its "::ffff:".
std::string plain_number(const std::string& address);

/// The host behind an address, as far as it can be told: all addresses of loopback are one
/// ("loopback"), and so are those of an IPv6 network of 64 bits ("2001:db8::/64").
std::string network_of(const std::string& address);

}  // namespace swarmsmith
