#include <algorithm>
#include <utility>

#include "base/rng.h"
#include "coordinator/design/design_runner.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kLargestSeed = 2'147'483'647;

/// The pairs on which elites are scored: their seeds are a stream of their own, so that they meet
/// no pair of the race but by chance.
Experiment test_experiment(const DesignPlan& plan, std::int64_t candidate, std::int64_t number) {
  Rng rng = Rng(static_cast<std::uint64_t>(plan.row.seed))
                .split("test", static_cast<std::uint64_t>(number));
  return {.configuration = candidate,
          .pair = number,
          .instance =
              plan.tests.on_test_instances ? number : (number - 1) % plan.scenario.n_instances + 1,
          .seed = rng.uniform_int(1, kLargestSeed),
          .bound = plan.scenario.bound_max};
}

}  // namespace

void DesignRunner::test_the_given(std::vector<Task>& tasks, std::vector<Row>& rows) {
  std::vector<std::int64_t>& numbers = elites_.emplace_back();
  for (const Configuration& configuration : plan_.initial) {
    numbers.push_back(static_cast<std::int64_t>(numbers.size()) + 1);
    record_candidate({.id = numbers.back(), .configuration = configuration}, rows);
  }
  plan_.tests.elites = static_cast<std::int64_t>(numbers.size());
  // A machine to compare with stands for its method as a race's winner does.
  if (!plan_.row.flavour.empty()) best_ = numbers.front();
  state_ = DesignState::Testing;
  record_state(rows);
  want_tests(tasks, rows);
}

std::vector<std::int64_t> DesignRunner::tested() const {
  std::vector<std::int64_t> numbers;
  const auto add = [&](const std::vector<std::int64_t>& elites) {
    const auto most = std::min(elites.size(), static_cast<std::size_t>(plan_.tests.elites));
    for (std::size_t i = 0; i < most; ++i) {
      if (std::ranges::find(numbers, elites[i]) == numbers.end()) numbers.push_back(elites[i]);
    }
  };
  if (elites_.empty()) return numbers;
  add(elites_.back());
  if (!plan_.tests.every_iteration) return numbers;
  for (const auto& elites : elites_)
    add(elites);
  return numbers;
}

void DesignRunner::want_tests(std::vector<Task>& tasks, std::vector<Row>& rows) {
  testing_ = tested();
  std::vector<Experiment> batch;
  for (const std::int64_t candidate_number : testing_) {
    for (std::int64_t number = 1; number <= plan_.tests.count; ++number)
      batch.push_back(test_experiment(plan_, candidate_number, number));
  }
  begin_batch(std::move(batch));
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Experiment& experiment = batch_[i];
    if (experiment.pair > tests_known_) {
      tests_known_ = experiment.pair;
      record_pair(Purpose::Test, experiment, rows);
    }
    want(i, {candidate(experiment.configuration), Purpose::Test, experiment.pair}, experiment,
         tasks, rows);
  }
}

/// Their tasks follow those of the race; negative instances tell that they are test instances.
void DesignRunner::want_test_calls(std::vector<Task>& tasks, std::vector<Row>& rows) {
  test_calls_wanted_ = true;
  std::vector<Experiment> batch;
  for (std::int64_t number = 1; number <= plan_.tests.count; ++number) {
    for (const std::int64_t candidate_number : testing_) {
      Experiment call = test_experiment(plan_, candidate_number, number);
      call.instance = -call.instance;
      call.bound = 0;
      call.pair = call.task = calls_known_ + number;
      call.is_evaluation = true;
      batch.push_back(call);
    }
  }
  begin_batch(std::move(batch));
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Experiment& call = batch_[i];
    if (call.configuration == testing_.front()) record_pair(Purpose::Evaluator, call, rows);
    want(i, {candidate(call.configuration), Purpose::Evaluator, call.pair}, call, tasks, rows);
  }
}

std::optional<Task> DesignRunner::task_of(const EvaluationKey& key) const {
  const std::int64_t number = number_of(key.candidate);
  if (number > static_cast<std::int64_t>(totals_.size())) return std::nullopt;
  if (key.purpose == Purpose::Test && key.pair <= plan_.tests.count) {
    return task_of(key, test_experiment(plan_, number, key.pair));
  }
  const auto pair = pairs_.find(key.pair);
  if (key.purpose != Purpose::Race || pair == pairs_.end()) return std::nullopt;
  Experiment experiment = pair->second;
  experiment.configuration = number;
  return task_of(key, experiment);
}

bool DesignRunner::finish_tests(std::vector<Task>& tasks, std::vector<Row>& rows) {
  if (!awaited_.empty()) return false;
  if (!plan_.scenario.target_evaluator) return true;
  if (!test_calls_wanted_) want_test_calls(tasks, rows);
  return awaited_.empty();
}

}  // namespace swarmsmith
