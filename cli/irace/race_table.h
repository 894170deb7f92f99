#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "storage/rows.h"

namespace swarmsmith::cli {

/// What the markers mean.
std::string marker_legend();
/// Rule, names of the columns, rule. With `bounds` there is a column for them.
std::string race_headline(bool bounds);
std::string race_rule(bool bounds);
/// What irace 4 shows of one task of a race (irace facts, 24): `used` are the experiments of this
/// race so far; there is no `wall_s` for a task that an earlier process did.
std::string race_line(const RaceStepRow& step, std::int64_t used, std::optional<double> wall_s,
                      bool bounds);
/// "Best-so-far configuration: ...".
std::string best_so_far(std::int64_t best, double mean);

}  // namespace swarmsmith::cli
