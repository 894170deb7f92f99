#include "worker/evaluate.h"

#include <memory>
#include <utility>

#include "base/assert.h"
#include "proto/scenario/scenario.h"
#include "worker/simulation_evaluator.h"

namespace swarmsmith {
namespace {

/// One campaign of the pool, parsed once for all slots.
using SharedScenario = std::shared_ptr<const WorkerScenario>;

/// Passes each item to the evaluator of its campaign.
Evaluator by_campaign(std::vector<Evaluator> evaluators) {
  SWARMSMITH_ASSERT(!evaluators.empty(), "a scenario without campaigns was an error before");
  if (evaluators.size() == 1) return std::move(evaluators.front());
  return [evaluators = std::move(evaluators)](const LeasedTask& item) -> Result {
    const std::uint32_t campaign = campaign_of(item.key);
    if (campaign < evaluators.size()) return evaluators[campaign](item);
    return {.failure = "no such campaign in the scenario"};
  };
}

/// The parsed campaigns of the current scenario, and a factory for their evaluators.
class Evaluators {
 public:
  explicit Evaluators(AllowedPrograms allowed) : allowed_(std::move(allowed)) {}

  Expected<Evaluator> operator()(const std::string& bytes) {
    if (scenarios_.empty() || bytes != bytes_) {
      // Ends the programs of the old scenario, whose results would be dropped (Pool::finish).
      if (interrupt_ != nullptr) interrupt_->trigger();
      scenarios_.clear();
      Expected<PoolScenario> scenarios = scenarios_from_bytes(bytes);
      if (!scenarios) return Unexpected(scenarios.error());
      for (WorkerScenario& scenario : *scenarios)
        scenarios_.push_back(std::make_shared<const WorkerScenario>(std::move(scenario)));
      interrupt_ = std::make_shared<Interrupt>();
      bytes_ = bytes;
    }
    std::vector<Evaluator> evaluators;
    for (const SharedScenario& scenario : scenarios_) {
      Expected<Evaluator> evaluator = make_evaluator(scenario);
      if (!evaluator) return evaluator;
      evaluators.push_back(std::move(*evaluator));
    }
    return by_campaign(std::move(evaluators));
  }

 private:
  Expected<Evaluator> make_evaluator(const SharedScenario& scenario) const {
    if (!scenario->target) return make_simulation_evaluator(*scenario);
    return make_target_evaluator(scenario, allowed_, interrupt_);
  }

  AllowedPrograms allowed_;
  std::string bytes_;
  std::vector<SharedScenario> scenarios_;
  std::shared_ptr<Interrupt> interrupt_;
};

}  // namespace

EvaluatorFactory make_evaluators(AllowedPrograms allowed) {
  return Evaluators(std::move(allowed));
}

}  // namespace swarmsmith
