#include <fmt/format.h>
#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "base/text/whole_file.h"
#include "cli/irace/irace_actions.h"
#include "cli/irace/stored_configurations.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/irace_campaign.h"
#include "irace_core/files/configurations_file.h"

namespace swarmsmith::cli {
namespace {

constexpr const char* kEnding = "-test";

/// A campaign that only runs configurations on the test instances.
Campaign test_campaign(const IraceSetup& setup, std::uint64_t seed,
                       const std::string& configurations) {
  Campaign campaign = campaign_of(setup, seed);
  campaign.only_test = true;
  campaign.race = {.max_experiments = 1};
  campaign.repair.clear();
  campaign.methods.front().configurations = configurations;
  // The training instances are not used.
  campaign.missions.front().instances.training = {"none"};
  return campaign;
}

/// Runs tests in a separate store beside `main`. All tests of a run use the same seed, so that they
/// can be compared: the scenario's, that of earlier tests, or the run's.
ExitCode test_beside(Output& output, const IraceSetup& setup, const StorePlace& main,
                     const std::string& configurations, const IraceSlots& slots) {
  const StorePlace first = StorePlace::beside(main.file(), kEnding);
  const std::uint64_t otherwise = seed_of(setup, first.seed() ? first : main);
  const auto campaign_at = [&](const StorePlace& place) {
    return test_campaign(setup, place.seed().value_or(otherwise), configurations);
  };
  const StorePlace place = place_beside(main.file(), kEnding, campaign_at);
  return run_campaign(output, setup, place, campaign_at(place), slots);
}

}  // namespace

ExitCode only_test(Output& output, const IraceSetup& setup, const std::filesystem::path& file,
                   const StorePlace& store, bool is_named, const IraceSlots& slots) {
  const auto text = read_whole_file(file);
  if (!text) return fail(output, ExitCode::Failed, text.error());
  const auto configurations = parse_configurations_file({*text, file.string()}, setup.space);
  if (!configurations) return fail(output, ExitCode::Failed, configurations.error());
  if (!is_named && store.is_kept()) return test_beside(output, setup, store, *text, slots);
  return run_campaign(output, setup, store, test_campaign(setup, seed_of(setup, store), *text),
                      slots);
}

bool has_other_tests(const Campaign& campaign) {
  if (campaign.missions.front().instances.test.empty() || may_begin(campaign)) return false;
  auto stored = stored_campaign(campaign.store);
  if (!stored || stored->missions.size() != 1 || stored->only_test) return false;
  const auto store = StoreReader::open(campaign.store);
  if (!store || !(*store)->finished()) return false;
  // If the digests are equal after this, the campaigns differ only in their tests.
  stored->missions.front().instances.test = campaign.missions.front().instances.test;
  stored->missions.front().test_count = campaign.missions.front().test_count;
  stored->test_nb_elites = campaign.test_nb_elites;
  stored->test_iteration_elites = campaign.test_iteration_elites;
  return campaign_digest(*stored) == campaign_digest(campaign);
}

ExitCode test_elites(Output& output, const IraceSetup& setup, const StorePlace& store,
                     const IraceSlots& slots) {
  const auto stored = read_stored_configurations(store.file(), setup.space);
  if (!stored) return fail(output, ExitCode::Failed, stored.error());
  std::vector<std::int64_t> ids;
  for (const auto& [iteration, elites] : stored->elites) {
    const bool is_last = iteration == stored->elites.rbegin()->first;
    if (!is_last && !setup.test_iteration_elites) continue;
    const auto most = std::min(static_cast<std::size_t>(setup.test_nb_elites), elites.size());
    for (std::size_t i = 0; i < most; ++i)
      stored->add_to(ids, elites[i]);
  }
  if (ids.empty()) {
    const std::string none =
        fmt::format("The race in {} is over, and testNbElites is 0: nothing is tested\n",
                    store.file().string());
    if (output.json) print_note(output, none);
    if (!output.json && !output.quiet) output.out << "# " << none;
    return ExitCode::Done;
  }
  std::vector<Configuration> configurations;
  configurations.reserve(ids.size());
  for (const std::int64_t id : ids)
    configurations.push_back(stored->all.at(id));
  const auto text = print_configurations_file(setup.space, configurations);
  if (!text) return fail(output, ExitCode::Failed, text.error());
  std::string told = fmt::format(
      "# The race in {} is over, and only its tests differ: its winners are tested again\n",
      store.file().string());
  for (std::size_t i = 0; i < ids.size(); ++i)
    told += fmt::format("# {} here is configuration {} of the run\n", i + 1, ids[i]);
  if (output.json) print_note(output, told);
  if (!output.json && !output.quiet) output.out << told;
  return test_beside(output, setup, store, *text, slots);
}

}  // namespace swarmsmith::cli
