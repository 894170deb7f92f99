#include <cstdio>
#include <functional>
#include <map>
#include <memory>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "cli/commands/commands.h"
#include "cli/output/number_text.h"
#include "cli/run/campaign_flags.h"
#include "cli/run/campaign_plan.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/programs.h"

namespace swarmsmith::cli {
namespace {

/// "aggregation, grid_exploration x watermelon x 10 repetitions". Machines that are not searched
/// for have one repetition, and a line of their own.
std::string designs_text(const Campaign& campaign) {
  std::string missions;
  for (const CampaignMission& mission : campaign.missions)
    missions += (missions.empty() ? "" : ", ") + mission.mission.name;
  std::map<std::int64_t, std::string, std::greater<>> methods;
  for (const Method& method : campaign.methods) {
    std::string& names = methods[repetitions_of(campaign, method)];
    names += (names.empty() ? "" : ", ") + method.name;
  }
  std::string text;
  for (const auto& [repetitions, names] : methods) {
    text += (text.empty() ? "" : "\n             + ") + missions + " x " + names + " x " +
            counted(repetitions, "repetition");
  }
  return text;
}

std::string decimals(double value, const char* format) {
  char buffer[32];
  const int size = std::snprintf(buffer, sizeof buffer, format, value);
  return {buffer, static_cast<std::size_t>(size)};
}

/// The budget of all races: experiments, or the running time of the programs.
std::string budget_text(const Campaign& campaign, const CampaignPlan& plan) {
  if (campaign.race.max_time > 0) {
    return "as many as fit into a time of " + json_number(campaign.race.max_time) + " per design";
  }
  return grouped(plan.experiments) + " (at most " + grouped(plan.largest_budget) + " per design)";
}

/// The evaluator, and its speed.
std::string evaluation_text(const Campaign& campaign, const CampaignPlan& plan) {
  if (plan.evaluation_s) {
    return decimals(*plan.evaluation_s * 1e3, "%.3g") + " ms on one core of this machine";
  }
  return "by " + campaign.target->runner + ", up to " + std::to_string(plan.slots) + " at a time";
}

/// The plan for people.
void write_text(Output& output, const Campaign& campaign, const CampaignPlan& plan) {
  const std::string megabytes = decimals(plan.disk_bytes / 1e6, "%.1f");
  output.out << "campaign     " << campaign.name << "\n"
             << "store        " << campaign.store.string() << "\n"
             << "designs      " << plan.designs << " = " << designs_text(campaign) << "\n"
             << "experiments  " << budget_text(campaign, plan) << ", and " << grouped(plan.tests)
             << (plan.tests == 1 ? " test of a winner\n" : " tests of winners\n") << "evaluation   "
             << evaluation_text(campaign, plan) << "\n";
  if (plan.evaluation_s) {
    output.out << "time         about " << duration_text(plan.time_s) << " on "
               << counted(plan.slots, "slot") << "\n";
  }
  output.out << "disk         about " << megabytes << " MB, and "
             << decimals(plan.log_bytes / 1e6, "%.1f") << " MB of log while it runs\n"
             << "digest       " << campaign_digest(campaign) << " of what the file asks for\n";
}

/// The plan for programs.
void write_json(Output& output, const Campaign& campaign, const CampaignPlan& plan) {
  std::optional<double> evaluation_ms;
  std::optional<double> time_s;
  if (plan.evaluation_s) {
    evaluation_ms = *plan.evaluation_s * 1e3;
    time_s = plan.time_s;
  }
  output.out << JsonObject()
                    .add("campaign", campaign.name)
                    .add("store", campaign.store.string())
                    .add("digest", campaign_digest(campaign))
                    .add("designs", plan.designs)
                    .add("experiments", plan.experiments)
                    .add("tests", plan.tests)
                    .add("slots", plan.slots)
                    .add("evaluation_ms", evaluation_ms)
                    .add("time_s", time_s)
                    .add("disk_bytes", plan.disk_bytes)
                    .add("log_bytes", plan.log_bytes)
                    .add("warnings", plan.warnings)
                    .text()
             << "\n";
}

ExitCode run_check(const std::string& file, Output& output) {
  const auto campaign = read_or_complain(file, output);
  if (!campaign) return ExitCode::Usage;
  const std::vector<Error> faults = check_programs(*campaign);
  for (const Error& fault : faults)
    print_error(output, fault);
  if (!faults.empty()) return ExitCode::Usage;
  const CampaignPlan plan = plan_of(*campaign);
  for (const std::string& warning : plan.warnings) {
    print_note(output, "warning: " + file + ": " + warning);
  }
  output.json ? write_json(output, *campaign, plan) : write_text(output, *campaign, plan);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_check(Options& options) {
  auto file = std::make_shared<std::string>();
  options.text("FILE", *file, "The campaign file", Options::Need::Required);
  return [file](Output& output) { return run_check(*file, output); };
}

}  // namespace swarmsmith::cli
