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

/// Who answers for a worker: not the id that the worker chose, but what the transport knows of it.
/// "node1@10.0.0.5": the name of its key and its address, without a key the address alone; all
/// addresses of loopback are one, and so are those of an IPv6 network of 64 bits. A worker that
/// this process started is known by the secret that it was given, and answers for itself.
std::string principal_of(const WorkerHello& hello);

/// The part of a principal's name that `recover --without-key` takes: the key, or all of it.
std::string key_of_principal(const std::string& name);

/// Whether a person means the principal by that word: its name, its key, or its address.
bool is_named(const std::string& principal, std::string_view word);

/// Bytes as text.
std::string hexadecimal(const std::string& bytes);

/// What is known of one of them.
struct Principal {
  /// A result of a worker that is not known yet, which waits for the referee's word on others.
  struct Waiting {
    WorkerNumber worker = 0;
    Result result;
  };

  /// Before the referee; with so many it is given nothing more.
  static constexpr int kMostClaims = 8;
  /// Of a principal without a key so many processes may lie before all of it is in quarantine.
  static constexpr std::size_t kMostLiars = 3;

  /// Why something is in quarantine.
  struct Cause {
    std::string reason;
    std::string since{};  ///< of an earlier process, as its store says; empty: `at`
    TimePoint at{};
  };

  /// What one of its processes has shown, or all of them together.
  struct Standing {
    std::int64_t taken = 0;      ///< results that became outcomes
    std::int64_t confirmed = 0;  ///< results that the referee made again, with the same bits
    std::int64_t strikes = 0;    ///< evaluations that failed, and do not fail elsewhere
    int on_trial = 0;            ///< first results that are before the referee
    std::vector<std::int64_t> unchecked{};  ///< outcomes that were not made again, by campaign

    std::int64_t& unchecked_of(std::uint32_t campaign) {
      if (campaign >= unchecked.size()) unchecked.resize(campaign + 1);
      return unchecked[campaign];
    }
    bool is_known() const { return !unchecked.empty() || confirmed > 0 || strikes > 0; }
  };

  std::string name;
  bool local = false;              ///< started by this process: believed from the beginning
  std::set<WorkerNumber> workers;  ///< that are remembered, connected or not
  std::int64_t taken = 0;          ///< results of all that became outcomes
  std::int64_t astray = 0;         ///< leases that ended with its workers before it delivered
  TimePoint waits_until;           ///< for these: nothing more goes to it
  int claims = 0;                  ///< failures, deaths and contradictions before the referee
  bool quarantined = false;
  Cause cause;                           ///< of its quarantine
  std::map<std::string, Cause> liars{};  ///< single processes in quarantine, by id (hexadecimal)
  std::map<PackedKey, Waiting> waiting;
  std::map<WorkerNumber, Standing> standings{};

  /// Without a key one lie is the doing of one process, not of all that come from there, and each
  /// process has to prove itself.
  bool is_blamed_by_process() const { return swarmsmith::is_blamed_by_process(name); }
  /// The number under which the worker is judged.
  WorkerNumber judged_as(WorkerNumber worker) const {
    return is_blamed_by_process() ? worker : WorkerNumber{0};
  }
  Standing& standing(WorkerNumber worker) { return standings[judged_as(worker)]; }
  /// Null if nothing is known of it.
  const Standing* find_standing(WorkerNumber worker) const {
    const auto at = standings.find(judged_as(worker));
    return at == standings.end() ? nullptr : &at->second;
  }

  bool is_proven() const { return local || taken > 0; }

  /// Nothing of it was ever taken, or it is believed no more.
  bool is_stranger() const { return !local && (taken == 0 || quarantined); }
};

/// All principals by name. Those without workers or history are forgotten.
class Principals {
 public:
  Principal& at(const std::string& name);
  /// The one that answers for the worker, new or known.
  Principal& of(const WorkerHello& hello);
  Principal* find(const std::string& name);
  const Principal* find(const std::string& name) const;
  /// Forgets those without workers or history.
  void forget_idle();

  std::map<std::string, Principal>& all() { return principals_; }
  const std::map<std::string, Principal>& all() const { return principals_; }

 private:
  std::map<std::string, Principal> principals_;
};

}  // namespace swarmsmith
