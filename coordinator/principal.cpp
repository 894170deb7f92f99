#include "coordinator/principal.h"

#include <arpa/inet.h>
#include <algorithm>
#include <array>

namespace swarmsmith {
namespace {

constexpr const char* kLoopback = "loopback";

/// As principals have it.
std::string network_of(const std::string& address) {
  constexpr std::string_view kMapped = "::ffff:";
  const std::string text = address.starts_with(kMapped) ? address.substr(kMapped.size()) : address;
  std::array<unsigned char, 16> bytes{};
  if (inet_pton(AF_INET, text.c_str(), bytes.data()) == 1) {
    return bytes[0] == 127 ? kLoopback : text;
  }
  // An interface may follow: fe80::1%eth0.
  if (inet_pton(AF_INET6, text.substr(0, text.find('%')).c_str(), bytes.data()) != 1) return text;
  if (text == "::1") return kLoopback;
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  std::array<char, INET6_ADDRSTRLEN> out{};
  inet_ntop(AF_INET6, bytes.data(), out.data(), out.size());
  return std::string(out.data()) + "/64";
}

}  // namespace

std::string hexadecimal(const std::string& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : bytes) {
    out += kDigits[static_cast<unsigned char>(c) >> 4U];
    out += kDigits[static_cast<unsigned char>(c) & 15U];
  }
  return out;
}

std::string principal_of(const WorkerHello& hello) {
  if (hello.local) return "local " + hexadecimal(hello.identity);
  const std::string network = network_of(hello.address);
  return hello.client.empty() ? network : hello.client + "@" + network;
}

Principal& Principals::at(const std::string& name) {
  Principal& principal = principals_[name];
  if (principal.name.empty()) principal.name = name;
  return principal;
}

Principal* Principals::find(const std::string& name) {
  const auto at = principals_.find(name);
  return at == principals_.end() ? nullptr : &at->second;
}

void Principals::forget_idle() {
  std::erase_if(principals_, [](const auto& each) {
    const Principal& it = each.second;
    const bool idle = it.workers.empty() && it.waiting.empty();
    const bool awaited = it.claims > 0 || it.on_trial > 0;
    const bool known =
        it.quarantined || !it.unchecked.empty() || it.confirmed > 0 || it.strikes > 0;
    return idle && !awaited && !known;
  });
}

}  // namespace swarmsmith
