#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/commands/evaluated_apart.h"
#include "cli/replay/stored_runs.h"
#include "console/counter.h"

namespace swarmsmith::cli {

/// "e81200007", or "c812, seed 7" for what the store does not hold.
std::string name_of(const StoredRun& run);
/// "score 3, state digest 00ff..."
std::string values_text(double score, std::uint64_t digest);
/// Both values, who gave the stored one, and why they may differ.
std::string difference_text(const StoredRun& run, const SimulationResult& result);

/// An evaluation that came out otherwise than it is stored, or that cannot be made again.
struct Difference {
  std::string id;
  std::string sentence;
};

/// Evaluates stored evaluations again, each where its crash harms no other process, and compares
/// bits; that it has no score is an outcome too. Errors: no process can be started.
Expected<std::vector<Difference>> compare_again(StoredRuns& runs, std::span<const std::string> ids,
                                                Counter& counter);

}  // namespace swarmsmith::cli
