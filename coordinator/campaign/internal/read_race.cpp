#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/campaign/internal/race_options.h"
#include "coordinator/campaign/internal/read_method.h"
#include "coordinator/campaign/internal/read_target.h"

namespace swarmsmith {
namespace {

/// The enumerator for a text, by the text's index in `names`.
template <class Enum>
std::optional<Enum> read_choice(TableReader& race, std::string_view key,
                                const std::vector<std::string>& names) {
  const auto name = race.choice(key, names);
  if (!name) return std::nullopt;
  return static_cast<Enum>(std::ranges::find(names, *name) - names.begin());
}

/// Reads all options that are a single number or flag.
void read_numbers(TableReader& race, Scenario& scenario) {
  for (const IntegerOption& option : kIntegerOptions) {
    const bool budget = option.member == &Scenario::max_experiments;
    const auto value =
        race.integer(option.key, {option.least, budget ? kLargestBudget : kLargestOption});
    if (value) scenario.*option.member = *value;
  }
  for (const RealOption& option : kRealOptions) {
    const auto value = race.number(option.key, {option.least, option.most});
    if (value) scenario.*option.member = *value;
  }
  for (const FlagOption& option : kFlagOptions) {
    if (const auto value = race.boolean(option.key)) scenario.*option.member = *value;
  }
  scenario.min_experiments = race.integer("min_experiments", {1, kLargestBudget});
  scenario.test_type = read_choice<TestType>(race, "test_type", kTestTypes);
  scenario.capping = race.boolean("capping");
  scenario.capping_type =
      read_choice<CappingType>(race, "capping_type", kCappingTypes).value_or(scenario.capping_type);
  scenario.bound_type =
      read_choice<BoundType>(race, "bound_type", kBoundTypes).value_or(scenario.bound_type);
}

/// Checks that exactly one of the two budgets is given; a time only if programs report theirs.
bool check_budgets(TableReader& race, const Scenario& scenario, bool has_target) {
  if (scenario.max_time > 0 && !has_target) {
    race.complain("max_time",
                  "`max_time` needs a target that reports how long its runs took: [simulator] with "
                  "kind = \"command\"; the simulator's budget is `max_experiments`");
  } else if (scenario.max_time > 0 && scenario.max_experiments > 0) {
    race.complain("max_time", "give `max_experiments` or `max_time`, not both");
  } else if (scenario.max_time == 0 && scenario.max_experiments == 0) {
    race.complain("max_experiments",
                  "[race] needs `max_experiments`, the number of experiments "
                  "that each design may use");
  } else {
    return true;
  }
  return false;
}

/// All searches use the budget, but only races use the other options.
void refuse_options_of_races(TableReader& race) {
  std::vector<std::string_view> keys = {"min_experiments", "test_type", "capping", "capping_type",
                                        "bound_type"};
  for (const IntegerOption& option : kIntegerOptions)
    if (option.member != &Scenario::max_experiments) keys.push_back(option.key);
  for (const RealOption& option : kRealOptions)
    keys.push_back(option.key);
  for (const FlagOption& option : kFlagOptions)
    keys.push_back(option.key);
  for (const std::string_view key : keys) {
    if (race.has(key))
      race.complain(key, "`" + std::string(key) +
                             "` is an option of races, and no method of this campaign races");
  }
}

/// If no method races iteratively: refuses options for which f-race has its own values. Their
/// default values are allowed, because the text in stores contains them.
void refuse_options_of_irace(TableReader& race, const Scenario& read) {
  static constexpr std::array kIntegers = {
      std::pair{"nb_iterations", &Scenario::nb_iterations},
      std::pair{"nb_configurations", &Scenario::nb_configurations},
      std::pair{"min_nb_survival", &Scenario::min_nb_survival},
      std::pair{"elitist_limit", &Scenario::elitist_limit},
      std::pair{"elitist_new_instances", &Scenario::elitist_new_instances}};
  static constexpr std::array kFlags = {std::pair{"elitist", &Scenario::elitist},
                                        std::pair{"soft_restart", &Scenario::soft_restart},
                                        std::pair{"postselection", &Scenario::postselection}};
  const Scenario usual;
  const auto refuse = [&](const auto& options) {
    for (const auto& [key, member] : options) {
      if (!race.has(key) || read.*member == usual.*member) continue;
      race.complain(key, "`" + std::string(key) +
                             "` is for the search irace, and no method of this campaign uses it; "
                             "f-race has `configurations` in [method.f-race]");
    }
  };
  refuse(kIntegers);
  refuse(kFlags);
}

bool uses(const Campaign& campaign, SearchKind kind) {
  return campaign.methods.empty() ||
         std::ranges::count(campaign.methods, kind,
                            [](const Method& m) { return kind_of(m.search); }) > 0;
}

/// The most decimals of a real parameter that a method of the campaign searches.
std::int64_t digits_of_modules(const Campaign& campaign) {
  std::int64_t digits = campaign.digits;
  for (const Method& method : campaign.methods) {
    const auto flavour = flavour_of(method);
    if (!flavour) continue;
    for (const auto& [table, ids] : {std::pair(&(*flavour)->behaviours, &method.behaviours),
                                     std::pair(&(*flavour)->conditions, &method.conditions)}) {
      for (const ModuleSpec& module : *table) {
        if (std::ranges::find(*ids, module.id) == ids->end()) continue;
        for (const ParameterSpec& parameter : module.parameters) {
          if (parameter.type == ParameterSpec::Type::Real)
            digits = std::max<std::int64_t>(digits, parameter.digits);
        }
      }
    }
  }
  return digits;
}

}  // namespace

bool has_races(const Campaign& campaign) {
  return campaign.methods.empty() || std::ranges::any_of(campaign.methods, [](const Method& m) {
           return words_of(m.search).has_tests;
         });
}

void read_race(TableReader& root, const std::filesystem::path& folder, Campaign& campaign) {
  auto race = root.table("race");
  if (!race) {
    if (!root.has("race")) {
      root.complain("race",
                    "the file has no [race]; it needs at least `max_experiments`, the "
                    "number of experiments that each design may use");
    }
    return;
  }
  const std::size_t before = race->complaints();
  if (!has_races(campaign)) refuse_options_of_races(*race);
  read_numbers(*race, campaign.race);
  if (has_races(campaign) && !uses(campaign, SearchKind::Irace))
    refuse_options_of_irace(*race, campaign.race);
  campaign.digits = race->integer("digits", {1, 15}).value_or(digits_of_modules(campaign));
  campaign.test_nb_elites =
      race->integer("test_nb_elites", {0, 1000}).value_or(campaign.test_nb_elites);
  campaign.test_iteration_elites =
      race->boolean("test_iteration_elites").value_or(campaign.test_iteration_elites);
  campaign.only_test = race->boolean("only_test").value_or(false);
  if (campaign.only_test && !campaign.target) {
    race->complain("only_test", "`only_test` needs [simulator] with kind = \"command\"");
  }
  campaign.race.ablation = read_choice<AblationType>(*race, "ablation", kAblationTypes);
  campaign.race.ablation_pairs = race->integer("ablation_pairs", {1, kLargestBudget}).value_or(1);
  if (campaign.race.ablation && !campaign.target)
    race->complain("ablation", "`ablation` needs [simulator] with kind = \"command\"");
  if (race->has("ablation_pairs") && !campaign.race.ablation)
    race->complain("ablation_pairs", "`ablation_pairs` is for campaigns with `ablation`");
  if (const auto repair = race->text("repair_configuration"); repair && !repair->empty()) {
    campaign.repair = program_path(*repair, folder);
  }
  race->finish();
  if (race->complaints() > before) return;
  if (!check_budgets(*race, campaign.race, campaign.target.has_value())) return;
  Scenario judged = campaign.race;
  // Options that depend on the number of instances are checked for each mission.
  judged.n_instances = judged.block_size * judged.first_test;
  if (const auto checked = check(judged); !checked && race->has(checked.error().where)) {
    race->complain(checked.error().where,
                   "`" + checked.error().where + "` " + checked.error().message);
  }
}

}  // namespace swarmsmith
