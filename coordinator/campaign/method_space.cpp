#include "coordinator/campaign/method_space.h"

#include <algorithm>
#include <utility>

#include "coordinator/campaign/neighbourhoods.h"
#include "coordinator/campaign/network_space.h"
#include "irace_core/files/command_line_text.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/parameter_file.h"

namespace swarmsmith {
namespace {

/// The largest text that a task may carry to a worker (proto/wire.h, kMaxMachineBytes).
constexpr std::size_t kMostCallBytes = 1U << 20U;
constexpr std::size_t kNumberBytes = 25;
constexpr std::size_t kBlanks = 3;  ///< includes the dash of AClib's convention

/// The bytes of names, switches and values if all parameters are active and have their longest
/// values. Names are no part of a call, but of the text that a store keeps, which has a limit, too.
std::size_t longest_text(const ParameterSpace& space) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < space.size(); ++i) {
    std::size_t longest = space.is_numeric(i) ? kNumberBytes : 0;
    for (std::size_t k = 0; k < space.value_count(i); ++k)
      longest = std::max(longest, space.scalar(i, static_cast<double>(k)).text.size());
    bytes += space[i].name.size() + space[i].switch_text.size() + longest + kBlanks;
  }
  return bytes;
}

}  // namespace

CandidateText text_of(const Controller& controller, const Flavour& flavour) {
  const std::string printed = print_controller(controller, flavour);
  CandidateText text{.parameters = "{}",
                     .machine = printed,
                     .call = printed,
                     .modules = modules_json(controller, flavour)};
  if (const auto* machine = std::get_if<Machine>(&controller)) {
    text.states = static_cast<std::int64_t>(machine->states.size());
    text.transitions = transition_count(*machine);
  } else if (const auto* tree = std::get_if<Tree>(&controller)) {
    text.states = static_cast<std::int64_t>(tree->subtrees.size());
  }
  return text;
}

Expected<MethodSpace> MethodSpace::make(const Method& method, int digits, bool aclib) {
  MethodSpace made;
  made.aclib_ = aclib;
  if (method.parameters.empty()) {
    const auto flavour = flavour_of(method);
    if (!flavour) return Unexpected(flavour.error());
    made.method_ = method;
    made.flavour_ = *flavour;
    switch (method.architecture) {
      case Architecture::Machine: {
        auto machines = MachineSpace::make(method, **flavour, digits);
        if (!machines) return Unexpected(machines.error());
        made.machines_ = std::make_shared<const MachineSpace>(std::move(*machines));
        return made;
      }
      case Architecture::Tree: {
        auto trees = TreeSpace::make(method, **flavour, digits);
        if (!trees) return Unexpected(trees.error());
        made.trees_ = std::make_shared<const TreeSpace>(std::move(*trees));
        return made;
      }
      case Architecture::Network: {
        auto weights = network_space(method, digits);
        if (!weights) return Unexpected(weights.error());
        made.parameters_ = std::move(*weights);
        return made;
      }
    }
  }
  auto parameters = parse_parameter_file({.parameters = {method.parameters, "parameters"}});
  if (!parameters) return Unexpected(parameters.error());
  made.parameters_ = std::move(parameters->space);
  if (const std::size_t bytes = longest_text(*made.parameters_); bytes > kMostCallBytes) {
    return bad_input("names, switches and values of one configuration can take " +
                         std::to_string(bytes) + " bytes, and at most " +
                         std::to_string(kMostCallBytes) +
                         " are allowed: use fewer parameters, or shorter names and switches",
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
  if (machines_) return machines_->parameters();
  return trees_ ? trees_->parameters() : *parameters_;
}

Controller MethodSpace::controller_of(const Configuration& configuration) const {
  if (machines_) return machines_->to_machine(configuration);
  if (trees_) return trees_->to_tree(configuration);
  return to_network(method_, configuration);
}

std::optional<search::Neighbourhood> MethodSpace::neighbourhood() const {
  if (machines_) return machine_neighbourhood(machines_, method_);
  if (trees_) return tree_neighbourhood(trees_, method_);
  return std::nullopt;
}

CandidateText MethodSpace::text_of(const Configuration& configuration) const {
  if (flavour_ == nullptr) {
    CandidateText text;
    text.machine = command_line_text(*parameters_, configuration);
    text.call = aclib_ ? aclib_text(*parameters_, configuration) : text.machine;
    text.modules = "{}";
    text.parameters = parameters_json(parameters(), configuration);
    return text;
  }
  CandidateText text = swarmsmith::text_of(controller_of(configuration), *flavour_);
  // A network's text consists only of its parameters.
  if (method_.architecture != Architecture::Network)
    text.parameters = parameters_json(parameters(), configuration);
  return text;
}

Scenario race_on(const Campaign& campaign, const CampaignMission& mission) {
  Scenario race = campaign.race;
  if (!campaign.target) return race;
  race.n_instances = static_cast<std::int64_t>(mission.instances.training.size());
  race.target_evaluator = !campaign.target->evaluator.empty();
  // Programs are expensive, and the number of their calls may matter: no experiment is started that
  // a rejection would make unnecessary (irace facts, 19).
  race.one_task_at_a_time = true;
  return race;
}

}  // namespace swarmsmith
