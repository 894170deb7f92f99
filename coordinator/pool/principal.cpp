#include "coordinator/pool/principal.h"

#include "proto/network.h"

namespace swarmsmith {
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

const Principal* Principals::find(const std::string& name) const {
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
