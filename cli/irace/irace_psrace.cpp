#include "cli/irace/irace_actions.h"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "cli/irace/stored_configurations.h"
#include "coordinator/campaign/irace_campaign.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith::cli {
namespace {

constexpr const char* kIdsOption = "--psrace-ids";
constexpr const char* kBudgetOption = "--psrace-max-experiments";

/// The number of experiments. A value up to 1 is a share of the run's maxExperiments, rounded up.
Expected<std::int64_t> budget_of(const IraceSettings& settings, const IraceSetup& setup) {
  const auto text = settings.text(kBudgetOption);
  if (!text || text->empty())
    return bad_input("needs --psrace-max-experiments N: how many experiments the race may have",
                     "--psrace");
  double number = 0;
  const char* end = text->data() + text->size();
  const auto [rest, trouble] = std::from_chars(text->data(), end, number);
  const bool is_share = number <= 1;
  if (trouble != std::errc() || rest != end || !(number > 0) || number > 1e15 ||
      (!is_share && number != std::floor(number)))
    return bad_input(
        "must be a whole number of experiments, or a share of maxExperiments above 0 and up to 1, "
        "found \"" +
            *text + "\"",
        kBudgetOption);
  if (!is_share) return static_cast<std::int64_t>(number);
  if (setup.race.max_experiments == 0)
    return bad_input(
        "is a share of maxExperiments, which this scenario does not set: give a number of "
        "experiments, such as 200",
        kBudgetOption);
  // 0.07 of 100 is 7, but 7.000000000000001 in binary.
  constexpr double kRounding = 1e-9;
  return static_cast<std::int64_t>(
      std::ceil(number * static_cast<double>(setup.race.max_experiments) - kRounding));
}

/// The ids that the user gave; else the best of every iteration and the elites of the last one, or
/// all elites.
Expected<std::vector<std::int64_t>> contestants_of(const IraceSettings& settings,
                                                   const StoredConfigurations& stored) {
  std::vector<std::int64_t> ids;
  if (const auto text = settings.text(kIdsOption); text && !text->empty()) {
    for (const std::string_view word : split(*text, ',')) {
      std::int64_t id = 0;
      const char* end = word.data() + word.size();
      const auto [rest, trouble] = std::from_chars(word.data(), end, id);
      if (trouble != std::errc() || rest != end || id < 1)
        return bad_input("must be a list such as 3,17,20, found \"" + *text + "\"", kIdsOption);
      const auto found = stored.find(id, kIdsOption);
      if (!found) return Unexpected(found.error());
      stored.add_to(ids, id);
    }
  } else {
    const bool all = settings.is_on("--psrace-elites");
    for (const auto& [iteration, elites] : stored.elites) {
      const bool is_last = iteration == stored.elites.rbegin()->first;
      for (std::size_t i = 0; i < (all || is_last ? elites.size() : 1); ++i)
        stored.add_to(ids, elites[i]);
    }
  }
  if (ids.size() > 1) return ids;
  return bad_input(
      "a race needs two configurations or more that differ: name them, such as --psrace-ids 3,17, "
      "or take all elites with --psrace-elites",
      "--psrace");
}

}  // namespace

ExitCode race_again(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                    const std::filesystem::path& finished, const IraceSlots& slots) {
  const auto budget = budget_of(settings, setup);
  if (!budget) return fail(output, ExitCode::Failed, budget.error());
  const auto stored = read_stored_configurations(finished, setup.space);
  if (!stored) return fail(output, ExitCode::Failed, stored.error());
  const auto ids = contestants_of(settings, *stored);
  if (!ids) return fail(output, ExitCode::Failed, ids.error());
  IraceSetup again = setup;
  again.initial.clear();
  for (const std::int64_t id : *ids)
    again.initial.push_back(stored->all.at(id));
  auto text = print_configurations_file(setup.space, again.initial);
  if (!text) return fail(output, ExitCode::Failed, text.error());
  again.configurations_text = std::move(*text);
  again.repair_configuration.clear();
  // A different seed, so that the pairs differ from those of the run.
  again.seed = seed_of(setup, StorePlace::at(finished)) + 1;
  Scenario& race = again.race;
  race.max_experiments = *budget;
  race.min_experiments.reset();
  race.max_time = 0;
  race.nb_iterations = 1;
  race.nb_experiments_per_iteration = 0;
  race.nb_configurations = static_cast<std::int64_t>(ids->size());
  race.min_nb_survival = 1;
  race.elitist = false;
  race.postselection = false;
  race.capping = false;
  if (const auto fits = IteratedRace::start(again.space, race, again.initial); !fits) {
    Error error = fits.error();
    if (error.where == "max_experiments") error.where = kBudgetOption;
    return fail(output, ExitCode::Failed, error);
  }
  if (!output.json && !output.quiet) {
    output.out << fmt::format("# Post-selection race of {}\n", finished.string());
    for (std::size_t i = 0; i < ids->size(); ++i)
      output.out << fmt::format("# {} here is configuration {} of the run\n", i + 1, (*ids)[i]);
  }
  Campaign campaign = campaign_of(again, *again.seed);
  const StorePlace place =
      place_beside(finished, "-psrace", [&campaign](const StorePlace&) { return campaign; });
  return run_campaign(output, again, place, std::move(campaign), slots);
}

}  // namespace swarmsmith::cli
