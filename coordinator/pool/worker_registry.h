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

/// A worker process that has said hello. It keeps its number when it reconnects.
struct WorkerEntry {
  WorkerNumber number = 0;
  WorkerHello hello;               ///< the last one it sent
  Principal* principal = nullptr;  ///< the principal that is responsible for it
  bool connected = false;
  PeerId peer = 0;  ///< while connected
  std::uint64_t last_sequence = 0;
  TimePoint last_heard;
  TimePoint last_sent;
  std::uint32_t credit = 0;  ///< number of tasks that it wants to hold
  bool asked = false;        ///< it has asked for work on this connection
  std::size_t running = 0;   ///< number of running tasks in its last report
  /// Measured by its own clock since its welcome: the time of its slots, and the part of it that
  /// they spent on evaluations, as reported in heartbeats. 0 before the first report, and for
  /// workers that do not report it.
  std::int64_t slot_us = 0;
  std::int64_t busy_us = 0;
  /// It gets no more tasks until it is idle, and then one task that must run alone.
  bool reserved = false;
  std::int64_t done = 0;
  std::int64_t failed = 0;
  /// The worker or its principal is in quarantine: it gets no tasks, and its results do not count.
  bool quarantined = false;

  bool is_idler() const { return !connected && done == 0 && failed == 0; }
  bool usable() const { return connected && !quarantined; }
  /// Tasks that were blamed for its last disappearance; reconnecting clears them.
  std::vector<PackedKey> charged;
};

/// All known workers. Entries of workers that left are kept for `kMemory`, so that a late hello is
/// not taken for a new worker. All iteration is by number.
class WorkerRegistry {
 public:
  static constexpr Duration kMemory = std::chrono::minutes(15);
  /// The number of workers that are remembered after they left without having done anything.
  static constexpr std::size_t kMostIdlers = 1000;

  explicit WorkerRegistry(WorkerNumber first = 1) : next_(first) {}

  WorkerEntry* of_peer(PeerId peer);
  /// Workers choose their ids, so the same id with another principal is another worker.
  WorkerEntry* of_identity(const std::string& principal, const std::string& identity);
  WorkerEntry* of_number(WorkerNumber number);

  /// Adds a new worker; it is not connected yet.
  WorkerEntry& add(Principal& principal, const std::string& identity);
  void connect(WorkerEntry& entry, PeerId peer, TimePoint now);
  void disconnect(WorkerEntry& entry);
  /// Forgets workers that left long ago, and the oldest of those that did nothing.
  void forget_old(TimePoint now);
  /// Whether it is worthwhile to call `forget_old`.
  bool has_many_gone() const { return entries_.size() > by_peer_.size() + 2 * kMostIdlers; }

  /// Its slots no longer count.
  void quarantine(WorkerEntry& entry) { set_quarantined(entry, true); }
  /// Its slots count again.
  void release(WorkerEntry& entry) { set_quarantined(entry, false); }

  std::size_t connected() const { return by_peer_.size(); }
  /// The number of workers that are connected and not in quarantine.
  std::size_t trusted() const { return by_peer_.size() - quarantined_; }
  std::int64_t slots() const { return slots_; }
  std::map<WorkerNumber, WorkerEntry>& all() { return entries_; }
  const std::map<WorkerNumber, WorkerEntry>& all() const { return entries_; }

 private:
  void set_quarantined(WorkerEntry& entry, bool quarantined);

  std::map<WorkerNumber, WorkerEntry> entries_;
  std::unordered_map<PeerId, WorkerNumber> by_peer_;  ///< connected workers
  std::unordered_map<std::string, WorkerNumber> by_identity_;
  WorkerNumber next_;
  std::int64_t slots_ = 0;       ///< of trusted workers
  std::size_t quarantined_ = 0;  ///< connected workers in quarantine
};

/// The worker's row with this state; if the worker is in quarantine, the row always says so, so
/// that a later process knows it.
WorkerRow row_of(const WorkerEntry& entry, WorkerState state);

}  // namespace swarmsmith
