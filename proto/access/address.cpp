#include "proto/access/address.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>
#include <array>
#include <climits>
#include <memory>

#include "proto/socket.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kScheme = "tcp://";

bool resolves(const std::string& host) {
  struct addrinfo* found = nullptr;
  const bool known = getaddrinfo(host.c_str(), nullptr, nullptr, &found) == 0;
  if (known) freeaddrinfo(found);
  return known;
}

/// The first IPv4 address of an interface that is up and is not the loopback; empty without one.
std::string first_address() {
  struct ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return "";
  const std::unique_ptr<struct ifaddrs, decltype(&freeifaddrs)> owner(all, freeifaddrs);
  for (const struct ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_UP) == 0 || (one->ifa_flags & IFF_LOOPBACK) != 0) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    return text.data();
  }
  return "";
}

std::string reachable_host() {
  const std::string name = name_of_this_host();
  if (!name.empty() && resolves(name)) return name;
  const std::string address = first_address();
  return address.empty() ? "127.0.0.1" : address;
}

std::string with_host(const std::string& host, const std::string& port) {
  return std::string(kScheme) + host + ":" + port;
}

}  // namespace

std::optional<Address> address_of(std::string_view endpoint) {
  if (!is_tcp_address(endpoint)) return std::nullopt;
  const std::size_t colon = endpoint.rfind(':');
  return Address{.host = std::string(endpoint.substr(kScheme.size(), colon - kScheme.size())),
                 .port = std::string(endpoint.substr(colon + 1))};
}

bool is_loopback(const Address& address) {
  if (address.host == "localhost" || address.host == "[::1]") return true;
  struct in_addr number = {};
  constexpr unsigned kLoopbackNet = 127;
  return inet_pton(AF_INET, address.host.c_str(), &number) == 1 &&
         (ntohl(number.s_addr) >> 24U) == kLoopbackNet;
}

bool is_wildcard(const Address& address) {
  return address.host == "*" || address.host == "0.0.0.0" || address.host == "[::]";
}

std::string advertised_endpoint(const std::string& endpoint, const std::string& advertise) {
  const auto address = address_of(endpoint);
  if (!address) return endpoint;
  if (!advertise.empty()) return with_host(advertise, address->port);
  return is_wildcard(*address) ? with_host(reachable_host(), address->port) : endpoint;
}

std::string local_endpoint(const std::string& endpoint) {
  const auto address = address_of(endpoint);
  if (!address || !is_wildcard(*address)) return endpoint;
  return with_host("127.0.0.1", address->port);
}

std::string name_of_this_host() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace swarmsmith
