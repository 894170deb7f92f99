#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/commands/evaluated_apart.h"
#include "cli/replay/stored_runs.h"
#include "console/counter.h"

namespace swarmsmith::cli {

/// "e81200007", or "c812, seed 7" for an evaluation that is not in the store.
std::string name_of(const StoredRun& run);
/// "score 3, state digest 00ff..."
std::string values_text(double score, std::uint64_t digest);
/// Both values, which worker gave the stored value, and possible reasons for the difference.
std::string difference_text(const StoredRun& run, const Measured& result);

/// An evaluation whose new result differs from the stored one, or that cannot be repeated.
struct Difference {
  std::string id;
  std::string sentence;
};

/// Repeats stored evaluations and compares the bits. They run in a child process, so that a crash
/// harms no other process; an evaluation without a score is compared, too. Errors: no process can
/// be started.
Expected<std::vector<Difference>> compare_again(StoredRuns& runs, std::span<const std::string> ids,
                                                Counter& counter);

}  // namespace swarmsmith::cli
