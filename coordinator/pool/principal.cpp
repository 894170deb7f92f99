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
  // Not the address: all of loopback is one principal, and other users of this host have it, too.
  if (hello.local) return "local " + hexadecimal(hello.identity);
  const std::string network = network_of(hello.address);
  return hello.client.empty() ? network : hello.client + "@" + network;
}

std::string key_of_principal(const std::string& name) {
  return name.substr(0, name.find('@'));
}

bool is_named(const std::string& principal, std::string_view word) {
  const std::string_view name = principal;
  const std::size_t at = name.find('@');
  // If a key is quarantined at all addresses, any of its names means all of them.
  if (at == std::string_view::npos) return name == word.substr(0, word.find('@'));
  return name == word || name.substr(0, at) == word || name.substr(at + 1) == word;
}

Principal& Principals::at(const std::string& name) {
  Principal& principal = principals_[name];
  if (principal.name.empty()) principal.name = name;
  return principal;
}

Principal& Principals::of(const WorkerHello& hello) {
  Principal& principal = at(principal_of(hello));
  principal.local |= hello.local;
  // A key that is quarantined as a whole is quarantined at every address.
  const Principal* key = hello.client.empty() ? nullptr : find(hello.client);
  if (key != nullptr && key->quarantined && !principal.quarantined) {
    principal.quarantined = true;
    principal.cause = key->cause;
  }
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
  for (auto& [name, it] : principals_) {
    const std::set<WorkerNumber>& workers = it.workers;
    std::erase_if(it.standings, [&](const auto& one) {
      const auto& [worker, standing] = one;
      return !workers.contains(worker) && !standing.is_known() && standing.on_trial == 0;
    });
  }
  std::erase_if(principals_, [](const auto& each) {
    const Principal& it = each.second;
    const bool idle = it.workers.empty() && it.waiting.empty() && it.claims == 0;
    return idle && it.standings.empty() && !it.quarantined && it.liars.empty();
  });
}

}  // namespace swarmsmith
