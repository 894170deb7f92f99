#include "coordinator/campaign/irace_campaign.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace swarmsmith {
namespace {

BatchMode batch_mode_of(const std::string& name) {
  constexpr std::array<std::string_view, 6> kNames = {"0",      "sge",   "pbs",
                                                      "torque", "slurm", "htcondor"};
  const auto found = std::ranges::find(kNames, name);
  return found == kNames.end() ? BatchMode::None : static_cast<BatchMode>(found - kNames.begin());
}

Target target_of(const IraceSetup& setup) {
  Target target{.runner = setup.target_runner.string(),
                .launcher = setup.target_runner_launcher.string(),
                .evaluator = setup.target_evaluator.string(),
                .folder = setup.exec_dir.string(),
                .retries = setup.target_runner_retries,
                .timeout_s = setup.target_runner_timeout,
                .aclib = setup.aclib,
                .batch_mode = batch_mode_of(setup.batchmode),
                .prints_time = setup.race.max_time > 0,
                .min_measurable_time = setup.race.min_measurable_time,
                .debug_level = static_cast<int>(std::min<std::int64_t>(setup.debug_level, 3))};
  if (!setup.target_cmdline.empty()) target.command_line = setup.target_cmdline;
  return target;
}

}  // namespace

Campaign campaign_of(const IraceSetup& setup, std::uint64_t seed) {
  Campaign campaign;
  campaign.name = "irace";
  campaign.seed = setup.seed.value_or(seed);
  CampaignMission mission;
  mission.mission.name = "tuning";
  mission.instances = {setup.training, setup.test};
  mission.test_count = static_cast<std::int64_t>(setup.test.size());
  campaign.missions.push_back(std::move(mission));
  Method method;
  method.name = "irace";
  method.flavour.clear();
  method.max_states = method.max_transitions = 0;
  method.parameters = setup.parameter_text;
  method.configurations = setup.configurations_text;
  campaign.methods.push_back(std::move(method));
  campaign.race = setup.race;
  // Both are set for each design, from the mission and the campaign's seed.
  campaign.race.n_instances = Scenario{}.n_instances;
  campaign.race.seed = Scenario{}.seed;
  // `parallel` only affects the first estimate of a run's time; without a time budget, a change
  // must not prevent a resume.
  if (campaign.race.max_time == 0) campaign.race.parallel = Scenario{}.parallel;
  campaign.race.target_evaluator = Scenario{}.target_evaluator;
  campaign.race.one_task_at_a_time = Scenario{}.one_task_at_a_time;
  campaign.digits = setup.space.digits();
  campaign.profile = {};
  campaign.target = target_of(setup);
  campaign.repair = setup.repair_configuration.string();
  campaign.test_nb_elites = setup.test_nb_elites;
  campaign.test_iteration_elites = setup.test_iteration_elites;
  campaign.store = setup.log_file;
  if (setup.parallel) campaign.local_workers = std::max<std::int64_t>(1, *setup.parallel);
  campaign.stop_on_failure = !setup.rejects_failures;
  return campaign;
}

}  // namespace swarmsmith
