#include "irace_core/ablation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "base/plain_text.h"
#include "base/rng.h"
#include "irace_core/internal/instances.h"
#include "irace_core/internal/race.h"
#include "irace_core/internal/ranking.h"

namespace swarmsmith {
namespace {

/// Sets one parameter to its value in `target`; nothing when the values do not fit together.
std::optional<AblationChange> change(const ParameterSpace& space, const Configuration& current,
                                     const Configuration& target, std::size_t parameter) {
  // A parameter that is inactive in one of the two has no value to change: it follows the
  // parameters that its condition mentions.
  if (!current.is_active(parameter) || !target.is_active(parameter)) return std::nullopt;
  AblationChange made{Configuration(), {parameter}};
  Assignment values(space);
  // In hierarchy order, so that the parameters that a condition mentions have their new values
  // already (irace facts, 8.1).
  for (const std::size_t i : space.hierarchy_order()) {
    const bool was_active = current.is_active(i);
    const bool is_active = space.is_active(i, values);
    const bool is_new = i == parameter || (is_active && !was_active);
    if (is_active) {
      const Configuration& from = is_new ? target : current;
      if (from.is_active(i)) values.set(i, from[i]);
    }
    if (i != parameter && is_active != was_active) made.changed.push_back(i);
  }
  made.configuration = values.configuration();
  // A dependent domain may exclude a value that is kept, and a forbidden clause may exclude the
  // combination.
  if (!space.check(made.configuration) || space.is_forbidden(made.configuration)) {
    return std::nullopt;
  }
  return made;
}

}  // namespace

std::vector<std::size_t> differences(const Configuration& a, const Configuration& b) {
  std::vector<std::size_t> different;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool equal = a.is_active(i) == b.is_active(i) && (!a.is_active(i) || a[i] == b[i]);
    if (!equal) different.push_back(i);
  }
  return different;
}

std::vector<AblationChange> ablation_changes(const ParameterSpace& space,
                                             const Configuration& current,
                                             const Configuration& target,
                                             std::span<const std::size_t> open) {
  std::vector<AblationChange> changes;
  for (const std::size_t parameter : open) {
    if (current.is_active(parameter) && target.is_active(parameter) &&
        current[parameter] == target[parameter])
      continue;
    if (auto made = change(space, current, target, parameter)) changes.push_back(std::move(*made));
  }
  return changes;
}

std::vector<std::size_t> change_between(const ParameterSpace& space, const Configuration& before,
                                        const Configuration& after, const Configuration& target) {
  const auto open = differences(before, target);
  // The last step may change all remaining parameters at once (see Ablation::go_on).
  if (after == target) return open;
  for (AblationChange& made : ablation_changes(space, before, target, open)) {
    if (made.configuration == after) return std::move(made.changed);
  }
  return differences(before, after);
}

std::int64_t most_ablation_runs(const Configuration& source, const Configuration& target,
                                std::int64_t pairs) {
  // The source, the target, and for each step with n open parameters at most n changes.
  const auto open = static_cast<std::int64_t>(differences(source, target).size());
  return (1 + open * (open + 1) / 2) * pairs;
}

namespace {

class Ablation final : public Search {
 public:
  Ablation(ParameterSpace space, const Scenario& scenario, const Configuration& source,
           Configuration target)
      : space_(std::move(space)),
        scenario_(scenario),
        target_(std::move(target)),
        // A stream of its own, so the pairs are others than those of a race with the same seed.
        pairs_(one_by_one(scenario), Rng(scenario.seed).split("ablation")),
        // The source, and at most one step for each differing parameter. The last of them makes the
        // target.
        planned_(static_cast<std::int64_t>(differences(source, target_).size()) + 1) {
    pairs_.extend_to(scenario.ablation_pairs);
    begin({source});
  }

  bool finished() const override { return !race_; }
  const std::optional<Error>& failure() const override { return failure_; }
  std::span<const Experiment> wanted() const override { return wanted_; }
  std::vector<Experiment> ahead(std::int64_t) const override { return {}; }
  void tell(std::span<const Measurement> measurements) override;
  std::vector<std::int64_t> alive() const override {
    return race_ ? race_->alive_ids() : std::vector<std::int64_t>();
  }
  std::vector<RaceEvent> take_events() override { return std::exchange(events_, {}); }

  Expected<void> extend(std::int64_t) override { return Unexpected(no_extension()); }
  Expected<std::int64_t> least_extension() const override { return Unexpected(no_extension()); }

  const Configuration& configuration(std::int64_t id) const override {
    return members_.at(static_cast<std::size_t>(id - 1)).configuration;
  }
  const ParameterSpace& space() const override { return space_; }
  std::span<const Elite> elites() const override { return elites_; }
  std::int64_t experiments_used() const override { return used_ + (race_ ? race_->used() : 0); }
  std::int64_t budget() const override { return scenario_.max_experiments; }
  std::int64_t iteration() const override { return iteration_; }
  std::int64_t n_iterations() const override { return planned_; }
  std::int64_t n_alive() const override {
    return race_ ? static_cast<std::int64_t>(race_->alive_count()) : 0;
  }

 private:
  struct Member {
    Configuration configuration;
    std::vector<double> costs;  ///< by pair; NaN if it was not run on that pair
  };

  /// As in R's ablation, instances are shuffled one by one, independently of the block size of
  /// races.
  static Scenario one_by_one(Scenario scenario) {
    scenario.block_size = 1;
    return scenario;
  }

  static Error no_extension() {
    return {ErrorKind::BadInput, "an ablation ends at its target: there is nothing to extend", ""};
  }

  Member& member(std::int64_t id) { return members_[static_cast<std::size_t>(id - 1)]; }

  /// Whether this iteration is a step; in the others, the source or the target is run on all pairs.
  bool is_step() const { return iteration_ > 1 && !(members_.back().configuration == target_); }

  void begin(std::vector<Configuration> configurations);
  irace::RaceSettings settings(std::int64_t count) const;
  void ask();
  void report_steps();
  void end_iteration();
  /// The id of the best change of the race; nothing when all were rejected.
  std::optional<std::int64_t> best() const;
  std::vector<double> ranks(std::span<const std::int64_t> ids) const;
  Elite elite(std::int64_t id, double rank) const;
  void go_on();
  void finish(std::string reason);

  ParameterSpace space_;
  Scenario scenario_;
  Configuration target_;
  irace::InstanceLog pairs_;
  std::vector<Member> members_;     ///< by id
  std::vector<std::int64_t> path_;  ///< ids of the configurations chosen so far
  std::unique_ptr<irace::Race> race_;
  std::vector<Experiment> wanted_;
  /// By configuration and pair: costs that are in no step of the race yet.
  std::map<std::pair<std::int64_t, std::int64_t>, double> told_;
  std::vector<RaceEvent> events_;
  std::vector<Elite> elites_;
  std::optional<Error> failure_;
  std::int64_t planned_;
  std::int64_t iteration_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t used_ = 0;  ///< runs before the current race
};

void Ablation::begin(std::vector<Configuration> configurations) {
  const auto count = static_cast<std::int64_t>(configurations.size());
  const std::int64_t parent = path_.empty() ? 0 : path_.back();
  ++iteration_;
  events_.emplace_back(IterationStarted{
      .iteration = iteration_,
      .n_iterations = planned_,
      .remaining = budget() - used_,
      .budget = count * scenario_.ablation_pairs,
      .n_configurations = count,
      .new_pairs = iteration_ == 1 ? scenario_.ablation_pairs : 0,
      .elites = path_.empty() ? std::vector<std::int64_t>() : std::vector{parent}});
  std::vector<irace::Contestant> contestants;
  // Each race begins without results: the changes of a step are new configurations, and the one
  // from which they are made does not run again.
  for (Configuration& configuration : configurations) {
    const auto id = static_cast<std::int64_t>(members_.size()) + 1;
    events_.emplace_back(ConfigurationSampled{id, parent, iteration_, configuration});
    members_.push_back({std::move(configuration),
                        std::vector<double>(static_cast<std::size_t>(scenario_.ablation_pairs),
                                            std::numeric_limits<double>::quiet_NaN())});
    contestants.push_back({id, {}, {}});
  }
  race_ = std::make_unique<irace::Race>(settings(count), std::move(contestants));
  ask();
}

irace::RaceSettings Ablation::settings(std::int64_t count) const {
  // A single configuration has no rival, so the source and the target run on all pairs.
  const bool races = scenario_.ablation == AblationType::Racing && count > 1;
  const std::int64_t pairs = scenario_.ablation_pairs;
  irace::RaceSettings settings{
      .elitist = false,
      .test_type = test_type_of(scenario_),
      // With `Full` no test comes before the last pair, and best() ignores what the last test
      // drops.
      .first_test = races ? scenario_.first_test * scenario_.block_size : pairs,
      .pairs_between_tests = scenario_.each_test * scenario_.block_size,
      .block_size = scenario_.block_size,
      .confidence = scenario_.confidence,
      // 1 would stop a race of one configuration before its first run (irace facts, 9.3.2 a).
      .min_survival = races ? 1 : 0,
      .max_experiments = count * pairs,
      .target_evaluator = scenario_.target_evaluator,
      .bound_max = scenario_.bound_max,
      .min_measurable_time = scenario_.min_measurable_time};
  settings.pairs.resize(static_cast<std::size_t>(pairs));
  std::iota(settings.pairs.begin(), settings.pairs.end(), std::int64_t{1});
  return settings;
}

void Ablation::ask() {
  wanted_.clear();
  const auto runs = race_->wanted();
  for (const irace::RaceRun& run : runs) {
    const std::int64_t pair = race_->pair_of(run.task);
    Experiment& experiment =
        wanted_.emplace_back(Experiment{.configuration = race_->contestant(run.column).id,
                                        .pair = pair,
                                        .instance = pairs_[pair].instance,
                                        .seed = pairs_[pair].seed,
                                        .bound = run.bound,
                                        .is_evaluation = run.is_evaluation});
    if (run.is_evaluation)
      experiment.task = steps_ + 1 + static_cast<std::int64_t>(run.task - runs.front().task);
  }
}

void Ablation::tell(std::span<const Measurement> measurements) {
  if (measurements.size() != wanted_.size())
    throw std::invalid_argument("an ablation must get a cost for each run that it wants");
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const Experiment& run = wanted_[i];
    // With a targetEvaluator the cost of a run is not known before its call (irace facts, 18.4).
    if (run.is_evaluation != scenario_.target_evaluator) continue;
    if (std::isnan(measurements[i].cost)) throw std::invalid_argument("a cost is not a number");
    told_[{run.configuration, run.pair}] = measurements[i].cost;
  }
  race_->tell(measurements);
  report_steps();
  if (race_->finished()) {
    end_iteration();
  } else {
    ask();
  }
}

void Ablation::report_steps() {
  for (RaceStep& step : race_->take_steps()) {
    // A race asks for several pairs at once. Runs that it does not count, since their configuration
    // was rejected before or the race ended, are in no step, and have no cost here either.
    for (const auto& [id, pair] : step.evaluated) {
      const auto told = told_.extract({id, pair});
      SWARMSMITH_ASSERT(!told.empty(), "each run of a step has a cost");
      member(id).costs[static_cast<std::size_t>(pair - 1)] = told.mapped();
    }
    step.iteration = iteration_;
    step.experiments_used += used_;
    Digest digest;
    digest.add(step.digest);
    digest.add(step.experiments_used);
    step.digest = digest.value64();
    ++steps_;
    events_.emplace_back(std::move(step));
  }
}

void Ablation::end_iteration() {
  wanted_.clear();
  told_.clear();
  used_ += race_->used();
  if (race_->failure()) {
    failure_ = race_->failure();
    return finish(failure_->message);
  }
  // If all changes of a step are rejected, the path has no next configuration. Source and target
  // stay on the path, since the user asked for them.
  const auto found = best();
  if (!found && is_step()) {
    failure_ =
        Error{ErrorKind::BadInput,
              "the target rejected all changes of step " + std::to_string(iteration_ - 1), ""};
    return finish(failure_->message);
  }
  path_.push_back(found.value_or(static_cast<std::int64_t>(members_.size())));
  const bool is_over = path_.size() > 1 && configuration(path_.back()) == target_;
  elites_ = {elite(path_.back(), 1)};
  // The configurations of the path were run in different races, but on the same pairs, so overall
  // ranks can compare them (irace facts, 11).
  if (is_over) {
    elites_.clear();
    const std::vector<double> overall = ranks(path_);
    for (std::size_t i = 0; i < path_.size(); ++i)
      elites_.push_back(elite(path_[i], overall[i]));
    std::ranges::stable_sort(elites_, {}, &Elite::rank);
  }
  events_.emplace_back(
      IterationEnded{iteration_, used_, budget() - used_, race_->stop_reason(), elites_});
  if (is_over) return finish("the target is reached");
  go_on();
}

std::optional<std::int64_t> Ablation::best() const {
  // As in R, all changes are ranked, including those that the last test dropped.
  std::vector<std::int64_t> ids;
  for (std::size_t column = 0; column < race_->size(); ++column) {
    if (!race_->is_rejected(column)) ids.push_back(race_->contestant(column).id);
  }
  if (ids.empty()) return std::nullopt;
  const std::vector<double> overall = ranks(ids);
  return ids[static_cast<std::size_t>(std::ranges::min_element(overall) - overall.begin())];
}

std::vector<double> Ablation::ranks(std::span<const std::int64_t> ids) const {
  std::vector<std::vector<double>> costs;
  for (const std::int64_t id : ids)
    costs.push_back(members_[static_cast<std::size_t>(id - 1)].costs);
  return irace::overall_ranks(costs, test_type_of(scenario_));
}

Elite Ablation::elite(std::int64_t id, double rank) const {
  // Source and target are part of the path even when they are rejected.
  Elite found{.rank = rank, .configuration = id};
  for (const double cost : members_[static_cast<std::size_t>(id - 1)].costs) {
    if (!std::isfinite(cost)) continue;
    found.mean += cost;
    ++found.n;
  }
  if (found.n > 0) found.mean /= static_cast<double>(found.n);
  return found;
}

void Ablation::go_on() {
  const Configuration& current = configuration(path_.back());
  const auto open = differences(current, target_);
  auto changes = ablation_changes(space_, current, target_, open);
  // The target is next if it is one change away, or if no single change is possible: then all
  // remaining parameters change together.
  if (open.size() < 2 || changes.empty() || changes.front().configuration == target_)
    return begin({target_});
  std::vector<Configuration> next;
  for (AblationChange& change : changes)
    next.push_back(std::move(change.configuration));
  begin(std::move(next));
}

void Ablation::finish(std::string reason) {
  race_.reset();
  if (failure_) elites_.clear();
  events_.emplace_back(RaceFinished{std::move(reason), elites_});
}

}  // namespace

Expected<std::unique_ptr<Search>> start_ablation(ParameterSpace space, const Scenario& scenario,
                                                 const std::vector<Configuration>& ends) {
  if (auto checked = check(scenario); !checked) return Unexpected(checked.error());
  if (ends.size() != 2)
    return bad_input("needs two given configurations, and has " + std::to_string(ends.size()),
                     "ablation");
  for (const Configuration& end : ends) {
    if (auto checked = space.check(end); !checked) return Unexpected(checked.error());
  }
  if (scenario.ablation_pairs < 1) {
    return bad_input("is " + std::to_string(scenario.ablation_pairs) + ": an ablation needs a pair",
                     "ablation_pairs");
  }
  if (ends[0] == ends[1]) return bad_input("its two configurations are the same", "ablation");
  if (scenario.deterministic && scenario.ablation_pairs > scenario.n_instances) {
    return bad_input("is " + std::to_string(scenario.ablation_pairs) + ", and there " +
                         (scenario.n_instances == 1 ? "is " : "are ") +
                         counted(scenario.n_instances, "instance") +
                         ", and each is used once (deterministic)",
                     "ablation_pairs");
  }
  const std::int64_t most = most_ablation_runs(ends[0], ends[1], scenario.ablation_pairs);
  if (scenario.max_experiments < most) {
    return bad_input("a budget of " + counted(scenario.max_experiments, "experiment") +
                         " is too small for this ablation: it must be at least " +
                         std::to_string(most),
                     "max_experiments");
  }
  return std::make_unique<Ablation>(std::move(space), scenario, ends[0], ends[1]);
}

}  // namespace swarmsmith
