#include "cli/irace/call_log.h"

#include <fmt/format.h>
#include <cstdlib>

#include "programs/command_line.h"
#include "programs/cost.h"

namespace swarmsmith::cli {

std::string CallLog::command(const EvaluationRow& run, const PairRow& pair,
                             const std::string& switches) const {
  const bool test = pair.purpose == Purpose::Test || pair.instance < 0;
  const std::int64_t number = std::abs(pair.instance);
  const auto& list = test ? instances_.test : instances_.training;
  const bool is_known = number >= 1 && static_cast<std::size_t>(number) <= list.size();
  const std::string id = std::to_string(number) + (test ? "t" : "");
  const std::string instance = is_known ? list[static_cast<std::size_t>(number - 1)] : "";
  if (pair.purpose == Purpose::Evaluator) {
    return fmt::format("{} {} {} {} {}", target_.evaluator, number_of(run.key.candidate), id,
                       pair.seed, instance);
  }
  const std::string& program = target_.launcher.empty() ? target_.runner : target_.launcher;
  return program + " " +
         arguments_of(target_, RunnerCall{.configuration = number_of(run.key.candidate),
                                          .instance_id = id,
                                          .seed = pair.seed,
                                          .instance = instance,
                                          .bound = run.bound,
                                          .switches = switches});
}

std::string CallLog::text(const EvaluationRow& run, const std::string& switches,
                          const std::string& date) const {
  const auto pair = pairs_.find({run.key.purpose, run.key.pair});
  if (pair == pairs_.end()) return "";
  const bool has_cost = target_.evaluator.empty() || run.key.purpose == Purpose::Evaluator;
  std::string said;
  if (run.status == EvaluationStatus::Rejected) {
    said = "Inf";
  } else if (has_cost) {
    said = fmt::format("{:.15g}", to_cost(run.measured.score));
  }
  if (run.measured.time > 0)
    said += fmt::format("{}{:.15g}", said.empty() ? "" : " ", run.measured.time);
  return fmt::format("# {}: {}\n# {}: DONE ({}) Elapsed wall-clock seconds: {:.2f}\n{}\n", date,
                     command(run, pair->second, switches), date, number_of(run.key.candidate),
                     1e-6 * static_cast<double>(run.measured.wall_us), said);
}

}  // namespace swarmsmith::cli
