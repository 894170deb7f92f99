#include "coordinator/design/design_runner.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "programs/cost.h"

namespace swarmsmith {
namespace {

constexpr double kRejected = std::numeric_limits<double>::infinity();

StoredScore score_of(const Outcome& outcome, double bound) {
  return {outcome.key, outcome.status, outcome.score, outcome.state_digest, outcome.time, bound};
}

}  // namespace

EvaluationRow evaluation_row(const Outcome& outcome, std::int64_t iteration, double bound,
                             const std::string& source) {
  return {.key = outcome.key,
          .iteration = iteration,
          .status = outcome.status,
          .score = outcome.score,
          .state_digest = outcome.state_digest,
          .time = outcome.time,
          .bound = bound,
          .source = source,
          .wall_us = outcome.wall_us,
          .worker = outcome.worker,
          .attempt = outcome.attempt};
}

Expected<DesignRunner> DesignRunner::start(DesignPlan plan, StoredDesign stored) {
  if (plan.only_test) return DesignRunner(std::move(plan), std::move(stored), std::nullopt);
  auto race = IteratedRace::start(plan.space, plan.scenario, plan.initial, plan.repair);
  if (!race) return Unexpected(race.error());
  return DesignRunner(std::move(plan), std::move(stored), std::move(*race));
}

DesignRunner::DesignRunner(DesignPlan plan, StoredDesign stored, std::optional<IteratedRace> race)
    : plan_(std::move(plan)), stored_(std::move(stored)), race_(std::move(race)) {
  sort_commands();
}

Expected<void> DesignRunner::advance(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (auto gone_on = go_on(tasks, rows); !gone_on) return gone_on;
  if (!is_calling_ && !calls_.empty()) {
    is_calling_ = true;
    tasks.push_back(std::move(calls_.front()));
    calls_.pop_front();
  }
  return {};
}

Expected<void> DesignRunner::go_on(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (state_ == DesignState::Waiting) {
    if (auto begun = begin(tasks, rows); !begun) return begun;
  }
  for (;;) {
    if (state_ == DesignState::Racing) {
      if (auto raced = go_on_racing(tasks, rows); !raced) return raced;
    }
    if (fault_) return Unexpected(*fault_);
    if (state_ != DesignState::Finished) {
      if (state_ != DesignState::Testing) return {};
      const bool tested = finish_tests(tasks, rows);
      if (fault_) return Unexpected(*fault_);
      if (!tested) return {};
      state_ = DesignState::Finished;
      record_state(rows);
    }
    const auto extended = extend(tasks, rows);
    if (!extended) return Unexpected(extended.error());
    if (!*extended) return {};
  }
}

Expected<void> DesignRunner::begin(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (plan_.only_test) {
    test_the_given(tasks, rows);
    return {};
  }
  state_ = DesignState::Racing;
  if (auto recorded = record_events(rows); !recorded) return recorded;
  want_batch(tasks, rows);
  return {};
}

Expected<void> DesignRunner::go_on_racing(std::vector<Task>& tasks, std::vector<Row>& rows) {
  for (;;) {
    if (is_cancelled()) {
      cancel(tasks, rows);
      return {};
    }
    if (!awaited_.empty()) return {};
    if (fault_) return Unexpected(*fault_);
    if (race_->finished()) return finish_race(tasks, rows);
    // Runs before a targetEvaluator are all used; the step comes with its word on them.
    if (!plan_.scenario.target_evaluator) {
      for (std::size_t i = 0; i < batch_.size(); ++i)
        given_.push_back({batch_[i].configuration, batch_[i].pair, scores_[i]});
    }
    reported_ = false;
    race_->tell(measurements_);
    if (auto recorded = record_events(rows); !recorded) return recorded;
    // A task may take several batches (capping): nothing of it is unused before its step.
    if (reported_ || race_->finished()) {
      record_unused(given_.size(), rows);
      given_.clear();
      consumed_ = 0;
    }
    want_batch(tasks, rows);
    drop_void();
  }
}

Expected<void> DesignRunner::finish_race(std::vector<Task>& tasks, std::vector<Row>& rows) {
  const bool goes_on = next_command("extend") != nullptr;
  if (steps_ < stored_.step_digests.size() && !goes_on) return Unexpected(other_way());
  if (race_->failure()) {
    state_ = DesignState::Stopped;
    reason_ = to_string(*race_->failure());
    record_state(rows);
    return {};
  }
  state_ = DesignState::Testing;
  record_state(rows);
  want_tests(tasks, rows);
  return {};
}

void DesignRunner::begin_batch(std::vector<Experiment> batch) {
  batch_ = std::move(batch);
  measurements_.assign(batch_.size(), {});
  scores_.assign(batch_.size(), {});
}

void DesignRunner::want_batch(std::vector<Task>& tasks, std::vector<Row>& rows) {
  const auto wanted = race_->wanted();
  begin_batch({wanted.begin(), wanted.end()});
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Experiment& experiment = batch_[i];
    const CandidateId id = candidate(experiment.configuration);
    if (experiment.is_evaluation) {
      Experiment call = experiment;
      call.pair = experiment.task + test_calls_;
      if (call.pair > calls_known_) {
        calls_known_ = call.pair;
        record_pair(Purpose::Evaluator, call, rows);
      }
      want(i, {id, Purpose::Evaluator, call.pair}, call, tasks, rows);
      continue;
    }
    if (experiment.pair > pairs_known_) {
      pairs_known_ = experiment.pair;
      record_pair(Purpose::Race, experiment, rows);
    }
    want(i, {id, Purpose::Race, experiment.pair}, experiment, tasks, rows);
  }
}

void DesignRunner::record_pair(Purpose purpose, const Experiment& experiment,
                               std::vector<Row>& rows) {
  if (purpose == Purpose::Race) pairs_.emplace(experiment.pair, experiment);
  record(PairRow{.design = plan_.row.id,
                 .purpose = purpose,
                 .number = experiment.pair,
                 .instance = experiment.instance,
                 .seed = experiment.seed},
         rows);
}

std::unordered_map<std::uint64_t, StoredScore>& DesignRunner::known(Purpose purpose) {
  if (purpose == Purpose::Race) return stored_.race_scores;
  return purpose == Purpose::Test ? stored_.test_scores : stored_.evaluator_scores;
}

void DesignRunner::want(std::size_t position, const EvaluationKey& key,
                        const Experiment& experiment, std::vector<Task>& tasks,
                        std::vector<Row>& rows) {
  const std::uint64_t packed = packed_key(key);
  auto score = known(key.purpose).extract(packed);
  if (score && score.mapped().bound != experiment.bound && !fault_) fault_ = other_way();
  if (!score && key.purpose == Purpose::Race) score = unused_.extract(packed);
  if (score) {
    put(position, score.mapped());
    if (key.purpose == Purpose::Race) record_use(score.mapped(), rows);
    if (key.purpose == Purpose::Test) tested_scores_.insert(std::move(score));
    return;
  }
  if (key.purpose == Purpose::Test) {
    if (const auto tested = tested_scores_.find(packed); tested != tested_scores_.end())
      return put(position, tested->second);
  }
  awaited_.emplace(packed, position);
  if (key.purpose == Purpose::Race && ahead_.erase(packed) > 0) std::erase(dropped_, key);
  Task task = task_of(key, experiment);
  if (experiment.is_evaluation) {
    task.alive = state_ == DesignState::Testing ? testing_ : race_->alive();
    return calls_.push_back(std::move(task));
  }
  tasks.push_back(std::move(task));
}

Task DesignRunner::task_of(const EvaluationKey& key, const Experiment& experiment) const {
  return {{.mission = plan_.mission,
           .method = plan_.method,
           .instance = experiment.instance,
           .seed = experiment.seed,
           .machine = call_of(experiment.configuration),
           .bound = experiment.bound},
          key};
}

/// The last race and the tests take candidates from anywhere.
std::string DesignRunner::call_of(std::int64_t number) const {
  const auto known = calls_of_.find(number);
  return known != calls_of_.end() ? known->second
                                  : plan_.describe(race_->configuration(number)).call;
}

void DesignRunner::put(std::size_t position, const StoredScore& score) {
  scores_[position] = score;
  measurements_[position] = {
      score.status == EvaluationStatus::Ok ? to_cost(score.score) : kRejected, score.time};
}

void DesignRunner::tell(const Outcome& outcome, std::vector<Row>& rows) {
  const std::uint64_t packed = packed_key(outcome.key);
  if (outcome.key.purpose == Purpose::Race) {
    if (const auto ahead = ahead_.extract(packed))
      return keep_ahead(outcome, ahead.mapped().bound, rows);
  }
  const auto found = awaited_.find(packed);
  SWARMSMITH_ASSERT(found != awaited_.end(), "an outcome is told once, and only when wanted");
  const StoredScore score = score_of(outcome, batch_[found->second].bound);
  put(found->second, score);
  if (outcome.key.purpose == Purpose::Test) tested_scores_.emplace(packed, score);
  awaited_.erase(found);
  if (outcome.key.purpose == Purpose::Evaluator) is_calling_ = false;
  // The first estimate of max_time is made before the first iteration, and counts to it.
  const std::int64_t iteration = std::max<std::int64_t>(1, iteration_);
  rows.emplace_back(evaluation_row(outcome, outcome.key.purpose == Purpose::Race ? iteration : 0,
                                   score.bound, plan_.source));
}

}  // namespace swarmsmith
