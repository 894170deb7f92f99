#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "programs/target.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// The report on each run that irace prints with debugLevel 2: the call, its time, and the output
/// of the target (irace facts, 22). Made from the rows of a run.
class CallLog {
 public:
  CallLog(swarmsmith::Target target, InstanceTexts instances)
      : target_(std::move(target)), instances_(std::move(instances)) {}

  /// Keeps the instance and seed of a pair.
  void take(const PairRow& pair) { pairs_[{pair.purpose, pair.number}] = pair; }
  /// Three lines; empty if the pair is not known. `switches`: the command-line switches of the
  /// configuration.
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
