#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace swarmsmith::cli {

/// What irace 4 shows of one task of a race (irace facts, 24).
struct RaceLine {
  char marker = 'x';
  std::int64_t pair = 0;
  std::optional<double> bound;
  std::int64_t alive = 0;
  std::int64_t best = 0;         ///< irace's id
  double mean_best = 0;          ///< cost
  std::int64_t used = 0;         ///< experiments of this race so far
  std::optional<double> wall_s;  ///< nothing for a task that an earlier process did
  std::optional<double> spearman_rho;
  std::optional<double> kendall_w;
  std::optional<double> qvar;
};

/// What the markers mean.
std::string marker_legend();
/// Rule, names of the columns, rule. With `bounds` there is a column for them.
std::string race_headline(bool bounds);
std::string race_rule(bool bounds);
std::string race_line(const RaceLine& line, bool bounds);
/// "Best-so-far configuration: ...".
std::string best_so_far(std::int64_t best, double mean);

}  // namespace swarmsmith::cli
