#include "worker/evaluate.h"

#include <memory>
#include <utility>

#include "sim/messages/scenario_messages.h"
#include "worker/simulation_evaluator.h"

namespace swarmsmith {
namespace {

/// The scenario that is in use, read once for all slots.
class Evaluators {
 public:
  explicit Evaluators(AllowedPrograms allowed) : allowed_(std::move(allowed)) {}

  Expected<Evaluator> operator()(const std::string& bytes) {
    if (scenario_ == nullptr || bytes != bytes_) {
      if (interrupt_ != nullptr) interrupt_->trigger();
      scenario_.reset();
      Expected<WorkerScenario> scenario = scenario_from_bytes(bytes);
      if (!scenario) return Unexpected(scenario.error());
      scenario_ = std::make_shared<const WorkerScenario>(std::move(*scenario));
      interrupt_ = std::make_shared<Interrupt>();
      bytes_ = bytes;
    }
    if (!scenario_->target) return make_simulation_evaluator(*scenario_);
    return make_target_evaluator(scenario_, allowed_, interrupt_);
  }

 private:
  AllowedPrograms allowed_;
  std::string bytes_;
  std::shared_ptr<const WorkerScenario> scenario_;
  std::shared_ptr<Interrupt> interrupt_;
};

}  // namespace

EvaluatorFactory make_evaluators(AllowedPrograms allowed) {
  return Evaluators(std::move(allowed));
}

}  // namespace swarmsmith
