#include "irace_core/internal/race.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "irace_core/expression.h"

namespace swarmsmith::irace {
namespace {

// A cost is never NaN (tell() of a search refuses it), so NaN marks a missing result.
constexpr double kNoResult = std::numeric_limits<double>::quiet_NaN();

void put(std::vector<double>& row, std::size_t task, double value) {
  if (row.size() <= task) row.resize(task + 1, kNoResult);
  row[task] = value;
}

}  // namespace

Race::Race(RaceSettings settings, std::vector<Contestant> contestants)
    : settings_(std::move(settings)),
      contestants_(std::move(contestants)),
      costs_(contestants_.size()),
      times_(contestants_.size()),
      rejected_(contestants_.size(), false),
      ranks_(contestants_.size()),
      quality_(contestants_.size()),
      // Conover's comparison is two-sided (irace facts, 10.1.4).
      quantiles_((1 - settings_.confidence) / 2) {
  SWARMSMITH_ASSERT(!settings_.capping || settings_.bound_max > 0, "capping needs a largest bound");
  SWARMSMITH_ASSERT(settings_.new_pairs >= 0 && settings_.past_pairs >= 0 &&
                        settings_.new_pairs + settings_.past_pairs <=
                            static_cast<std::int64_t>(settings_.pairs.size()),
                    "new and past pairs lead the list");
  SWARMSMITH_ASSERT(settings_.pairs_between_tests >= 1, "the interval between tests is at least 1");
  SWARMSMITH_ASSERT(settings_.block_size >= 1, "a block has a pair");
  const auto new_pairs = static_cast<std::size_t>(settings_.new_pairs);
  for (std::size_t c = 0; c < contestants_.size(); ++c) {
    const std::vector<double>& past = contestants_[c].past;
    const std::vector<double>& past_times = contestants_[c].past_times;
    SWARMSMITH_ASSERT(settings_.elitist || past.empty(), "only elitist races know past results");
    SWARMSMITH_ASSERT(past.empty() || past.size() == static_cast<std::size_t>(settings_.past_pairs),
                      "an elite has a cost, or none, on each past pair");
    SWARMSMITH_ASSERT(!settings_.capping || past.size() == past_times.size(),
                      "capping needs the elites' times");
    alive_.push_back(c);
    for (auto [row, known] : {std::pair{&costs_[c], &past}, {&times_[c], &past_times}}) {
      // New pairs come before past ones (irace facts, 9.1), and no configuration has a result on
      // them.
      if (known->empty()) continue;
      row->assign(new_pairs, kNoResult);
      row->insert(row->end(), known->begin(), known->end());
    }
    // irace facts, 9.2: a configuration is protected as long as it has known results on coming
    // tasks.
    const auto known = std::count_if(past.begin(), past.end(), [](double x) { return x == x; });
    progress_.protection.push_back(known);
    progress_.results.push_back(known);
  }
  find_uncovered();
  // Tasks without runs need no answer, so the race may pass them immediately.
  tell({});
}

void Race::tell(std::span<const Measurement> measurements) {
  SWARMSMITH_ASSERT(measurements.size() == wanted_.size(),
                    "there is one answer for every wanted run");
  std::size_t at = 0;
  while (!stop_) {
    if (!open_ && !open_task()) break;
    if (!open_->due.empty()) {
      // Skips runs of tasks in which only rejected configurations were to be run.
      while (at < wanted_.size() && wanted_[at].task < progress_.task)
        ++at;
      if (at == wanted_.size()) break;
      take_in(measurements, at);
    }
    if (!stop_) go_on();
  }
  wanted_.clear();
  if (!stop_) plan();
}

/// Rules 9.3.1 and 9.3.2 of irace facts. Rule 9.3.2 is not applied to a task without runs, which
/// costs nothing.
bool Race::open_task() {
  // irace facts, 9.3: the race stops when there is no further pair.
  if (progress_.task == settings_.pairs.size()) {
    stop_ = "no pairs left";
    return false;
  }
  std::vector<std::size_t> columns = to_run(progress_);
  if (!columns.empty()) {
    stop_ = reason_to_stop(progress_, columns.size());
    if (stop_) return false;
  }
  open_ = OpenTask{};
  OpenTask& task = *open_;
  task.step.task = static_cast<std::int64_t>(progress_.task) + 1;
  task.step.pair = settings_.pairs[progress_.task];
  task.step.alive_before = static_cast<std::int64_t>(alive_.size());
  task.bounds.resize(contestants_.size(), 0);
  if (settings_.capping) {
    // The elites' times on this pair determine the bounds of the others (irace facts, 17), so they
    // are run first.
    const auto others = std::stable_partition(columns.begin(), columns.end(),
                                              [&](auto c) { return progress_.protection[c] > 0; });
    task.later.assign(others, columns.end());
    columns.erase(others, columns.end());
    // The marker `:` of irace facts, 9.3.
    task.only_elites = !columns.empty() && task.later.empty();
    // No elite misses this pair, so the others need not wait.
    if (columns.empty()) std::swap(columns, task.later);
  }
  task.due = std::move(columns);
  set_bounds();
  return true;
}

void Race::take_in(std::span<const Measurement> measurements, std::size_t& at) {
  std::vector<std::size_t> answered;
  for (; at < wanted_.size() && wanted_[at].task == progress_.task && !stop_; ++at) {
    const RaceRun& run = wanted_[at];
    if (rejected_[run.column]) continue;  // rejected on an earlier task of the batch: ignored
    answered.push_back(run.column);
    if (run.is_evaluation) {
      take_evaluation(run.column, measurements[at].cost);
    } else {
      take_run(run, measurements[at]);
    }
  }
  if (stop_) return;
  // Every configuration that was alive then was asked for. Those rejected since then are left out
  // on both sides.
  SWARMSMITH_ASSERT(answered == open_->due, "every due run was asked for");
  // The runs are reported before rejections are looked at: the run of a rejected configuration
  // counts (irace facts, 12).
  if (!open_->evaluates) {
    std::vector<std::size_t>& ran = open_->ran;
    for (const std::size_t c : answered)
      open_->step.evaluated.emplace_back(contestants_[c].id, open_->step.pair);
    ran.insert(ran.end(), answered.begin(), answered.end());
    std::sort(ran.begin(), ran.end());
    if (settings_.target_evaluator) return;  // no costs yet
  }
  std::sort(answered.begin(), answered.end());
  reject_infinite(answered, open_->step);
}

void Race::take_run(const RaceRun& run, const Measurement& measurement) {
  const std::size_t c = run.column;
  const double bound = open_->bounds[c];
  const double least = settings_.min_measurable_time;
  const double time = measurement.time > 0 ? std::max(measurement.time, least) : measurement.time;
  // A rejection needs no time: no result of that configuration is used (irace facts, 12).
  const bool rejects = !settings_.target_evaluator && std::isinf(measurement.cost);
  if (settings_.capping && !rejects &&
      !(time > 0 && time < std::numeric_limits<double>::infinity())) {
    return fail(run, "reported no time, and capping needs one");
  }
  // irace facts, 17: this is an error, since a target must stop itself at the bound.
  if (bound > 0 && time > bound + least) {
    return fail(run, "took " + exact_text(time) + ", more than its bound of " + exact_text(bound) +
                         ": a target must stop itself at the bound");
  }
  put(times_[c], run.task, time);
  // irace facts, 18.4: the cost comes from a later call.
  if (settings_.target_evaluator) return;
  put(costs_[c], run.task,
      settings_.capping ? capped_cost(measurement.cost, time, bound, settings_.time_rules())
                        : measurement.cost);
}

void Race::take_evaluation(std::size_t column, double cost) {
  if (settings_.capping) {
    // A configuration that was not run in this task reached no bound in it.
    const bool ran = contains(open_->ran, column);
    SWARMSMITH_ASSERT(!ran || times_[column].size() > progress_.task,
                      "a configuration that was run has a time");
    cost = capped_cost(cost, ran ? times_[column][progress_.task] : 0,
                       ran ? open_->bounds[column] : settings_.bound_max, settings_.time_rules());
  }
  put(costs_[column], progress_.task, cost);
}

void Race::go_on() {
  OpenTask& task = *open_;
  task.due.clear();
  // With capping: the elites have run, and their times give the bounds of the others.
  if (!task.later.empty()) {
    task.due = std::exchange(task.later, {});
    set_bounds();
    return;
  }
  // irace facts, 18.4: one call for each alive configuration, even for elites that were not run on
  // this pair. Decision 10: there are no calls for a task without runs.
  if (settings_.target_evaluator && !task.ran.empty() && !task.evaluates) {
    task.evaluates = true;
    task.due = by_id(alive_);
    return;
  }
  close_task();
}

void Race::close_task() {
  RaceStep step = std::move(open_->step);
  const std::vector<std::size_t> ran = std::move(open_->ran);
  const bool only_elites = open_->only_elites;
  open_.reset();
  SWARMSMITH_ASSERT(progress_.task == static_cast<std::size_t>(step.task) - 1,
                    "tasks end in their order");
  pass(progress_, ran);  // 9.3.4; rejected ones (9.3.5) were removed when their costs arrived
  used_ = progress_.used;
  step.experiments_used = used_;
  // A race can lose all its configurations only by rejections (irace facts, 12). There is then
  // nothing to rank or test.
  if (alive_.empty()) {
    stop_ = "all configurations were rejected";
    steps_.push_back(std::move(step));
    return;
  }
  // Tests and ranks use a row of ranks for each task, over all alive configurations.
  add_ranked_row(progress_.task - 1);
  describe_best(step);  // 9.3.10: before the test
  if (ran.empty()) {
    step.marker = '.';
  } else if (only_elites) {
    step.marker = ':';
  } else {
    eliminate(step);  // 9.3.6 to 9.3.8
    SWARMSMITH_ASSERT(!alive_.empty(), "a test drops some of those alive, and never all");
  }
  // 9.3.9. A task on which only elites were run has no test, and counts no more than a task without
  // runs.
  const bool counts = !ran.empty() && !only_elites && !any_protected(progress_) &&
                      step.task > settings_.first_test && is_test_point(progress_.task);
  // A rejection alone is no drop here (decision 10).
  const bool dropped = step.marker == '-' || step.marker == 'c';
  if (counts) tests_without_drop_ = dropped ? 0 : tests_without_drop_ + 1;
  step.alive_after = static_cast<std::int64_t>(alive_.size());
  SWARMSMITH_ASSERT(step.alive_after <= step.alive_before,
                    "a configuration never returns to a race");
  // irace facts, 10.4: of the configurations that are still alive. It decides nothing.
  describe_agreement(step);
  step.digest = digest(step);
  steps_.push_back(std::move(step));
}

/// irace facts, 12: an infinite cost says that the configuration cannot be used at all, so that no
/// result of it counts any more.
void Race::reject_infinite(std::span<const std::size_t> columns, RaceStep& step) {
  std::vector<std::size_t> found;
  for (const std::size_t c : columns) {
    if (!std::isinf(costs_[c][progress_.task])) continue;
    found.push_back(c);
    rejected_[c] = true;
    costs_[c].clear();
    times_[c].clear();
    step.eliminations.push_back({contestants_[c].id, 0, EliminationReason::Rejection});
  }
  if (!found.empty()) drop(found);
}

void Race::fail(const RaceRun& run, const std::string& what) {
  failure_ = Error{ErrorKind::BadInput,
                   "the run of configuration " + std::to_string(contestants_[run.column].id) +
                       " on pair " + std::to_string(pair_of(run.task)) + " " + what,
                   ""};
  stop_ = failure_->message;
}

}  // namespace swarmsmith::irace
