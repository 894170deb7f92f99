#include "cli/irace/irace_actions.h"

#include <fmt/format.h>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "base/process/guard.h"
#include "cli/irace/irace_console.h"
#include "coordinator/campaign/method_space.h"
#include "coordinator/design/repair.h"
#include "irace_core/files/options.h"
#include "irace_core/iterated_race.h"
#include "programs/runner.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kSeed = 1'234'567;  // irace facts, 21
constexpr std::size_t kRandom = 2;

/// The given configurations, except forbidden ones, and random ones; an error if no race can begin.
Expected<std::vector<Configuration>> contestants(const IraceSetup& setup, const Scenario& race,
                                                 const Repair& repair) {
  std::vector<Configuration> all = setup.initial;
  std::erase_if(all, [&](const Configuration& c) { return setup.space.is_forbidden(c); });
  // A scenario that the run would refuse must be refused by its check, too.
  auto run = IteratedRace::start(setup.space, race, setup.initial, repair);
  if (!run) return Unexpected(run.error());
  auto sampled = IteratedRace::start(setup.space, race, {}, repair);
  if (!sampled) return Unexpected(sampled.error());
  std::int64_t last = 0;
  std::size_t random = 0;
  for (const Experiment& experiment : sampled->wanted()) {
    if (experiment.configuration <= last || random == kRandom) continue;
    last = experiment.configuration;
    ++random;
    all.push_back(sampled->configuration(last));
  }
  return all;
}

/// Calls programs and prints their results.
class Trial {
 public:
  Trial(Output& output, const Target& target)
      : output_(output), target_(target), runner_(target, {.shell = true}, interrupt_) {}

  bool run(const RunnerCall& call) {
    const std::string& program = target_.launcher.empty() ? target_.runner : target_.launcher;
    announce(program + " " + arguments_of(target_, call));
    const auto begin = std::chrono::steady_clock::now();
    const auto result = runner_.run(call);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (result) {
      output_.out << fmt::format("# {}: DONE ({}) Elapsed wall-clock seconds: {:.2f}\n",
                                 irace_date(), call.configuration, spent.count());
    }
    return tell(result, target_.evaluator.empty());
  }

  bool evaluate(const EvaluatorCall& call) {
    announce(target_.evaluator + " " + arguments_of(call));
    return tell(runner_.evaluate(call), true);
  }

 private:
  void announce(const std::string& command) {
    output_.out << "# " << irace_date() << ": " << command << std::endl;
  }

  bool tell(const tl::expected<TargetResult, TargetFailure>& result, bool has_cost) {
    if (!result) {
      output_.err << "swarmsmith: " << message_of(result.error().reason, result.error().details)
                  << '\n';
      return false;
    }
    const Reading& reading = result->reading;
    if (result->rejected) {
      output_.out << "rejected: the cost is infinite\n";
    } else if (has_cost) {
      output_.out << fmt::format("cost: {:.15g}\n", reading.cost);
    }
    if (reading.time > 0) output_.out << fmt::format("time: {:.15g}\n", reading.time);
    return true;
  }

  Output& output_;
  const Target& target_;
  Interrupt interrupt_;
  TargetRunner runner_;
};

}  // namespace

ExitCode check_target(Output& output, const IraceSetup& setup, const Campaign& campaign) {
  if (auto guarded = start_guard(); !guarded)
    return fail(output, ExitCode::Failed, guarded.error());
  const CampaignMission& mission = campaign.missions.front();
  auto space = MethodSpace::make(campaign.methods.front(), static_cast<int>(campaign.digits),
                                 campaign.target->aclib);
  if (!space) return fail(output, ExitCode::Failed, space.error());
  const auto shared = std::make_shared<const MethodSpace>(std::move(*space));
  Repair repair;
  if (!campaign.repair.empty())
    repair = repair_by(campaign.repair, campaign.target->folder, shared);
  for (std::size_t i = 0; i < setup.initial.size(); ++i) {
    if (!setup.space.is_forbidden(setup.initial[i])) continue;
    output.out << fmt::format(
        "# Warning: initial configuration {} is forbidden, and is not tried\n", i + 1);
  }
  const auto configurations = contestants(setup, race_on(campaign, mission), repair);
  if (!configurations)
    return fail(output, ExitCode::Failed, with_irace_option_names(configurations.error()));
  output.out << fmt::format("# {}: Checking the target: {}\n", irace_date(),
                            counted(configurations->size(), "call"));
  Trial trial(output, *campaign.target);
  const std::string& instance = mission.instances.training.front();
  std::vector<std::int64_t> numbers;
  std::size_t failed = 0;
  for (const Configuration& configuration : *configurations) {
    numbers.push_back(static_cast<std::int64_t>(numbers.size()) + 1);
    const bool works = trial.run({.configuration = numbers.back(),
                                  .instance_id = "1",
                                  .seed = kSeed,
                                  .instance = instance,
                                  .bound = campaign.race.bound_max,
                                  .switches = shared->text_of(configuration).call});
    if (!works) ++failed;
  }
  if (!campaign.target->evaluator.empty() && failed == 0) {
    for (const std::int64_t number : numbers) {
      if (!trial.evaluate({number, "1", kSeed, instance, numbers})) ++failed;
    }
  }
  if (failed > 0) {
    return fail(output, ExitCode::Failed,
                fmt::format("the check failed: {} of the calls above gave no cost", failed));
  }
  output.out << fmt::format("# {}: Check successful.\n", irace_date());
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
