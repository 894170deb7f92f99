#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/pool/scheduler_types.h"
#include "coordinator/pool/worker_loads.h"

namespace swarmsmith {

/// The identity that is responsible for a worker: not the id that the worker chose, but the
/// properties that the transport knows. "node1@10.0.0.5" is the name of its key and its address;
/// without a key it is the address alone. All loopback addresses count as one, and so do all
/// addresses of an IPv6 network of 64 bits. A worker that this process started is recognised by its
/// secret, and is its own principal.
std::string principal_of(const WorkerHello& hello);

/// The part of a principal's name for `recover --without-key`: the key, or the whole name.
std::string key_of_principal(const std::string& name);

/// Whether the word is the principal's name, its key, or its address.
bool is_named(const std::string& principal, std::string_view word);

/// The bytes as hexadecimal text.
std::string hexadecimal(const std::string& bytes);

/// The history of one principal.
struct Principal {
  /// A result of a worker on trial; it waits for the referee's rulings on other results.
  struct Waiting {
    WorkerNumber worker = 0;
    Result result;
  };

  /// The largest number of claims before the referee; with that many, it gets no more tasks.
  static constexpr int kMostClaims = 8;
  /// Without a key, the whole principal is quarantined when this many of its processes have lied.
  static constexpr std::size_t kMostLiars = 3;

  /// The reason for a quarantine.
  struct Cause {
    std::string reason;
    std::string since{};  ///< from an earlier process, as its store says; empty: `at`
    TimePoint at{};
  };

  /// The record of one of its processes, or of all of them together.
  struct Standing {
    std::int64_t taken = 0;      ///< results that became outcomes
    std::int64_t confirmed = 0;  ///< results that the referee evaluated again, with the same bits
    std::int64_t strikes = 0;    ///< evaluations that failed here and succeed elsewhere
    int on_trial = 0;            ///< first results that the referee is checking
    std::vector<std::int64_t> unchecked{};  ///< number of outcomes without a check, by campaign

    std::int64_t& unchecked_of(std::uint32_t campaign) {
      if (campaign >= unchecked.size()) unchecked.resize(campaign + 1);
      return unchecked[campaign];
    }
    bool is_known() const { return !unchecked.empty() || confirmed > 0 || strikes > 0; }
  };

  std::string name;
  bool local = false;              ///< started by this process: trusted from the beginning
  std::set<WorkerNumber> workers;  ///< workers in the registry, connected or not
  std::int64_t taken = 0;          ///< results of all its workers that became outcomes
  std::int64_t astray = 0;         ///< leases that ended before its first result
  TimePoint waits_until;           ///< because of `astray`: it gets no tasks until then
  int claims = 0;                  ///< failures, deaths, contradictions: open cases
  bool quarantined = false;
  Cause cause;                           ///< of its own quarantine
  std::map<std::string, Cause> liars{};  ///< single processes in quarantine, by id (hexadecimal)
  std::map<PackedKey, Waiting> waiting;
  std::map<WorkerNumber, Standing> standings{};

  /// Without a key, a lie is blamed on one process and not on all processes at that address, and
  /// each process must prove itself.
  bool is_blamed_by_process() const { return swarmsmith::is_blamed_by_process(name); }
  /// The number under which the worker's record is kept.
  WorkerNumber judged_as(WorkerNumber worker) const {
    return is_blamed_by_process() ? worker : WorkerNumber{0};
  }
  Standing& standing(WorkerNumber worker) { return standings[judged_as(worker)]; }
  /// Null if there is no record.
  const Standing* find_standing(WorkerNumber worker) const {
    const auto at = standings.find(judged_as(worker));
    return at == standings.end() ? nullptr : &at->second;
  }

  bool is_proven() const { return local || taken > 0; }

  /// Whether none of its results was accepted yet, or it is no longer trusted.
  bool is_stranger() const { return !local && (taken == 0 || quarantined); }
};

/// All principals by name. Those without workers and history are forgotten.
class Principals {
 public:
  Principal& at(const std::string& name);
  /// The principal of the worker, new or known.
  Principal& of(const WorkerHello& hello);
  Principal* find(const std::string& name);
  const Principal* find(const std::string& name) const;
  /// Forgets principals without workers and history.
  void forget_idle();

  std::map<std::string, Principal>& all() { return principals_; }
  const std::map<std::string, Principal>& all() const { return principals_; }

 private:
  std::map<std::string, Principal> principals_;
};

}  // namespace swarmsmith
