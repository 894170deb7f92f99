#include "irace_core/internal/design_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/similarity.h"

namespace swarmsmith {

using irace::EliteLine;
using irace::Race;
using irace::RacePlan;

namespace {

std::int64_t ceil_divide(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

}  // namespace

IteratedRace::State::State(ParameterSpace space_in, Scenario scenario_in,
                           std::vector<Configuration> initial, Repair repair)
    : space(std::move(space_in)),
      scenario(scenario_in),
      repair_(std::move(repair)),
      schedule_(scenario, space.variable_count()),
      models_(space),
      forbidden_(space),
      root_(scenario.seed),
      instances_(scenario.n_instances, scenario.sample_instances, root_.split("instances")) {
  budget = schedule_.total_budget();
  iterations = schedule_.iterations();
  for (Configuration& configuration : initial) {
    const bool allowed = !forbidden_.contains(configuration);
    Candidate given{std::move(configuration), 0, allowed, {}};
    if (allowed) {
      add(std::move(given), 0);
    } else {
      candidates.push_back(std::move(given));
    }
  }
  initial_count_ = static_cast<std::int64_t>(candidates.size());
}

Expected<void> IteratedRace::State::begin() {
  const std::int64_t least = schedule_.minimum_budget();
  if (budget < least) {
    return bad_input("a budget of " + std::to_string(budget) +
                         " experiments is too small: with these settings it must be at least " +
                         std::to_string(least),
                     "max_experiments");
  }
  instances_.append(ceil_divide(budget, schedule_.min_survival()));
  if (auto begun = begin_race(); !begun) return begun;
  if (races_ == 0) {
    return bad_input("not even one race can be run: " +
                     std::get<RaceFinished>(events.back()).reason);
  }
  return {};
}

void IteratedRace::State::tell(std::span<const Measurement> measurements) {
  if (finished) return;
  race->tell(measurements);
  report_steps();
  if (!race->finished()) {
    ask();
    return;
  }
  end_race();
  if (finished) return;
  if (auto begun = begin_race(); !begun) fail(begun.error());
}

Expected<void> IteratedRace::State::begin_race() {
  const std::int64_t remaining = budget - used_before_race;
  const auto next =
      schedule_.next(remaining, static_cast<std::int64_t>(elites.size()), pairs_seen_);
  if (const auto* end = std::get_if<irace::NoMoreRaces>(&next)) {
    stop(end->reason);
    return {};
  }
  const auto& plan = std::get<RacePlan>(next);
  iteration = plan.iteration;
  iterations = plan.iterations;
  IterationStarted started{.iteration = plan.iteration,
                           .n_iterations = plan.iterations,
                           .remaining = remaining,
                           .budget = plan.budget,
                           .n_configurations = 0,
                           .new_pairs = plan.new_pairs,
                           .elites = {},
                           .soft_restart = false,
                           .model_digest = 0};
  for (const Elite& elite : elites)
    started.elites.push_back(elite.configuration);
  // Sampling reports its configurations; the iteration is announced before them.
  const std::size_t place = events.size();
  auto contestants = races_ == 0 ? first_contestants(plan) : later_contestants(plan, started);
  if (!contestants) return Unexpected(contestants.error());
  started.n_configurations = static_cast<std::int64_t>(contestants->size());
  events.insert(events.begin() + static_cast<std::ptrdiff_t>(place), std::move(started));
  ++races_;
  start_race(plan, *contestants);
  return {};
}

Expected<std::vector<std::int64_t>> IteratedRace::State::first_contestants(const RacePlan& plan) {
  std::vector<std::int64_t> ids;
  for (std::int64_t id = 1; id <= initial_count_; ++id) {
    if (candidate(id).takes_part) ids.push_back(id);
  }
  const auto have = static_cast<std::int64_t>(ids.size());
  if (have > plan.configurations) ids.resize(static_cast<std::size_t>(plan.configurations));
  if (have < plan.configurations) {
    Rng rng = root_.split("initial");
    auto sampled = irace::sample_initial(space, forbidden_, plan.configurations - have, rng);
    if (!sampled) return Unexpected(sampled.error());
    for (Configuration& configuration : *sampled) {
      ids.push_back(add({std::move(configuration), 0, true, {}}, plan.iteration));
    }
    sampling_drawn_ = rng.drawn();
  }
  if (static_cast<std::int64_t>(ids.size()) <= schedule_.min_survival()) {
    return bad_input("only " + std::to_string(ids.size()) +
                     " different configurations were found, and a race needs more than " +
                     std::to_string(schedule_.min_survival()));
  }
  return ids;
}

Expected<std::vector<std::int64_t>> IteratedRace::State::later_contestants(
    const RacePlan& plan, IterationStarted& started) {
  const std::vector<EliteLine> lines = elite_lines();
  const std::int64_t wanted_new = plan.configurations - static_cast<std::int64_t>(elites.size());
  if (models_.empty()) models_.initialise(lines);
  models_.update(lines, irace::update_strength(plan.iteration, plan.iterations, wanted_new,
                                               space.variable_count()));
  Rng rng = root_.split("sampling", static_cast<std::uint64_t>(plan.iteration));
  auto sampled = sample_new(wanted_new, rng);
  if (!sampled) return Unexpected(sampled.error());
  if (scenario.soft_restart) {
    const std::vector<std::int64_t> restarted = lines_to_restart(*sampled);
    for (const std::int64_t id : restarted)
      models_.restart(id, wanted_new);
    if (!restarted.empty()) {
      started.soft_restart = true;
      sampled = sample_new(wanted_new, rng);
      if (!sampled) return Unexpected(sampled.error());
    }
  }
  started.model_digest = models_.digest();
  sampling_drawn_ = rng.drawn();
  std::vector<std::int64_t> ids = started.elites;
  for (Candidate& fresh : *sampled)
    ids.push_back(add(std::move(fresh), plan.iteration));
  return ids;
}

Expected<std::vector<Candidate>> IteratedRace::State::sample_new(std::int64_t count, Rng& rng) {
  constexpr int kMostRounds = 100;
  std::vector<Candidate> sampled;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::int64_t missing = count - static_cast<std::int64_t>(sampled.size());
    if (missing == 0) return sampled;
    for (std::int64_t i = 0; i < missing; ++i) {
      const std::int64_t parent = elites[irace::draw_parent(elites.size(), rng)].configuration;
      auto configuration = models_.sample(parent, rng);
      if (!configuration) return Unexpected(configuration.error());
      if (forbidden_.contains(*configuration)) continue;
      sampled.push_back({std::move(*configuration), parent, true, {}});
    }
  }
  if (static_cast<std::int64_t>(sampled.size()) == count) return sampled;
  return bad_input("nearly all that is sampled is forbidden: the constraints are too strict");
}

std::vector<std::int64_t> IteratedRace::State::lines_to_restart(
    const std::vector<Candidate>& sampled) const {
  std::vector<const Configuration*> all;
  std::vector<std::int64_t> owners;
  for (const Elite& elite : elites) {
    all.push_back(&candidate(elite.configuration).configuration);
    owners.push_back(elite.configuration);
  }
  for (const Candidate& fresh : sampled) {
    all.push_back(&fresh.configuration);
    owners.push_back(fresh.parent);
  }
  std::vector<std::int64_t> ids;
  for (const std::size_t i :
       irace::similar_configurations(space, all, scenario.soft_restart_threshold)) {
    ids.push_back(owners[i]);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::vector<EliteLine> IteratedRace::State::elite_lines() const {
  std::vector<EliteLine> lines;
  for (const Elite& elite : elites) {
    const Candidate& known = candidate(elite.configuration);
    lines.push_back({elite.configuration, known.parent, &known.configuration});
  }
  return lines;
}

std::int64_t IteratedRace::State::add(Candidate fresh, std::int64_t in_iteration) {
  const auto id = static_cast<std::int64_t>(candidates.size()) + 1;
  events.emplace_back(ConfigurationSampled{id, fresh.parent, in_iteration, fresh.configuration});
  candidates.push_back(std::move(fresh));
  return id;
}

void IteratedRace::State::start_race(const RacePlan& plan,
                                     const std::vector<std::int64_t>& contestants) {
  const std::int64_t enough = ceil_divide(budget - used_before_race, schedule_.min_survival());
  if (instances_.size() - pairs_seen_ < enough) instances_.append(enough);
  const bool first = races_ == 1;
  const std::int64_t past = first ? 0 : pairs_seen_;
  irace::RaceSettings settings{.test_type = test_type_of(scenario),
                               .first_test = scenario.first_test,
                               .pairs_between_tests = scenario.each_test,
                               .elitist_limit = scenario.elitist_limit,
                               .confidence = scenario.confidence,
                               .min_survival = schedule_.min_survival(),
                               .max_experiments = plan.budget,
                               .pairs = order_of_pairs(plan, past),
                               .new_pairs = plan.new_pairs,
                               .past_pairs = past};
  const auto past_pairs =
      std::span(settings.pairs)
          .subspan(static_cast<std::size_t>(plan.new_pairs), static_cast<std::size_t>(past));
  std::vector<irace::Contestant> all;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const bool is_elite = i < elites.size();
    all.push_back({contestants[i],
                   is_elite ? past_costs(contestants[i], past_pairs) : std::vector<double>{}});
  }
  race = std::make_unique<Race>(std::move(settings), std::move(all));
  report_steps();
  SWARMSMITH_ASSERT(!race->finished(), "a race with a new configuration runs something");
  ask();
}

/// First pairs that nobody has seen, then the past ones, then the other unused ones.
std::vector<std::int64_t> IteratedRace::State::order_of_pairs(const RacePlan& plan,
                                                              std::int64_t past) const {
  std::vector<std::int64_t> order(static_cast<std::size_t>(instances_.size()));
  const auto fresh = order.begin() + static_cast<std::ptrdiff_t>(plan.new_pairs);
  const auto unused = fresh + static_cast<std::ptrdiff_t>(past);
  std::iota(order.begin(), fresh, past + 1);
  std::iota(fresh, unused, std::int64_t{1});
  std::iota(unused, order.end(), past + plan.new_pairs + 1);
  if (scenario.sample_instances) {
    Rng rng = root_.split("order", static_cast<std::uint64_t>(plan.iteration));
    rng.shuffle(std::span(fresh, unused));
  }
  return order;
}

std::vector<double> IteratedRace::State::past_costs(std::int64_t id,
                                                    std::span<const std::int64_t> pairs) const {
  std::vector<double> by_pair(static_cast<std::size_t>(pairs_seen_) + 1,
                              std::numeric_limits<double>::quiet_NaN());
  for (const Candidate::Result& result : candidate(id).results) {
    by_pair[static_cast<std::size_t>(result.pair)] = result.cost;
  }
  std::vector<double> costs;
  for (const std::int64_t pair : pairs)
    costs.push_back(by_pair[static_cast<std::size_t>(pair)]);
  return costs;
}

void IteratedRace::State::ask() {
  wanted.clear();
  for (const irace::RaceRun& run : race->wanted()) {
    const std::int64_t pair = race->pair_of(run.task);
    wanted.push_back({.configuration = race->contestant(run.column).id,
                      .pair = pair,
                      .instance = instances_[pair].instance,
                      .seed = instances_[pair].seed,
                      .bound = run.bound,
                      .is_evaluation = run.is_evaluation});
  }
}

void IteratedRace::State::report_steps() {
  for (RaceStep& step : race->take_steps()) {
    step.iteration = iteration;
    step.experiments_used += used_before_race;
    Digest digest;
    digest.add(step.digest);
    digest.add(step.experiments_used);
    digest.add(instances_.rng().drawn());
    digest.add(sampling_drawn_);
    step.digest = digest.value64();
    events.emplace_back(std::move(step));
  }
}

void IteratedRace::State::end_race() {
  const std::int64_t used = race->used();
  used_before_race += used;
  for (std::size_t column = 0; column < race->size(); ++column) {
    Candidate& known = candidate(race->contestant(column).id);
    if (race->is_rejected(column)) {
      known.takes_part = false;
      forbidden_.add_rejected(known.configuration);
      continue;
    }
    for (const Race::Result& result : race->results(column)) {
      known.results.push_back({result.pair, result.cost});
      pairs_seen_ = std::max(pairs_seen_, result.pair);
    }
  }
  choose_elites();
  const std::string reason = race->stop_reason();
  race.reset();
  events.emplace_back(IterationEnded{iteration, used, budget - used_before_race, reason, elites});
  if (elites.empty()) fail({ErrorKind::BadInput, "every configuration was rejected", ""});
}

/// The survivors by rank, each configuration once, as many as survive (irace facts, 13).
void IteratedRace::State::choose_elites() {
  elites.clear();
  for (const Race::Survivor& survivor : race->survivors()) {
    if (static_cast<std::int64_t>(elites.size()) == schedule_.min_survival()) break;
    const std::int64_t id = race->contestant(survivor.column).id;
    const Candidate& known = candidate(id);
    const bool is_copy = std::any_of(elites.begin(), elites.end(), [&](const Elite& elite) {
      return candidate(elite.configuration).configuration == known.configuration;
    });
    if (is_copy) continue;
    double sum = 0;
    for (const Candidate::Result& result : known.results)
      sum += result.cost;
    const auto n = static_cast<std::int64_t>(known.results.size());
    elites.push_back({survivor.rank, id, sum / static_cast<double>(n), n});
  }
}

void IteratedRace::State::stop(std::string reason) {
  finished = true;
  wanted.clear();
  events.emplace_back(RaceFinished{std::move(reason), elites});
}

void IteratedRace::State::fail(Error error) {
  elites.clear();
  failure = std::move(error);
  stop(to_string(*failure));
}

}  // namespace swarmsmith
