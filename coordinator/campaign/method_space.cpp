#include "coordinator/campaign/method_space.h"

#include <algorithm>
#include <utility>

#include "irace_core/files/command_line_text.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/parameter_file.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// As much as a task may carry to a worker (proto/wire.h, kMaxMachineBytes).
constexpr std::size_t kMostCallBytes = 1U << 20U;
constexpr std::size_t kNumberBytes = 25;
constexpr std::size_t kBlanks = 3;  ///< and the dash of aclib

/// Bytes of switches and values when all parameters are active and their values the longest.
std::size_t longest_call(const ParameterSpace& space) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < space.size(); ++i) {
    std::size_t longest = space.is_numeric(i) ? kNumberBytes : 0;
    for (std::size_t k = 0; k < space.value_count(i); ++k)
      longest = std::max(longest, space.scalar(i, static_cast<double>(k)).text.size());
    bytes += space[i].switch_text.size() + longest + kBlanks;
  }
  return bytes;
}

}  // namespace

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
  if (const std::size_t bytes = longest_call(*made.parameters_); bytes > kMostCallBytes) {
    return bad_input("switches and values of one call may take " + std::to_string(bytes) +
                         " bytes, and a program is given at most " +
                         std::to_string(kMostCallBytes) + ": fewer parameters, or shorter switches",
                     "parameters");
  }
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
