#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "storage/rows.h"

namespace swarmsmith::cli {

/// Explains the markers of the table.
std::string marker_legend();
/// A rule, the column names, a rule. With `bounds` there is a column for bounds.
std::string race_headline(bool bounds);
std::string race_rule(bool bounds);
/// The line of irace 4 about one task of a race (irace facts, 24). `used`: the experiments of this
/// race so far; `wall_s`: empty for a task of an earlier process.
std::string race_line(const RaceStepRow& step, std::int64_t used, std::optional<double> wall_s,
                      bool bounds);
/// "Best-so-far configuration: ...".
std::string best_so_far(std::int64_t best, double mean);

}  // namespace swarmsmith::cli
