#include "proto/access/address.h"

#include <algorithm>

#include "proto/socket.h"

namespace swarmsmith {
namespace {

/// The address family of the clients that can reach a socket with this wildcard.
Family family_of(const std::string& wildcard) {
  return wildcard == "0.0.0.0" ? Family::Four : Family::Any;
}

/// Debian gives a host's own name the address 127.0.1.1 if it has no other.
bool is_known_to_others(const std::string& name, Family family) {
  const auto numbers = numbers_of(name, family);
  return numbers && std::ranges::any_of(
                        *numbers, [](const std::string& number) { return !is_loopback(number); });
}

std::string reachable_host(Family family) {
  std::string name = name_of_this_host();
  if (!name.empty() && is_known_to_others(name, family)) return name;
  const std::vector<std::string> numbers = numbers_of_this_host(family);
  return numbers.empty() ? "127.0.0.1" : numbers.front();
}

std::string without_brackets(const std::string& host) {
  return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

Expected<std::string> endpoint_of(std::string_view text, bool with_port) {
  const std::string typed(text);
  if (text.starts_with(kTcpScheme)) text.remove_prefix(kTcpScheme.size());
  const auto address = parse_address(text);
  if (!address) return bad_input(address.error().message, typed);
  if (with_port && address->port == 0)
    return bad_input(
        "the port is missing; write one, such as " + to_string(Address{address->host, 5555}),
        typed);
  return tcp_endpoint(*address);
}

std::string advertised_endpoint(const std::string& endpoint, const std::string& advertise) {
  auto address = address_of(endpoint);
  if (!address) return endpoint;
  if (!advertise.empty()) {
    address->host = without_brackets(advertise);
  } else if (is_wildcard(address->host)) {
    address->host = reachable_host(family_of(address->host));
  }
  return tcp_endpoint(*address);
}

std::vector<std::string> advertised_numbers(const std::string& endpoint,
                                            const std::string& advertise) {
  const auto address = address_of(endpoint);
  if (!address || !advertise.empty() || !is_wildcard(address->host)) return {};
  std::vector<std::string> endpoints;
  for (std::string& number : numbers_of_this_host(family_of(address->host)))
    endpoints.push_back(tcp_endpoint({std::move(number), address->port}));
  return endpoints;
}

std::string local_endpoint(const std::string& endpoint) {
  auto address = address_of(endpoint);
  if (!address || !is_wildcard(address->host)) return endpoint;
  // A socket on all interfaces accepts both families, and not every host has ::1.
  address->host = "127.0.0.1";
  return tcp_endpoint(*address);
}

}  // namespace swarmsmith
