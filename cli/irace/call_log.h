#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "programs/target.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// What irace shows of each run with debugLevel 2: the call, how long it took, and what the target
/// said (irace facts, 22). From the rows of a run.
class CallLog {
 public:
  CallLog(swarmsmith::Target target, InstanceTexts instances)
      : target_(std::move(target)), instances_(std::move(instances)) {}

  /// Learns which pair has which instance and seed.
  void take(const PairRow& pair) { pairs_[{pair.purpose, pair.number}] = pair; }
  /// Three lines; nothing of a pair that is not known. `switches`: the configuration's.
  std::string text(const EvaluationRow& run, const std::string& switches,
                   const std::string& date) const;

 private:
  std::string command(const EvaluationRow& run, const PairRow& pair,
                      const std::string& switches) const;

  swarmsmith::Target target_;
  InstanceTexts instances_;
  std::map<std::pair<Purpose, std::int64_t>, PairRow> pairs_;
};

}  // namespace swarmsmith::cli
