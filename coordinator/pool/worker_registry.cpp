#include "coordinator/pool/worker_registry.h"

#include <algorithm>

#include "base/assert.h"

namespace swarmsmith {
namespace {

std::string name_of(const std::string& principal, const std::string& identity) {
  return principal + '\0' + identity;
}

}  // namespace

WorkerEntry* WorkerRegistry::of_peer(PeerId peer) {
  const auto at = by_peer_.find(peer);
  return at == by_peer_.end() ? nullptr : of_number(at->second);
}

WorkerEntry* WorkerRegistry::of_identity(const std::string& principal,
                                         const std::string& identity) {
  const auto at = by_identity_.find(name_of(principal, identity));
  return at == by_identity_.end() ? nullptr : of_number(at->second);
}

WorkerEntry* WorkerRegistry::of_number(WorkerNumber number) {
  const auto at = entries_.find(number);
  return at == entries_.end() ? nullptr : &at->second;
}

WorkerEntry& WorkerRegistry::add(Principal& principal, const std::string& identity) {
  const std::string name = name_of(principal.name, identity);
  SWARMSMITH_ASSERT(!by_identity_.contains(name), "a worker is added once");
  const WorkerNumber number = next_++;
  by_identity_[name] = number;
  WorkerEntry& entry = entries_[number];
  entry.number = number;
  entry.principal = &principal;
  principal.workers.insert(number);
  return entry;
}

void WorkerRegistry::connect(WorkerEntry& entry, PeerId peer, TimePoint now) {
  SWARMSMITH_ASSERT(!entry.connected, "a worker has one connection");
  entry.connected = true;
  entry.peer = peer;
  // Numbers, credit and times are those of one connection; the worker's history stays.
  entry.last_sequence = 0;
  entry.credit = 0;
  entry.asked = false;
  entry.slot_us = 0;
  entry.busy_us = 0;
  entry.reserved = false;
  entry.last_heard = now;
  by_peer_[peer] = entry.number;
  if (entry.quarantined) {
    ++quarantined_;
  } else {
    slots_ += entry.hello.slots;
  }
}

void WorkerRegistry::disconnect(WorkerEntry& entry) {
  SWARMSMITH_ASSERT(entry.connected, "only a connected worker can be disconnected");
  entry.connected = false;
  entry.reserved = false;
  by_peer_.erase(entry.peer);
  if (entry.quarantined) {
    --quarantined_;
  } else {
    slots_ -= entry.hello.slots;
    SWARMSMITH_ASSERT(slots_ >= 0, "the total includes the slots of all connected workers");
  }
}

void WorkerRegistry::set_quarantined(WorkerEntry& entry, bool quarantined) {
  SWARMSMITH_ASSERT(entry.quarantined != quarantined, "a worker goes to quarantine once");
  const bool connected = entry.connected;
  const PeerId peer = entry.peer;
  const TimePoint heard = entry.last_heard;
  const std::uint64_t sequence = entry.last_sequence;
  // Out and in again, so that the slots are counted as those of the new state.
  if (connected) disconnect(entry);
  entry.quarantined = quarantined;
  if (!connected) return;
  connect(entry, peer, heard);
  entry.last_sequence = sequence;
}

void WorkerRegistry::forget_old(TimePoint now) {
  auto idlers = static_cast<std::size_t>(
      std::ranges::count_if(entries_, [](const auto& each) { return each.second.is_idler(); }));
  for (auto at = entries_.begin(); at != entries_.end();) {
    const WorkerEntry& entry = at->second;
    const bool is_old = !entry.connected && now - entry.last_heard > kMemory;
    // Unknown peers can say hello under ever new ids; the entries of workers that did something
    // stay.
    const bool is_one_too_many = entry.is_idler() && idlers > kMostIdlers;
    if (is_old || is_one_too_many) {
      if (entry.is_idler()) --idlers;
      by_identity_.erase(name_of(entry.principal->name, entry.hello.identity));
      entry.principal->workers.erase(entry.number);
      at = entries_.erase(at);
    } else {
      ++at;
    }
  }
}

WorkerRow row_of(const WorkerEntry& entry, WorkerState state) {
  return {.id = entry.number,
          .identity = hexadecimal(entry.hello.identity),
          .host = entry.hello.host,
          .pid = entry.hello.pid,
          .slots = entry.hello.slots,
          .build = entry.hello.build,
          .state = entry.quarantined ? WorkerState::Quarantined : state,
          .done = entry.done,
          .failed = entry.failed,
          .job = entry.hello.job,
          .cpu = entry.hello.cpu,
          .client = entry.hello.client,
          .connections = static_cast<std::int64_t>(entry.hello.incarnation),
          .principal = entry.principal->name};
}

}  // namespace swarmsmith
