#include "coordinator/campaign/method_space.h"

#include <algorithm>
#include <utility>

#include "irace_core/files/command_line_text.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/parameter_file.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {

CandidateText text_of(const Machine& machine, const Flavour& flavour) {
  return {.parameters = "{}",
          .machine = print_machine(machine, flavour),
          .call = print_machine(machine, flavour),
          .modules = modules_json(machine),
          .states = static_cast<std::int64_t>(machine.states.size()),
          .transitions = transition_count(machine)};
}

Expected<MethodSpace> MethodSpace::make(const Method& method, int digits, bool aclib) {
  MethodSpace made;
  made.aclib_ = aclib;
  if (method.parameters.empty()) {
    auto flavour = find_flavour(method.flavour);
    if (!flavour) return Unexpected(flavour.error());
    auto machines = MachineSpace::make(method, **flavour, digits);
    if (!machines) return Unexpected(machines.error());
    made.machines_ = std::move(*machines);
    made.flavour_ = *flavour;
    return made;
  }
  auto parameters = parse_parameter_file({.parameters = {method.parameters, "parameters"}});
  if (!parameters) return Unexpected(parameters.error());
  made.parameters_ = std::move(parameters->space);
  if (method.configurations.empty()) return made;
  auto initial =
      parse_configurations_file({method.configurations, "configurations"}, *made.parameters_);
  if (!initial) return Unexpected(initial.error());
  made.initial_ = std::move(*initial);
  return made;
}

const ParameterSpace& MethodSpace::parameters() const {
  return machines_ ? machines_->parameters() : *parameters_;
}

CandidateText MethodSpace::text_of(const Configuration& configuration) const {
  CandidateText text;
  if (machines_) {
    text = swarmsmith::text_of(machines_->to_machine(configuration), *flavour_);
  } else {
    text.machine = command_line_text(*parameters_, configuration);
    text.call = aclib_ ? aclib_text(*parameters_, configuration) : text.machine;
    text.modules = "{}";
  }
  text.parameters = parameters_json(parameters(), configuration);
  return text;
}

Scenario race_on(const Campaign& campaign, const CampaignMission& mission) {
  Scenario race = campaign.race;
  if (!campaign.target) return race;
  race.n_instances = static_cast<std::int64_t>(mission.instances.training.size());
  race.target_evaluator = !campaign.target->evaluator.empty();
  // Programs are dear and may be counted on their calls: nothing is run that a rejection would have
  // saved (irace facts, 19).
  race.one_task_at_a_time = true;
  return race;
}

}  // namespace swarmsmith
