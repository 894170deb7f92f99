#include "proto/network.h"

#include <arpa/inet.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace swarmsmith {

std::string plain_number(const std::string& address) {
  constexpr std::string_view kMapped = "::ffff:";
  const bool is_mapped = address.starts_with(kMapped) && address.find('.') != std::string::npos;
  return is_mapped ? address.substr(kMapped.size()) : address;
}

std::string network_of(const std::string& address) {
  constexpr const char* kLoopback = "loopback";
  const std::string text = plain_number(address);
  std::array<unsigned char, 16> bytes{};
  if (inet_pton(AF_INET, text.c_str(), bytes.data()) == 1) {
    return bytes[0] == 127 ? kLoopback : text;
  }
  // The name of an interface may follow: fe80::1%eth0.
  if (inet_pton(AF_INET6, text.substr(0, text.find('%')).c_str(), bytes.data()) != 1) return text;
  if (text == "::1") return kLoopback;
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  std::array<char, INET6_ADDRSTRLEN> out{};
  inet_ntop(AF_INET6, bytes.data(), out.data(), out.size());
  return std::string(out.data()) + "/64";
}

}  // namespace swarmsmith
