#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/clock.h"
#include "coordinator/pool/lease_table.h"
#include "coordinator/pool/principal.h"
#include "coordinator/pool/scheduler_types.h"

namespace swarmsmith {

/// A worker process that said hello. It keeps its number when it comes back.
struct WorkerEntry {
  WorkerNumber number = 0;
  WorkerHello hello;               ///< the last one
  Principal* principal = nullptr;  ///< who answers for it
  bool connected = false;
  PeerId peer = 0;  ///< while connected
  std::uint64_t last_sequence = 0;
  TimePoint last_heard;
  TimePoint last_sent;
  std::uint32_t credit = 0;  ///< tasks that it wants to hold
  bool asked = false;        ///< for work, on this connection
  std::size_t running = 0;   ///< tasks that ran when it last said so
  /// Since its welcome, by its own clock: time of its slots, and how much of it they evaluated; it
  /// says so in heartbeats. 0 before the first, and of workers that do not say it.
  std::int64_t slot_us = 0;
  std::int64_t busy_us = 0;
  /// Nothing more goes to it until it is idle, and then one task that must run alone.
  bool reserved = false;
  std::int64_t done = 0;
  std::int64_t failed = 0;
  /// It or its principal: nothing goes to it, and nothing is taken from it.
  bool quarantined = false;

  bool is_idler() const { return !connected && done == 0 && failed == 0; }
  bool usable() const { return connected && !quarantined; }
  /// Tasks that its last disappearance counted against; it takes that back by coming again.
  std::vector<PackedKey> charged;
};

/// Who is there. Entries of workers that left stay for `kMemory`, so that a late hello can be told
/// from a new worker. All iteration is by number.
class WorkerRegistry {
 public:
  static constexpr Duration kMemory = std::chrono::minutes(15);
  /// Of workers that left without having done anything, so many are remembered.
  static constexpr std::size_t kMostIdlers = 1000;

  explicit WorkerRegistry(WorkerNumber first = 1) : next_(first) {}

  WorkerEntry* of_peer(PeerId peer);
  /// Ids are the workers' own: the same one of another principal is another worker.
  WorkerEntry* of_identity(const std::string& principal, const std::string& identity);
  WorkerEntry* of_number(WorkerNumber number);

  /// A worker that was never seen; not yet connected.
  WorkerEntry& add(Principal& principal, const std::string& identity);
  void connect(WorkerEntry& entry, PeerId peer, TimePoint now);
  void disconnect(WorkerEntry& entry);
  /// Forgets workers that are not connected and were not heard of for long, and of those that did
  /// nothing the oldest ones.
  void forget_old(TimePoint now);
  /// Whether it is worth while.
  bool has_many_gone() const { return entries_.size() > by_peer_.size() + 2 * kMostIdlers; }

  /// Its slots count no more.
  void quarantine(WorkerEntry& entry) { set_quarantined(entry, true); }
  /// They count again.
  void release(WorkerEntry& entry) { set_quarantined(entry, false); }

  std::size_t connected() const { return by_peer_.size(); }
  /// Connected, and not in quarantine.
  std::size_t trusted() const { return by_peer_.size() - quarantined_; }
  std::int64_t slots() const { return slots_; }
  std::map<WorkerNumber, WorkerEntry>& all() { return entries_; }
  const std::map<WorkerNumber, WorkerEntry>& all() const { return entries_; }

 private:
  void set_quarantined(WorkerEntry& entry, bool quarantined);

  std::map<WorkerNumber, WorkerEntry> entries_;
  std::unordered_map<PeerId, WorkerNumber> by_peer_;  ///< connected ones
  std::unordered_map<std::string, WorkerNumber> by_identity_;
  WorkerNumber next_;
  std::int64_t slots_ = 0;       ///< of those that are trusted
  std::size_t quarantined_ = 0;  ///< connected ones
};

/// The row that says how a worker is; of one in quarantine always that, so that a later process
/// knows it.
WorkerRow row_of(const WorkerEntry& entry, WorkerState state);

}  // namespace swarmsmith
