#include "cli/irace/irace_actions.h"

#include <utility>

#include "base/text/whole_file.h"
#include "cli/irace/cost_events.h"
#include "cli/irace/irace_console.h"
#include "cli/irace/irace_report.h"
#include "cli/run/campaign_run.h"
#include "coordinator/campaign/irace_campaign.h"
#include "irace_core/files/configurations_file.h"

namespace swarmsmith::cli {
namespace {

/// The setup's campaign without a race.
Expected<Campaign> campaign_for(const IraceSetup& setup, const std::filesystem::path& file,
                                const StorePlace& store) {
  auto text = read_whole_file(file);
  if (!text) return Unexpected(text.error());
  Campaign campaign = campaign_of(setup, seed_of(setup, store));
  const auto configurations = parse_configurations_file({*text, file.string()}, setup.space);
  if (!configurations) return Unexpected(configurations.error());
  campaign.only_test = true;
  campaign.race = {.max_experiments = 1};
  campaign.repair.clear();
  campaign.methods.front().configurations = std::move(*text);
  // Nothing is run on these.
  campaign.missions.front().instances.training = {"none"};
  campaign.store = store.file();
  return campaign;
}

}  // namespace

ExitCode only_test(Output& output, const IraceSetup& setup, const std::filesystem::path& file,
                   const StorePlace& store, const IraceSlots& slots) {
  const auto campaign = campaign_for(setup, file, store);
  if (!campaign) return fail(output, ExitCode::Failed, campaign.error());
  const TimePoint begin = SystemClock().now();
  IraceConsole console(output, {.race = campaign->race, .space = setup.space}, begin);
  Progress progress(output, std::span<const DesignRow>{}, begin);
  CostEvents events(progress);
  RunListener& teller = output.json ? static_cast<RunListener&>(events) : console;
  std::error_code trouble;
  const bool is_new = !std::filesystem::exists(store.file(), trouble);
  const ExitCode ended = carry_out(output, {*campaign}, run_options(slots, store), teller).front();
  if (ended != ExitCode::Done) return explain_end(output, ended, is_new);
  const auto reader = StoreReader::open(store.file());
  if (!reader) return fail(output, ExitCode::Failed, reader.error());
  const auto result = read_irace_result(**reader, setup.space);
  if (!result) return fail(output, ExitCode::Failed, result.error());
  if (output.json) {
    output.out << result_json(*result, store.is_kept() ? store.file().string() : "",
                              static_cast<std::int64_t>(campaign->seed));
  } else if (!output.quiet) {
    output.out << testing_text(*result) << "# " << irace_date() << ": Finished testing\n";
  }
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
