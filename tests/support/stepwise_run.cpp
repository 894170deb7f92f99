#include "tests/support/stepwise_run.h"

#include <optional>
#include <utility>

#include "sim/control/control_software.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kStepsPerCycle = 10;

/// Robots that are asked at each step, look where they are, and decide at each tenth.
class Stepwise : public Decider {
 public:
  Stepwise(const SimulationSetup& setup, StepwiseRun& run) : setup_(setup), run_(run) {
    const std::size_t robots = setup.instance.starts.size();
    run_.poses.resize(robots);
    run_.decided.resize(robots);
    run_.neighbours.resize(robots);
    answers_.resize(robots);
    for (std::size_t i = 0; i < robots; ++i) {
      run_.poses[i].push_back(setup.instance.starts[i]);
      control_.emplace_back(setup.controller, setup.flavour,
                            control_stream(setup.seed, static_cast<int>(i)));
    }
  }

  void ask(const Question& question) override {
    const auto i = static_cast<std::size_t>(question.robot);
    const Readings& place = question.senses.read(Sensor::Locator | Sensor::Imu);
    const Pose& start = setup_.instance.starts[i];
    const Pose pose{start.x + place.position_m.x, start.y + place.position_m.y,
                    place.orientation.yaw_rad};
    run_.poses[i].push_back(pose);
    if (question.cycle % kStepsPerCycle != 0) return;
    const Command command = control_[i].step(question.senses);
    run_.neighbours[i].push_back(question.senses.read(Sensor::Neighbours).neighbours);
    run_.decided[i].push_back(
        {.pose = pose, .command = command, .state = control_[i].state(), .readings = nullptr});
    answers_[i] = Answer{command, control_[i].state()};
  }

  std::optional<Answer> answer(int robot) override {
    return std::exchange(answers_[static_cast<std::size_t>(robot)], std::nullopt);
  }

 private:
  const SimulationSetup& setup_;
  StepwiseRun& run_;
  std::vector<ControlSoftware> control_;
  std::vector<std::optional<Answer>> answers_;
};

}  // namespace

StepwiseRun run_stepwise(const SimulationSetup& setup) {
  Profile profile = setup.profile;
  profile.timing.least_period = profile.timing.most_period = 1.0 / kStepsPerCycle;
  profile.timing.jitter = 0;
  const SimulationSetup stepwise{setup.controller, setup.flavour,  profile,
                                 setup.mission,    setup.instance, setup.seed};
  StepwiseRun run;
  Stepwise decider(stepwise, run);
  simulate(stepwise, {}, &decider);
  return run;
}

}  // namespace swarmsmith
