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

  std::string name;
  bool local = false;              ///< started by this process: believed from the beginning
  std::set<WorkerNumber> workers;  ///< that are remembered, connected or not
  std::int64_t taken = 0;          ///< results that became outcomes
  std::int64_t confirmed = 0;      ///< results that the referee made again, with the same bits
  std::int64_t strikes = 0;        ///< its evaluations that failed, and do not fail elsewhere
  std::int64_t astray = 0;         ///< leases that ended with its workers before it delivered
  TimePoint waits_until;           ///< for these: nothing more goes to it
  int on_trial = 0;                ///< first results that are before the referee
  int claims = 0;                  ///< failures, deaths and contradictions that are before it
  bool quarantined = false;
  std::map<PackedKey, Waiting> waiting;
  std::vector<std::int64_t> unchecked;  ///< outcomes of it that nobody made again, by campaign

  bool is_proven() const { return local || taken > 0; }

  /// Nothing of it was ever taken, or it is believed no more.
  bool is_stranger() const { return !local && (taken == 0 || quarantined); }

  std::int64_t& unchecked_of(std::uint32_t campaign) {
    if (campaign >= unchecked.size()) unchecked.resize(campaign + 1);
    return unchecked[campaign];
  }
};

/// All principals by name. Those of which nothing is known any more are forgotten.
class Principals {
 public:
  Principal& at(const std::string& name);
  Principal* find(const std::string& name);
  const Principal* find(const std::string& name) const;
  /// Forgets those of which nobody is there, and nothing is to be remembered.
  void forget_idle();

  std::map<std::string, Principal>& all() { return principals_; }
  const std::map<std::string, Principal>& all() const { return principals_; }

 private:
  std::map<std::string, Principal> principals_;
};

}  // namespace swarmsmith
