#include "base/address.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cstring>
#include <memory>
#include <system_error>

namespace swarmsmith {
namespace {

constexpr int kLargestPort = 65'535;

std::optional<in_addr> four_of(const std::string& host) {
  in_addr number = {};
  return inet_pton(AF_INET, host.c_str(), &number) == 1 ? std::optional(number) : std::nullopt;
}

/// An IPv6 address; an interface may follow it.
std::optional<in6_addr> six_of(const std::string& host) {
  in6_addr number = {};
  return inet_pton(AF_INET6, host.substr(0, host.find('%')).c_str(), &number) == 1
             ? std::optional(number)
             : std::nullopt;
}

std::string text_of(const sockaddr& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool six = address.sa_family == AF_INET6;
  const void* number =
      six ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr)
          : &reinterpret_cast<const sockaddr_in&>(address).sin_addr;
  inet_ntop(address.sa_family, number, text.data(), text.size());
  return text.data();
}

/// Why this host cannot be reached by a link-local address, or empty if it can: each interface has
/// its own link-local network, so the address alone does not determine the host.
std::string objection_to(const std::string& host) {
  const auto six = six_of(host);
  if (!six || !IN6_IS_ADDR_LINKLOCAL(&*six)) return "";
  const std::size_t sign = host.find('%');
  if (sign == std::string::npos) {
    return "a link-local address needs the interface of this host that leads there, such as [" +
           host + "%eth0]";
  }
  const std::string name = host.substr(sign + 1);
  if (if_nametoindex(name.c_str()) != 0) return "";
  return "there is no interface `" + name + "` on this host; `ip -6 address` lists them";
}

}  // namespace

std::pair<std::string, std::optional<std::string>> split_address(std::string_view text) {
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return {};
    std::string host(text.substr(1, end - 1));
    text.remove_prefix(end + 1);
    if (text.empty()) return {std::move(host), std::nullopt};
    if (text.front() != ':') return {};
    return {std::move(host), std::string(text.substr(1))};
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {std::string(text), std::nullopt};
  if (text.find(':', colon + 1) != std::string_view::npos) return {};
  return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

Expected<Address> parse_address(std::string_view text) {
  const auto [host, port] = split_address(text);
  const auto wrong = [&](const char* form = "127.0.0.1:5555 or [fd00::1]:5555") {
    return bad_input(std::string("invalid address; expected host and port, such as ") + form,
                     std::string(text));
  };
  if (host.empty() || !port) {
    const bool bare = host.empty() && !text.starts_with('[') && std::ranges::count(text, ':') > 1;
    return bare ? wrong("[fd00::1]:5555: an IPv6 address is in brackets") : wrong();
  }
  if (text.starts_with('[') && !six_of(host)) return wrong();
  if (*port == "*") return Address{host, 0};
  int number = 0;
  const auto [end, error] = std::from_chars(port->data(), port->data() + port->size(), number);
  const bool whole = error == std::errc() && end == port->data() + port->size();
  if (!whole || number < 0 || number > kLargestPort) return wrong();
  return Address{host, number};
}

std::string to_string(const Address& address) {
  const bool six = address.host.find(':') != std::string::npos;
  return (six ? "[" + address.host + "]" : address.host) + ":" +
         (address.port == 0 ? "*" : std::to_string(address.port));
}

bool is_host_number(const std::string& host) {
  return four_of(host) || six_of(host);
}

bool is_loopback(const std::string& host) {
  if (host == "localhost") return true;
  constexpr unsigned kLoopbackNet = 127;
  if (const auto four = four_of(host)) return (ntohl(four->s_addr) >> 24U) == kLoopbackNet;
  const auto six = six_of(host);
  if (!six) return false;
  return IN6_IS_ADDR_LOOPBACK(&*six) ||
         (IN6_IS_ADDR_V4MAPPED(&*six) && six->s6_addr[12] == kLoopbackNet);
}

bool is_wildcard(const std::string& host) {
  if (host == "*") return true;
  if (const auto four = four_of(host)) return four->s_addr == htonl(INADDR_ANY);
  const auto six = six_of(host);
  return six && IN6_IS_ADDR_UNSPECIFIED(&*six);
}

Expected<std::vector<std::string>> numbers_of(const std::string& host, Family family) {
  if (const std::string why = objection_to(host); !why.empty())
    return unexpected(ErrorKind::Unavailable, why, host);
  if (is_host_number(host)) return std::vector<std::string>{host};
  addrinfo wanted = {};
  wanted.ai_family = family == Family::Four ? AF_INET : AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(host.c_str(), nullptr, &wanted, &found);
  if (failed != 0) {
    const bool unknown = failed == EAI_NONAME || failed == EAI_NODATA;
    return unexpected(ErrorKind::Unavailable,
                      "the name `" + host +
                          (unknown ? std::string("` is not known on this host")
                                   : std::string("` cannot be looked up: ") + gai_strerror(failed)),
                      host);
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  std::vector<std::string> numbers;
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    if (at->ai_family != AF_INET && at->ai_family != AF_INET6) continue;
    std::string number = text_of(*at->ai_addr);
    if (std::ranges::find(numbers, number) == numbers.end()) numbers.push_back(std::move(number));
  }
  return numbers;
}

std::vector<std::string> numbers_of_this_host(Family family) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(all, freeifaddrs);
  std::vector<std::string> fours;
  std::vector<std::string> sixes;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    if ((one->ifa_flags & IFF_UP) == 0 || (one->ifa_flags & IFF_LOOPBACK) != 0) continue;
    if (one->ifa_addr->sa_family == AF_INET) fours.push_back(text_of(*one->ifa_addr));
    if (one->ifa_addr->sa_family != AF_INET6 || family == Family::Four) continue;
    const auto& six = reinterpret_cast<const sockaddr_in6&>(*one->ifa_addr);
    if (!IN6_IS_ADDR_LINKLOCAL(&six.sin6_addr)) sixes.push_back(text_of(*one->ifa_addr));
  }
  std::ranges::move(sixes, std::back_inserter(fours));
  return fours;
}

std::string name_of_this_host() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace swarmsmith
