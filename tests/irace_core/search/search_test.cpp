#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "irace_core/ablation.h"
#include "irace_core/iterated_race.h"
#include "tests/irace_core/costs.h"
#include "tests/irace_core/event_digest.h"
#include "tests/irace_core/search/played.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

class EverySearch : public ::testing::TestWithParam<SearchKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EverySearch, ::testing::ValuesIn(all_searches()),
                         [](const auto& tested) {
                           std::string name(name_of(tested.param));
                           std::erase(name, '-');
                           return name;
                         });

/// What decides: events but for their texts.
std::vector<std::uint64_t> digests(const Played& played) {
  std::vector<std::uint64_t> all;
  for (const RaceStep& step : only<RaceStep>(played.events))
    all.push_back(step.digest);
  for (const ConfigurationSampled& sampled : only<ConfigurationSampled>(played.events))
    all.push_back(sampled.configuration.digest());
  for (const Elite& elite : played.elites)
    all.push_back(static_cast<std::uint64_t>(elite.configuration));
  return all;
}

TEST(Ranked, PutsWhatWasRejectedLastWhateverItsCosts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::int64_t, std::int64_t>> runs = {{1, 1}, {1, 2}, {2, 1}, {2, 2},
                                                                   {3, 1}, {3, 2}, {4, 1}, {4, 2}};
  const std::vector<double> costs = {kInfinity, -kInfinity, -kInfinity, 1, 5, 5, 4, 2};
  const auto order = search::ranked(runs, costs);
  std::vector<std::int64_t> ids;
  for (const search::Scored& one : order)
    ids.push_back(one.id);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{4, 3, 1, 2}));
  EXPECT_EQ(order[2].mean, kInfinity);
  EXPECT_EQ(order[3].mean, kInfinity);
}

TEST_P(EverySearch, GivesTheSameAnswerTwiceAndAnotherForAnotherSeed) {
  const auto once = play(*started(weights_space(5), options_of(GetParam()), 6000, 7), noisy_sphere);
  const auto twice =
      play(*started(weights_space(5), options_of(GetParam()), 6000, 7), noisy_sphere);
  const auto other =
      play(*started(weights_space(5), options_of(GetParam()), 6000, 8), noisy_sphere);
  EXPECT_EQ(digests(once), digests(twice));
  EXPECT_NE(digests(once), digests(other));
}

/// The first weight may not be 0 or less.
ParameterSpace space_with_forbidden() {
  std::vector<Parameter> parameters;
  for (const char* name : {"w0", "w1"})
    parameters.push_back({name, std::string("--") + name + " ", Real{-5.0, 5.0}, {}});
  std::vector<Expression> forbidden;
  forbidden.push_back(
      Expression::call(Operation::LessEqual, {Expression::parameter("w0"), Expression::number(0)}));
  return ParameterSpace::make(std::move(parameters), std::move(forbidden), 4).value();
}

/// A search of one version; a trace is the digest of all its questions and events.
struct Traced {
  const char* name;
  ParameterSpace space;
  SearchOptions options;
  std::int64_t budget;
  std::int64_t extension;  ///< further experiments; 0 for none
  double rejects;          ///< share of the configurations that are rejected
  bool gives_initial;      ///< whether it begins with given configurations
  std::uint64_t trace;
};

template <class Options>
Options changed(void (*change)(Options&)) {
  Options options;
  change(options);
  return options;
}

/// Weights from -1 to 9, -2 to 8, ...: the middles are 4, 3, ...
ParameterSpace uneven_space(int count) {
  std::vector<Parameter> parameters;
  for (int i = 0; i < count; ++i)
    parameters.push_back({"w" + std::to_string(i), "", Real{-1.0 - i, 9.0 - i}, {}});
  return ParameterSpace::make(std::move(parameters), {}, 2).value();
}

/// The options that are not the default ones are chosen to reach other rules: members that are
/// few, a last part that is smaller, temperatures that begin again, a start that is random.
std::vector<Traced> traced_searches() {
  const EvolutionOptions neat;
  const auto normal = changed<EvolutionOptions>([](EvolutionOptions& o) {
    o.population = 9, o.runs = 3, o.parents = 0.5, o.elites = 0.25, o.step = 0.7;
    o.mutation = Mutation::Normal, o.final_runs = 4;
  });
  const auto small_cma = changed<CmaEsOptions>(
      [](CmaEsOptions& o) { o.population = 7, o.runs = 2, o.step = 0.5, o.final_runs = 3; });
  const auto wide_cma =
      changed<CmaEsOptions>([](CmaEsOptions& o) { o.population = 6, o.runs = 1, o.step = 10; });
  const auto published = changed<AnnealingOptions>([](AnnealingOptions& o) {
    o.cooling = Cooling::Published, o.window = 5, o.moved = 2, o.final_runs = 7;
  });
  const auto frozen = changed<AnnealingOptions>([](AnnealingOptions& o) {
    o.start_temperature = 3, o.end_temperature = 0, o.start_at_random = true, o.moved = 10;
  });
  const auto finalists = changed<RandomOptions>(
      [](RandomOptions& o) { o.runs = 3, o.finalists = 4, o.final_runs = 11; });
  const auto many = changed<RandomOptions>(
      [](RandomOptions& o) { o.runs = 1, o.finalists = 1200, o.final_runs = 1; });
  const auto few = changed<FRaceOptions>([](FRaceOptions& o) { o.configurations = 30; });
  return {
      {"irace", mixed_space(), search_of(SearchKind::Irace), 2000, 900, 0.1, true,
       16765328373391945833U},
      {"f-race", mixed_space(), FRaceOptions{}, 2000, 0, 0, true, 4273007449327865898U},
      {"f-race of 30", mixed_space(), few, 700, 0, 0.2, false, 16203336691198566586U},
      {"random", mixed_space(), RandomOptions{}, 12'500, 2150, 0, true, 18056707219770113915U},
      {"random, 4 finalists", space_with_forbidden(), finalists, 5000, 500, 0.3, true,
       17169148142968550858U},
      {"random, 1200 finalists", weights_space(2), many, 2500, 2000, 0, false,
       2028789710540222448U},
      {"evolution", uneven_space(12), neat, 6000, 3010, 0.05, true, 13754415954659972052U},
      {"evolution, normal", weights_space(3, 2), normal, 500, 200, 0, false, 7770733067100650419U},
      {"cma-es", weights_space(5), CmaEsOptions{}, 6000, 3010, 0, false, 7241178616094801548U},
      {"cma-es, 7 members", uneven_space(4), small_cma, 400, 150, 0.1, true, 14249266619628736531U},
      {"cma-es, wide", weights_space(12), wide_cma, 300, 100, 0, true, 1857509475774027010U},
      {"annealing", mixed_space(), AnnealingOptions{}, 4000, 0, 0, false, 51207754885657526U},
      {"annealing, published", weights_space(3), published, 2000, 0, 0.1, true,
       1280989082109102630U},
      {"annealing, frozen", mixed_space(), frozen, 3000, 0, 0, true, 13364618673641254097U},
  };
}

std::uint64_t trace_of(const Traced& traced) {
  Scenario scenario;
  scenario.max_experiments = traced.budget;
  scenario.n_instances = 3;
  scenario.seed = 7;
  Rng rng(5);
  std::vector<Configuration> initial;
  for (int i = 0; traced.gives_initial && i < 5; ++i)
    initial.push_back(sample_uniform(traced.space, rng).value());
  auto search = value_of(start_search(traced.space, scenario, traced.options, initial));
  testing::EventDigest digest;
  const auto add_state = [&] {
    for (const RaceEvent& event : search->take_events())
      digest.add(event);
    digest.add(search->wanted());
    digest.add(search->ahead(2));
    digest.add(search->alive());
    digest.add(search->elites());
    for (const std::int64_t number :
         {search->experiments_used(), search->budget(), search->iteration(), search->n_iterations(),
          search->n_alive()})
      digest.add(number);
  };
  const auto play_to_the_end = [&] {
    for (add_state(); !search->finished(); add_state()) {
      std::vector<Measurement> costs;
      for (const Experiment& wanted : search->wanted()) {
        const Configuration& configuration = search->configuration(wanted.configuration);
        const bool is_rejected = Rng(configuration.digest()).bernoulli(traced.rejects);
        costs.push_back({is_rejected ? std::numeric_limits<double>::infinity()
                                     : testing::synthetic_cost(configuration, wanted),
                         0});
      }
      search->tell(costs);
    }
  };
  play_to_the_end();
  const auto least = search->least_extension();
  digest.add(least ? *least : -1);
  EXPECT_EQ(least.has_value(), traced.extension > 0);
  if (traced.extension == 0) return digest.value64();
  EXPECT_TRUE(search->extend(traced.extension));
  play_to_the_end();
  return digest.value64();
}

/// A search that decides otherwise for the same costs needs another version in its words: a store
/// of the version before could be continued with another search than it began with.
TEST(Search, DecidesAsItsVersionPromises) {
  ASSERT_EQ(kRaceVersion, 2) << "the traces of races are those of another version";
  for (const SearchKind kind : all_searches())
    ASSERT_EQ(words_of(kind).version, 1) << name_of(kind) << ": the traces are of another version";
  for (const Traced& traced : not_empty(traced_searches()))
    EXPECT_EQ(trace_of(traced), traced.trace) << traced.name;
}

/// Small numbers of runs and members, and any shares.
struct DrawnOptions {
  Rng& rng;

  void operator()(const SearchField& field, std::int64_t& value) const {
    const auto least = static_cast<std::int64_t>(field.least);
    value = rng.uniform_int(least, least + rng.uniform_int(1, 30));
  }
  void operator()(const SearchField& field, double& value) const {
    value = rng.uniform(field.least, std::min(field.most, 10.0));
  }
  template <class Choice>
  void operator()(const SearchField&, Choice&) const {}
};

TEST_P(EverySearch, CountsEachRunAndNeverExceedsItsBudget) {
  Rng rng(11);
  const DrawnOptions draw{rng};
  for (int i = 0; i < 200; ++i) {
    SearchOptions options = options_of(GetParam());
    do {
      visit_search_fields(options, draw);
    } while (!faults_of(options).empty());
    Scenario scenario;
    scenario.max_experiments = rng.uniform_int(1, 4000);
    scenario.seed = static_cast<std::uint64_t>(i) + 1;
    auto search = start_search(weights_space(3), scenario, options);
    if (!search) {
      EXPECT_THAT(to_string(search.error()), HasSubstr("must be at least"));
      // The number that it names works, and one less does not.
      const std::string text = search.error().message;
      scenario.max_experiments = std::stoll(text.substr(text.rfind(' ') + 1));
      EXPECT_TRUE(start_search(weights_space(3), scenario, options)) << text;
      --scenario.max_experiments;
      EXPECT_FALSE(start_search(weights_space(3), scenario, options)) << text;
      continue;
    }
    const Played played = play(**search, noisy_sphere);
    EXPECT_LE((*search)->experiments_used(), scenario.max_experiments);
    EXPECT_EQ((*search)->experiments_used(), played.asked);
    std::int64_t counted = 0;
    for (const RaceStep& step : only<RaceStep>(played.events)) {
      counted += static_cast<std::int64_t>(step.evaluated.size());
      EXPECT_EQ(step.experiments_used, counted);
    }
    EXPECT_FALSE(played.elites.empty());
  }
}

TEST_P(EverySearch, AsksInCanonicalOrderAndNeverTwiceForOneRun) {
  // Races ask for their tasks in turn, and elitist ones for new pairs first.
  const bool is_race = words_of(GetParam()).has_tests;
  auto search = started(weights_space(3), options_of(GetParam()), 3000);
  std::set<std::pair<std::int64_t, std::int64_t>> seen;
  while (!search->finished()) {
    std::pair<std::int64_t, std::int64_t> last{0, 0};
    std::vector<Measurement> costs;
    for (const Experiment& wanted : not_empty(search->wanted())) {
      const std::pair now{wanted.pair, wanted.configuration};
      EXPECT_TRUE(is_race || last < now);
      EXPECT_TRUE(seen.insert(now).second);
      last = now;
      costs.push_back({noisy_sphere(search->configuration(wanted.configuration), wanted), 0});
    }
    search->tell(costs);
  }
}

TEST_P(EverySearch, FindsTheSphereBetterThanItsFirstDraws) {
  auto search = started(weights_space(4), options_of(GetParam()), 12000);
  const Played played = play(*search, noisy_sphere);
  const Configuration& best = search->configuration(played.elites.front().configuration);
  double distance = 0;
  for (std::size_t i = 0; i < best.size(); ++i)
    distance += (best[i] - 1) * (best[i] - 1);
  // A uniform draw is 37 away from it in the mean.
  EXPECT_LT(distance, 9);
}

/// Stores take finite numbers alone, and a step or an iteration may have no good one.
void expect_finite(const Played& played) {
  for (const RaceStep& step : only<RaceStep>(played.events))
    EXPECT_TRUE(std::isfinite(step.mean_best)) << "step of iteration " << step.iteration;
  for (const IterationEnded& ended : only<IterationEnded>(played.events)) {
    for (const Elite& elite : ended.elites)
      EXPECT_TRUE(std::isfinite(elite.mean)) << "elite of iteration " << ended.iteration;
  }
}

TEST_P(EverySearch, OutlivesRejectionsAndSaysWhenThereIsNothingElse) {
  const double rejected = std::numeric_limits<double>::infinity();
  auto search = started(weights_space(3), options_of(GetParam()), 3000);
  const Played some = play(*search, [&](const Configuration& c, const Experiment& e) {
    return c[0] > 2 ? rejected : noisy_sphere(c, e);
  });
  ASSERT_FALSE(some.elites.empty());
  EXPECT_LE(search->configuration(some.elites.front().configuration)[0], 2);
  expect_finite(some);

  auto unlucky = started(weights_space(3), options_of(GetParam()), 3000);
  expect_finite(play(*unlucky, [&](const Configuration& c, const Experiment& e) {
    return c[0] > -4 ? rejected : noisy_sphere(c, e);
  }));

  auto hopeless = started(weights_space(3), options_of(GetParam()), 3000);
  expect_finite(play(*hopeless, [&](const Configuration&, const Experiment&) { return rejected; }));
  ASSERT_TRUE(hopeless->failure());
  EXPECT_THAT(hopeless->failure()->message, HasSubstr("rejected"));
  EXPECT_TRUE(hopeless->elites().empty());
}

TEST_P(EverySearch, GivesAllTheSameSeedOnAPair) {
  auto search = started(weights_space(3), options_of(GetParam()), 3000, 5);
  auto race = started(weights_space(3), options_of(SearchKind::Irace), 3000, 5);
  std::map<std::int64_t, std::int64_t> seeds;
  for (const Experiment& wanted : race->wanted())
    seeds.emplace(wanted.pair, wanted.seed);
  for (const Experiment& wanted : not_empty(search->wanted())) {
    if (!seeds.contains(wanted.pair)) continue;
    EXPECT_EQ(wanted.seed, seeds.at(wanted.pair));
  }
}

TEST_P(EverySearch, RefusesCostsThatBreakTheContract) {
  auto search = started(weights_space(3), options_of(GetParam()), 3000);
  EXPECT_THROW(search->tell({}), std::invalid_argument);
  std::vector<Measurement> costs(search->wanted().size());
  costs[0].cost = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(search->tell(costs), std::invalid_argument);
}

TEST_P(EverySearch, GoesOnAfterAnExtensionOrSaysWhyNot) {
  auto search = started(weights_space(3), options_of(GetParam()), 3000);
  Played played = play(*search, noisy_sphere);
  const auto least = search->least_extension();
  if (!least) {
    EXPECT_FALSE(search->extend(100'000));
    EXPECT_THAT(least.error().message, Not(IsEmpty()));
    return;
  }
  // What is too little for an iteration gives a race a further post-selection.
  const bool is_race = words_of(GetParam()).has_tests;
  if (!is_race) {
    EXPECT_EQ(complaint_of(search->extend(*least - 1)),
              "is too little for a further generation and a final stage: it must be at least " +
                  std::to_string(*least));
  }
  const std::int64_t before = search->budget();
  ASSERT_TRUE(search->extend(*least));
  EXPECT_EQ(search->budget(), before + *least);
  play_on(*search, noisy_sphere, played);
  EXPECT_LE(search->experiments_used(), search->budget());
  EXPECT_EQ(search->experiments_used(), played.asked);
}

TEST(Search, OfOneRaceHasNoOther) {
  auto search = started(weights_space(3), options_of(SearchKind::FRace), 3000);
  play(*search, noisy_sphere);
  ASSERT_TRUE(search->finished());
  ASSERT_FALSE(search->extend(100'000));
  EXPECT_THAT(search->least_extension().error().message, HasSubstr("drawn once"));
}

TEST(Search, OfOneRaceDrawsAsManyAsItCanTest) {
  const auto drawn = [](const Scenario& scenario, const FRaceOptions& options = {}) {
    const Scenario race = f_race_scenario(scenario, options);
    EXPECT_EQ(race.nb_iterations, 1);
    EXPECT_FALSE(race.elitist);
    EXPECT_EQ(race.elitist_limit, 0);
    EXPECT_FALSE(race.soft_restart);
    EXPECT_FALSE(race.postselection);
    EXPECT_EQ(race.min_nb_survival, 1);
    EXPECT_EQ(race.max_configurations_per_race,
              std::max<std::int64_t>(1024, race.nb_configurations));
    return race.nb_configurations;
  };
  Scenario scenario;
  scenario.max_experiments = 40'000;
  EXPECT_EQ(drawn(scenario), 2000);
  scenario.max_experiments = 10;
  EXPECT_EQ(drawn(scenario), 2);
  scenario.max_experiments = 4000;
  EXPECT_EQ(drawn(scenario), 200);
  scenario.first_test = 25;
  EXPECT_EQ(drawn(scenario), 4000 / 26);
  EXPECT_EQ(drawn(scenario, {.configurations = 70}), 70);
  scenario.first_test = 5;
  scenario.min_experiments = 1000;
  EXPECT_EQ(drawn(scenario), 50);
}

TEST(Search, OfOneRaceHasNeitherTimesNorElitesThatBoundThem) {
  Scenario scenario;
  scenario.max_time = 5000;
  const SearchOptions options = options_of(SearchKind::FRace);
  EXPECT_EQ(complaint_of(start_search(weights_space(3), scenario, options)),
            "max_time: is for irace alone: the budget of f-race is max_experiments");
  scenario.max_time = 0;
  scenario.max_experiments = 4000;
  scenario.capping = true;
  scenario.bound_max = 10;
  EXPECT_EQ(complaint_of(start_search(weights_space(3), scenario, options)),
            "capping: is for irace alone: f-race has no elites whose times are bounds");
}

/// Each of 30 needs five runs up to the first test and one more.
TEST(Search, OfOneRaceSaysHowMuchItsConfigurationsNeed) {
  Scenario scenario;
  FRaceOptions options;
  options.configurations = 30;
  scenario.max_experiments = 180;
  EXPECT_TRUE(start_search(weights_space(3), scenario, options));
  scenario.max_experiments = 179;
  EXPECT_EQ(complaint_of(start_search(weights_space(3), scenario, options)),
            "max_experiments: `configurations` is 30, and a budget of 179 experiments is too small "
            "for so many: it must be at least 180");
}

TEST(Search, SaysWhichOptionsDoNotGoTogether) {
  const auto faults = [](const SearchOptions& options) {
    std::string text;
    for (const SearchFault& fault : faults_of(options)) {
      for (const std::string_view key : fault.keys)
        text += std::string(key) + " ";
      text += "- " + fault.message;
    }
    return text;
  };
  for (const SearchKind kind : not_empty(all_searches()))
    EXPECT_EQ(faults(options_of(kind)), "") << name_of(kind);
  FRaceOptions race;
  race.configurations = 1;
  EXPECT_EQ(faults(race),
            "configurations - `configurations` must be 0 (automatic) or at least 2, not 1");
  race.configurations = 2;
  EXPECT_EQ(faults(race), "");
  EvolutionOptions evolution;
  evolution.elites = 0.3;
  EXPECT_EQ(faults(evolution),
            "elites parents - `elites` (0.3) must be at most `parents` (0.2): each elite is also a "
            "parent");
}

TEST_P(EverySearch, RefusesGivenConfigurationsThatAreNotInTheSpace) {
  Scenario scenario;
  scenario.max_experiments = 3000;
  std::vector<Configuration> given(2, Configuration(2));
  for (std::size_t i = 0; i < given.size(); ++i) {
    given[i].set(0, static_cast<double>(i));
    given[i].set(1, -5);
  }
  EXPECT_EQ(complaint_of(start_search(weights_space(2), scenario, options_of(GetParam()), given)),
            "");
  given[1].set(1, -5.5);
  EXPECT_THAT(complaint_of(start_search(weights_space(2), scenario, options_of(GetParam()), given)),
              HasSubstr("w1: -5.5 is not in its domain (-5, 5)"));
}

TEST_P(EverySearch, HasNoConfigurationThatItDidNotMake) {
  auto search = started(weights_space(3), options_of(GetParam()), 3000);
  std::int64_t last = 0;
  for (const ConfigurationSampled& sampled : only<ConfigurationSampled>(search->take_events())) {
    EXPECT_EQ(sampled.id, ++last);
    EXPECT_EQ(search->configuration(last), sampled.configuration);
  }
  ASSERT_GT(last, 1);
  EXPECT_THROW(search->configuration(0), std::out_of_range);
  EXPECT_THROW(search->configuration(last + 1), std::out_of_range);
}

/// Whatever the options of searches say: here the ablation lacks its two configurations.
TEST(Search, IsAnAblationIfTheScenarioSaysSo) {
  Scenario scenario;
  scenario.max_experiments = 3000;
  scenario.ablation = AblationType::Full;
  const std::string refused = complaint_of(start_ablation(weights_space(2), scenario, {}));
  EXPECT_FALSE(refused.empty());
  for (const SearchKind kind : not_empty(all_searches()))
    EXPECT_EQ(complaint_of(start_search(weights_space(2), scenario, options_of(kind))), refused);
}

TEST(Search, OptionsOfRacesAreRefusedByTheOthers) {
  for (const SearchKind kind : not_empty(all_searches())) {
    if (words_of(kind).has_tests) continue;
    Scenario scenario;
    scenario.max_experiments = 5000;
    const auto refused = [&](const char* option, void (*change)(Scenario&)) {
      Scenario changed = scenario;
      change(changed);
      EXPECT_EQ(complaint_of(start_search(weights_space(3), changed, options_of(kind))),
                std::string(option) + ": works only with irace and f-race, not with " +
                    std::string(name_of(kind)));
    };
    refused("deterministic", [](Scenario& s) { s.deterministic = true, s.n_instances = 9; });
    refused("bound_max", [](Scenario& s) { s.bound_max = 3; });
    refused("bound_max", [](Scenario& s) { s.bound_max = 3, s.capping = true; });
    refused("target_evaluator", [](Scenario& s) { s.target_evaluator = true; });
    refused("max_time", [](Scenario& s) { s.max_experiments = 0, s.max_time = 900; });
    const Repair repair = [](const Configuration& same) -> Expected<Configuration> { return same; };
    EXPECT_EQ(complaint_of(start_search(weights_space(3), scenario, options_of(kind), {}, repair)),
              words_of(kind).takes_repairs
                  ? ""
                  : "repair_configuration: is for irace, f-race and random: the search " +
                        std::string(name_of(kind)) +
                        " continues from what it made itself, not from what was repaired");
  }
}

TEST(Search, OfWeightsAloneSaysWhatItCannotUse) {
  Scenario scenario;
  scenario.max_experiments = 5000;
  const auto log = Real{1.0, 5.0, true};
  const auto name = [](const char* of) { return Expression::parameter(of); };
  const auto is_high = Expression::call(Operation::Greater, {name("r"), Expression::number(0)});
  const std::vector<std::pair<Parameter, const char*>> strange = {
      {{"w", "", Categorical{{"a", "b"}}, {}}, "is not a real number"},
      {{"w", "", Integer{0.0, 5.0}, {}}, "is not a real number"},
      {{"w", "", Real{0.0, 1.0}, is_high}, "has a condition"},
      {{"w", "", log, {}}, "is logarithmic"},
      {{"w", "", Real{0.0, name("r")}, {}}, "has a range that depends on others"}};
  for (const SearchKind kind : not_empty(all_searches())) {
    if (!words_of(kind).wants_reals) continue;
    for (const auto& [parameter, why] : strange) {
      const ParameterSpace space =
          ParameterSpace::make({{"r", "", Real{1.0, 2.0}, {}}, parameter}, {}, 4).value();
      EXPECT_EQ(complaint_of(start_search(space, scenario, options_of(kind))),
                "w: the search " + std::string(name_of(kind)) +
                    " needs reals without conditions, such as the weights of networks, and this "
                    "parameter " +
                    why);
    }
  }
}

TEST_P(EverySearch, KeepsToWhatIsNotForbiddenOrSaysThatItCannot) {
  Scenario scenario;
  scenario.max_experiments = 3000;
  scenario.n_instances = 1;
  Configuration given(2);
  given.set(0, -1);
  given.set(1, 1);
  auto search = start_search(space_with_forbidden(), scenario, options_of(GetParam()), {given});
  if (words_of(GetParam()).wants_reals) {
    ASSERT_FALSE(search);
    EXPECT_EQ(to_string(search.error()),
              "forbidden: the search " + std::string(name_of(GetParam())) +
                  " makes weights one by one, and would not keep to forbidden combinations");
    return;
  }
  ASSERT_TRUE(search) << to_string(search.error());
  play(**search, [](const Configuration& configuration, const Experiment& experiment) {
    EXPECT_GT(configuration[0], 0);
    return noisy_sphere(configuration, experiment);
  });
}

}  // namespace
}  // namespace swarmsmith
