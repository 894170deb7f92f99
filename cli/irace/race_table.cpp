#include "cli/irace/race_table.h"

#include <fmt/format.h>
#include <cmath>

#include "cli/output/number_text.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

std::string mean_text(double mean) {
  return std::isfinite(mean) ? fmt::format("{:#16.10g}", mean) : fmt::format("{:>16}", "NA");
}

std::string or_na(const std::optional<double>& value, int width, const char* format) {
  if (!value) return fmt::format("{:>{}}", "NA", width);
  return fmt::format("{:>{}}", fmt::format(fmt::runtime(format), *value), width);
}

}  // namespace

std::string marker_legend() {
  return "# Markers:\n"
         "     x No test is performed.\n"
         "     c Configurations are discarded only due to capping.\n"
         "     - The test is performed and some configurations are discarded.\n"
         "     = The test is performed but no configuration is discarded.\n"
         "     ! The test is performed and only elites would be discarded, which are kept.\n"
         "     . All alive configurations are elite and nothing had to be run.\n"
         "     : All alive configurations are elite, but some had to be run (capping).\n";
}

std::string race_rule(bool bounds) {
  return std::string("+-+-----------+") + (bounds ? "--------+" : "") +
         "-----------+-----------+----------------+-----------+--------+-----+----+------+\n";
}

std::string race_headline(bool bounds) {
  return race_rule(bounds) + "| |   Instance|" + (bounds ? "   Bound|" : "") +
         "      Alive|       Best|       Mean best| Exp so far|  W time|  rho|KenW|  Qvar|\n" +
         race_rule(bounds);
}

std::string race_line(const RaceStepRow& step, std::int64_t used, std::optional<double> wall_s,
                      bool bounds) {
  std::string text = fmt::format("|{}|{:11}|", step.marker, step.pair);
  if (bounds) text += or_na(step.bound, 8, "{:.2f}") + "|";
  return text +
         fmt::format("{:11}|{:11}|{}|{:11}|{:>8}|{}|{}|{}|\n", step.alive_after,
                     step.best ? number_of(step.best) : 0, mean_text(to_cost(step.mean_best)), used,
                     wall_s ? clock_text(*wall_s) : "NA", or_na(step.spearman_rho, 5, "{:+.2f}"),
                     or_na(step.kendall_w, 4, "{:.2f}"), or_na(step.qvar, 6, "{:.4f}"));
}

std::string best_so_far(std::int64_t best, double mean) {
  return fmt::format("Best-so-far configuration: {:11}    mean value: {}\n", best, mean_text(mean));
}

}  // namespace swarmsmith::cli
