#include "irace_core/search/search_loop.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "base/assert.h"

namespace swarmsmith::search {

SearchLoop::SearchLoop(std::unique_ptr<const ParameterSpace> space, const Scenario& scenario,
                       std::unique_ptr<Strategy> strategy)
    : space_(std::move(space)),
      scenario_(scenario),
      strategy_(std::move(strategy)),
      instances_(scenario, Rng(scenario.seed).split("instances")) {}

Expected<std::unique_ptr<Search>> SearchLoop::start(std::unique_ptr<const ParameterSpace> space,
                                                    const Scenario& scenario,
                                                    std::unique_ptr<Strategy> strategy) {
  std::unique_ptr<SearchLoop> loop(new SearchLoop(std::move(space), scenario, std::move(strategy)));
  if (auto asked = loop->ask(); !asked) return Unexpected(asked.error());
  return loop;
}

Expected<void> SearchLoop::ask() {
  Digest digest;
  strategy_->add_to(digest);
  // A step has the digest of the state before its round and of the costs, so that a replay finds
  // the first step that differs (decision 3).
  round_digest_ = digest.value64();
  auto next = strategy_->next(static_cast<std::int64_t>(configurations_.size()) + 1);
  if (!next) return Unexpected(next.error());
  wanted_.clear();
  if (!*next) {
    stop();
    return {};
  }
  round_ = std::move(**next);
  SWARMSMITH_ASSERT(used_ + static_cast<std::int64_t>(round_.runs.size()) <= budget(),
                    "a search keeps to its budget");
  // The event of the iteration comes before those of its configurations.
  if (round_.start) begin_iteration(*round_.start);
  for (Newcomer& newcomer : round_.newcomers) {
    configurations_.emplace_back(newcomer.configuration);
    events_.emplace_back(
        ConfigurationSampled{.id = static_cast<std::int64_t>(configurations_.size()),
                             .parent = newcomer.parent,
                             .iteration = iteration_,
                             .configuration = std::move(newcomer.configuration)});
  }
  std::set<std::int64_t> alive;
  wanted_.reserve(round_.runs.size());
  for (const auto& [id, pair] : round_.runs) {
    SWARMSMITH_ASSERT(id >= 1 && id <= static_cast<std::int64_t>(configurations_.size()),
                      "a round runs existing configurations");
    // Pairs are made as they are needed: a strategy says only their numbers.
    instances_.extend_to(pair);
    wanted_.push_back({.configuration = id,
                       .pair = pair,
                       .instance = instances_[pair].instance,
                       .seed = instances_[pair].seed});
    alive.insert(id);
  }
  // Until the costs arrive, all configurations of the round are alive.
  alive_.assign(alive.begin(), alive.end());
  return {};
}

void SearchLoop::begin_iteration(const Round::Start& start) {
  ++iteration_;
  steps_ = 0;
  std::set<std::int64_t> ids;
  std::int64_t last_pair = pairs_seen_;
  for (const auto& [id, pair] : round_.runs) {
    ids.insert(id);
    last_pair = std::max(last_pair, pair);
  }
  events_.emplace_back(IterationStarted{.iteration = iteration_,
                                        .n_iterations = n_iterations(),
                                        .remaining = budget() - used_,
                                        .budget = start.budget,
                                        .n_configurations = static_cast<std::int64_t>(ids.size()),
                                        .new_pairs = last_pair - pairs_seen_,
                                        .elites = start.elites,
                                        .postselection = start.is_final,
                                        .model_digest = iteration_ == 1 ? 0 : round_digest_});
}

void SearchLoop::tell(std::span<const Measurement> measurements) {
  if (measurements.size() != wanted_.size()) {
    throw std::invalid_argument("tell() takes the costs of all wanted experiments");
  }
  std::vector<double> costs;
  costs.reserve(measurements.size());
  for (const Measurement& measurement : measurements) {
    // NaN is an error of the target, and no rejection (irace facts, 12).
    if (std::isnan(measurement.cost)) throw std::invalid_argument("a cost is not a number");
    costs.push_back(measurement.cost);
  }
  // Steps are reported before the decision: they have the number of configurations that were alive
  // during the runs.
  report_steps(costs);
  Verdict verdict = strategy_->take(costs);
  alive_ = std::move(verdict.alive);
  SWARMSMITH_ASSERT(std::ranges::is_sorted(alive_), "binary search needs ascending ids");
  if (verdict.ended) {
    verdict.ended->iteration = iteration_;
    verdict.ended->used = used_;
    verdict.ended->remaining = budget() - used_;
    // The strategy may continue from rejected configurations if it has no others.
    std::erase_if(verdict.ended->elites, [](const Elite& elite) { return std::isinf(elite.mean); });
    elites_ = verdict.ended->elites;
    events_.emplace_back(std::move(*verdict.ended));
    // Configurations that are no longer alive are seldom looked at again.
    for (const Experiment& run : wanted_) {
      if (!std::ranges::binary_search(alive_, run.configuration))
        configurations_[static_cast<std::size_t>(run.configuration - 1)].put_away();
    }
  }
  if (auto asked = ask(); !asked) {
    failure_ = asked.error();
    stop();
  }
}

void SearchLoop::report_steps(std::span<const double> costs) {
  std::size_t first = 0;
  for (std::size_t i = 1; i <= wanted_.size(); ++i) {
    const bool is_end =
        i == wanted_.size() || (!round_.is_one_step && wanted_[i].pair != wanted_[first].pair);
    if (!is_end) continue;
    report_step(first, i, costs);
    first = i;
  }
}

void SearchLoop::report_step(std::size_t first, std::size_t end, std::span<const double> costs) {
  const auto count = static_cast<std::int64_t>(end - first);
  // All runs count here, also those of a configuration that was rejected in the same round.
  used_ += count;
  // The best so far in this round; as in races, 0 if all were rejected.
  Scored best = ranked(std::span(round_.runs).first(end), costs.first(end)).front();
  if (std::isinf(best.mean)) best = {};
  RaceStep step{.iteration = iteration_,
                .task = ++steps_,
                .pair = wanted_[end - 1].pair,
                .alive_before = n_alive(),
                .alive_after = n_alive(),
                .best = best.id,
                .mean_best = best.mean,
                .experiments_used = used_};
  Digest digest;
  digest.add(round_digest_);
  for (std::size_t i = 0; i < end; ++i)
    digest.add(costs[i]);
  step.digest = digest.value64();
  for (std::size_t i = first; i < end; ++i) {
    step.evaluated.emplace_back(wanted_[i].configuration, wanted_[i].pair);
    pairs_seen_ = std::max(pairs_seen_, wanted_[i].pair);
  }
  events_.emplace_back(std::move(step));
}

void SearchLoop::stop() {
  finished_ = true;
  wanted_.clear();
  // A search ends without elites only if all of them were rejected (see tell()).
  if (!failure_ && elites_.empty()) {
    failure_ = Error{ErrorKind::BadInput, "every configuration was rejected", ""};
  }
  if (failure_) elites_.clear();
  events_.emplace_back(RaceFinished{failure_ ? to_string(*failure_) : "the budget is used",
                                    {elites_.begin(), elites_.end()}});
}

Expected<void> SearchLoop::extend(std::int64_t experiments) {
  SWARMSMITH_ASSERT(finished_, "an extension follows the end");
  if (failure_) return Unexpected(*failure_);
  // The strategy refuses what is too small before anything changes.
  if (auto extended = strategy_->extend(experiments); !extended) return extended;
  scenario_.max_experiments += experiments;
  finished_ = false;
  if (auto asked = ask(); !asked) {
    // The elites so far stay. Each further extension fails in the same way.
    failure_ = asked.error();
    finished_ = true;
    wanted_.clear();
    return asked;
  }
  return {};
}

Expected<std::int64_t> SearchLoop::least_extension() const {
  if (failure_) return Unexpected(*failure_);
  return strategy_->least_extension();
}

const Configuration& SearchLoop::configuration(std::int64_t id) const {
  if (id < 1 || id > static_cast<std::int64_t>(configurations_.size()))
    throw std::out_of_range("no configuration " + std::to_string(id));
  return configurations_[static_cast<std::size_t>(id - 1)].get();
}

}  // namespace swarmsmith::search
