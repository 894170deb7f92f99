#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/race.h"

namespace swarmsmith::irace {
namespace {

/// The reason why a rule ended the race, with both sides of its comparison.
std::string compared(const char* what, std::int64_t left, const char* sign, const char* other,
                     std::int64_t right) {
  return std::string(what) + " (" + std::to_string(left) + ") " + sign + " " + other + " (" +
         std::to_string(right) + ")";
}

/// The mean of the first `tasks` values.
double mean_of_first(const std::vector<double>& values, std::size_t tasks) {
  SWARMSMITH_ASSERT(tasks > 0 && tasks <= values.size(),
                    "the configuration was run on all these tasks");
  double sum = 0;
  for (std::size_t task = 0; task < tasks; ++task)
    sum += values[task];
  return sum / static_cast<double>(tasks);
}

}  // namespace

bool Race::has_result(std::size_t column, std::size_t task) const {
  return task < costs_[column].size() && !std::isnan(costs_[column][task]);
}

bool Race::any_protected(const Progress& progress) const {
  return std::any_of(alive_.begin(), alive_.end(),
                     [&](std::size_t c) { return progress.protection[c] > 0; });
}

std::vector<std::size_t> Race::to_run(const Progress& progress) const {
  std::vector<std::size_t> columns;
  for (const std::size_t c : alive_) {
    if (!has_result(c, progress.task)) columns.push_back(c);
  }
  return by_id(std::move(columns));
}

/// The canonical order within a task is by id; in the order of the columns the elites are sorted by
/// rank.
std::vector<std::size_t> Race::by_id(std::vector<std::size_t> columns) const {
  std::sort(columns.begin(), columns.end(),
            [&](std::size_t a, std::size_t b) { return contestants_[a].id < contestants_[b].id; });
  return columns;
}

bool Race::is_test_point(std::size_t task) const {
  const auto t = static_cast<std::int64_t>(task);
  return t >= settings_.first_test && t % settings_.pairs_between_tests == 0;
}

/// The first sentences of rule 9.3.2 of irace facts. An alive configuration must have a result on
/// each new pair and each past pair, and the number of results of every alive configuration must be
/// a multiple of the steps between tests.
bool Race::elites_are_done(const Progress& progress) const {
  if (settings_.past_pairs == 0) return true;  // the first race, or a race without elitism
  if (progress.task < uncovered_) return false;
  return std::all_of(alive_.begin(), alive_.end(), [&](std::size_t c) {
    return progress.results[c] % settings_.pairs_between_tests == 0;
  });
}

std::optional<std::string> Race::reason_to_stop(const Progress& progress, std::size_t runs) const {
  if (elites_are_done(progress)) {
    if (auto reason = rule_to_stop(progress, runs)) return reason;
  }
  // A race may exceed its share for pairs that elites miss, but not the whole budget.
  const std::int64_t next_task = progress.used + static_cast<std::int64_t>(runs);
  if (next_task > settings_.experiments_left) {
    return compared("experiments of the next task", next_task, ">", "budget that is left",
                    settings_.experiments_left);
  }
  return std::nullopt;
}

std::optional<std::string> Race::rule_to_stop(const Progress& progress, std::size_t runs) const {
  const auto alive = static_cast<std::int64_t>(alive_.size());
  if (alive <= settings_.min_survival) {  // 9.3.2 a
    return compared("configurations alive", alive, "<=", "those that survive",
                    settings_.min_survival);
  }
  const std::int64_t next_test =
      progress.used + static_cast<std::int64_t>(runs) * settings_.pairs_between_tests;
  // 9.3.2 b. A race that cannot pay for the next test would spend runs without effect.
  if (is_test_point(progress.task) && next_test > settings_.max_experiments) {
    return compared("experiments up to the next test", next_test, ">", "budget of the race",
                    settings_.max_experiments);
  }
  // 9.3.2 c.
  if (settings_.elitist && settings_.elitist_limit > 0 &&
      tests_without_drop_ >= settings_.elitist_limit) {
    return compared("tests without elimination", tests_without_drop_, ">=", "limit",
                    settings_.elitist_limit);
  }
  return std::nullopt;
}

/// Counts a task on which the columns `ran` (ascending) were run; protected elites that were not
/// run have used up a known pair (rules 9.3.1 and 9.3.4 of irace facts). Protection never
/// increases: after the last past pair no column is protected.
void Race::pass(Progress& progress, std::span<const std::size_t> ran) const {
  SWARMSMITH_ASSERT(std::ranges::is_sorted(ran), "binary search needs ascending columns");
  for (const std::size_t c : alive_) {
    if (contains(ran, c)) {
      ++progress.results[c];
    } else if (progress.protection[c] > 0) {
      --progress.protection[c];
    }
  }
  progress.used += static_cast<std::int64_t>(ran.size());
  ++progress.task;
}

/// Asks for all runs that are due, and, if nothing that follows depends on them, for all runs up to
/// the next test, assuming that none of them is a rejection. `ahead` is the future value of
/// `progress_`, so that the stopping rules already give the answer that they will give then.
void Race::plan() {
  SWARMSMITH_ASSERT(open_ && wanted_.empty(), "a batch is planned when the last one was answered");
  for (const std::size_t c : open_->due) {
    wanted_.push_back({progress_.task, c, open_->bounds[c], open_->evaluates});
  }
  if (!asks_ahead()) return;
  Progress ahead = progress_;
  std::vector<std::size_t> columns = open_->due;
  while (columns.empty() || !is_test_point(ahead.task + 1)) {
    std::sort(columns.begin(), columns.end());
    pass(ahead, columns);
    if (ahead.task == settings_.pairs.size()) return;
    columns = to_run(ahead);
    if (!columns.empty() && reason_to_stop(ahead, columns.size())) return;
    for (const std::size_t c : columns)
      wanted_.push_back({ahead.task, c, settings_.bound_max, false});
  }
}

bool Race::asks_ahead() const {
  return !settings_.one_task_at_a_time && !settings_.target_evaluator && !settings_.capping;
}

std::vector<RaceRun> Race::ahead(std::int64_t pairs) const {
  std::vector<RaceRun> runs;
  if (stop_ || wanted_.empty() || !asks_ahead()) return runs;
  const std::size_t last_wanted = wanted_.back().task;
  Progress ahead = progress_;
  std::vector<std::size_t> columns = open_->due;
  while (pairs > 0) {
    std::sort(columns.begin(), columns.end());
    pass(ahead, columns);
    if (ahead.task == settings_.pairs.size()) return runs;
    columns = to_run(ahead);
    if (ahead.task <= last_wanted || columns.empty()) continue;
    if (reason_to_stop(ahead, columns.size())) return runs;
    for (const std::size_t c : columns)
      runs.push_back({ahead.task, c, settings_.bound_max, false});
    --pairs;
  }
  return runs;
}

void Race::set_bounds() {
  OpenTask& task = *open_;
  if (task.due.empty() || settings_.bound_max <= 0) return;
  task.step.bound = settings_.bound_max;
  // These runs of protected elites give the time that determines the bounds of the others.
  const bool elites = progress_.protection[task.due.front()] > 0;
  const std::optional<double> standard = settings_.capping && !elites ? elite_time() : std::nullopt;
  if (standard) task.step.bound = std::min(*standard, settings_.bound_max);
  for (const std::size_t c : task.due) {
    double& bound = task.bounds[c];
    bound = settings_.bound_max;
    if (!standard) continue;
    if (settings_.bound_type == BoundType::Instance) {
      bound = instance_bound(*standard, settings_.time_rules());
      continue;
    }
    SWARMSMITH_ASSERT(times_[c].size() >= progress_.task, "those alive have run every task");
    double spent = 0;
    for (std::size_t before = 0; before < progress_.task; ++before)
      spent += times_[c][before];
    bound = candidate_bound(*task.step.bound, progress_.task + 1, spent, settings_.time_rules());
  }
  SWARMSMITH_ASSERT(
      std::ranges::all_of(task.due, [&](std::size_t c) { return task.bounds[c] > 0; }),
      "each bound is above 0, which would mean no bound");
}

std::optional<double> Race::elite_time() const {
  std::vector<double> times;
  for (const std::size_t c : alive_) {
    if (progress_.protection[c] == 0) continue;
    SWARMSMITH_ASSERT(times_[c].size() > progress_.task, "the elites are run before the others");
    times.push_back(settings_.bound_type == BoundType::Instance
                        ? times_[c][progress_.task]
                        : mean_of_first(times_[c], progress_.task + 1));
  }
  if (times.empty()) return std::nullopt;
  return summarise(std::move(times), settings_.capping_type);
}

}  // namespace swarmsmith::irace
