#include "coordinator/campaign/tree_space.h"

#include <optional>
#include <string>
#include <utility>

namespace swarmsmith {

TreeSpace::TreeSlot TreeSpace::build(const Method& method, ModuleParameters& parameters) {
  const auto most = static_cast<int>(method.max_subtrees);
  TreeSlot tree;
  parameters.add_fixed("Root", "nroot", 3, std::nullopt);
  if (most > 1) {
    tree.count = parameters.add("NumSubtrees", "nchildroot", Integer{1.0, double(most)});
  } else {
    parameters.add_fixed("NumSubtrees", "nchildroot", 1, std::nullopt);
  }
  for (int i = 0; i < most; ++i) {
    std::optional<Expression> is_there;
    if (i > 0) is_there = more_than("NumSubtrees", i);
    const std::string subtree = std::to_string(i);
    const std::string action = subtree + "1";
    const std::string condition = subtree + "0";
    parameters.add_fixed("Selector" + subtree, "n" + subtree, 0, is_there);
    parameters.add_fixed("Children" + subtree, "nchild" + subtree, 2, is_there);
    parameters.add_fixed("Action" + action, "n" + action, 5, is_there);
    SubtreeSlot& slot = tree.subtrees.emplace_back();
    slot.action = parameters.add("A" + action, "a" + action,
                                 parameters.choice_of(parameters.behaviours()), is_there);
    slot.actions = parameters.add_modules(parameters.behaviours(), "A" + action, action);
    parameters.add_fixed("Success" + action, "p" + action, 0, is_there);
    parameters.add_fixed("Condition" + condition, "n" + condition, 6, is_there);
    slot.condition = parameters.add("C" + condition, "c" + condition,
                                    parameters.choice_of(parameters.conditions()), is_there);
    slot.conditions = parameters.add_modules(parameters.conditions(), "C" + condition, condition);
  }
  return tree;
}

Expected<TreeSpace> TreeSpace::make(const Method& method, const Flavour& flavour, int digits) {
  ModuleParameters parameters(method, flavour, Wording::Names);
  TreeSlot slot = build(method, parameters);
  auto space = ParameterSpace::make(parameters.take(), {}, digits);
  if (!space) return Unexpected(space.error());
  return TreeSpace(std::move(*space), flavour, std::move(slot));
}

Expected<ParameterSpace> TreeSpace::in_grammar(const Method& method, const Flavour& flavour,
                                               int digits) {
  ModuleParameters parameters(method, flavour, Wording::Grammar);
  build(method, parameters);
  return ParameterSpace::make(parameters.take(), {}, digits);
}

Tree TreeSpace::to_tree(const Configuration& configuration) const {
  Tree tree;
  const auto count = static_cast<std::size_t>(value_or(configuration, slot_.count, 1));
  for (std::size_t i = 0; i < count; ++i) {
    const SubtreeSlot& slot = slot_.subtrees[i];
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
  if (slot_.count != kNoParameter)
    configuration.set(slot_.count, static_cast<double>(tree.subtrees.size()));
  for (std::size_t i = 0; i < tree.subtrees.size(); ++i) {
    const SubtreeSlot& slot = slot_.subtrees.at(i);
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
