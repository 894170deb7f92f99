#pragma once

#include <string>

namespace swarmsmith {

/// An IPv4 address within an IPv6 address, which a socket of both families reports, without its
/// "::ffff:".
std::string plain_number(const std::string& address);

/// The host that has an address, as far as this can be known: all loopback addresses count as one
/// ("loopback"), and so do those of an IPv6 network of 64 bits ("2001:db8::/64").
std::string network_of(const std::string& address);

}  // namespace swarmsmith
