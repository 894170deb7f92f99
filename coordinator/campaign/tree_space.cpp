#include "coordinator/campaign/tree_space.h"

#include <optional>
#include <string>

namespace swarmsmith {

Expected<TreeSpace> TreeSpace::make(const Method& method, const Flavour& flavour, int digits) {
  ModuleParameters parameters(method, flavour, Words::Names);
  const auto most = static_cast<int>(method.max_subtrees);
  std::size_t count = kNoParameter;
  if (most > 1) count = parameters.add("NumSubtrees", "nchildroot", Integer{1.0, double(most)});
  std::vector<SubtreeSlot> subtrees;
  for (int i = 0; i < most; ++i) {
    std::optional<Expression> is_there;
    if (i > 0) is_there = more_than("NumSubtrees", i);
    const std::string action = std::to_string(i) + "1";
    const std::string condition = std::to_string(i) + "0";
    SubtreeSlot& slot = subtrees.emplace_back();
    slot.action = parameters.add("A" + action, "a" + action,
                                 parameters.choice_of(parameters.behaviours()), is_there);
    slot.actions = parameters.add_modules(parameters.behaviours(), "A" + action, action);
    slot.condition = parameters.add("C" + condition, "c" + condition,
                                    parameters.choice_of(parameters.conditions()), is_there);
    slot.conditions = parameters.add_modules(parameters.conditions(), "C" + condition, condition);
  }
  auto space = ParameterSpace::make(parameters.take(), {}, digits);
  if (!space) return Unexpected(space.error());
  TreeSpace made(std::move(*space));
  made.flavour_ = &flavour;
  made.count_ = count;
  made.subtrees_ = std::move(subtrees);
  return made;
}

Tree TreeSpace::to_tree(const Configuration& configuration) const {
  Tree tree;
  const auto count = static_cast<std::size_t>(value_or(configuration, count_, 1));
  for (std::size_t i = 0; i < count; ++i) {
    const SubtreeSlot& slot = subtrees_[i];
    const ModuleSlot& condition = slot.conditions[configuration.choice(slot.condition)];
    const ModuleSlot& action = slot.actions[configuration.choice(slot.action)];
    tree.subtrees.push_back(
        {make_condition(condition.spec->module, values_of(configuration, condition, *flavour_)),
         make_behaviour(action.spec->module, values_of(configuration, action, *flavour_))});
  }
  return tree;
}

Configuration TreeSpace::from_tree(const Tree& tree) const {
  Configuration configuration(space_.size());
  if (count_ != kNoParameter) configuration.set(count_, static_cast<double>(tree.subtrees.size()));
  for (std::size_t i = 0; i < tree.subtrees.size(); ++i) {
    const SubtreeSlot& slot = subtrees_.at(i);
    const auto& [condition, action] = tree.subtrees[i];
    configuration.set(slot.condition,
                      static_cast<double>(put_module(module_of(condition), parameters_of(condition),
                                                     slot.conditions, *flavour_, configuration)));
    configuration.set(slot.action,
                      static_cast<double>(put_module(module_of(action), parameters_of(action),
                                                     slot.actions, *flavour_, configuration)));
  }
  return configuration;
}

}  // namespace swarmsmith
