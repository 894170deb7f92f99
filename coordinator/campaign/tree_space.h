#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/module_parameters.h"
#include "irace_core/parameter_space.h"
#include "sim/control/tree.h"

namespace swarmsmith {

/// The parameter space of Maple's trees: NumSubtrees, and for each subtree an action and a
/// condition with their parameters, in the same form as for machines (docs/methods.md; 45
/// parameters for all modules of `watermelon`, 41 for `chocolate`).
class TreeSpace {
 public:
  /// `digits`: decimals of real parameters. Fails if they are not enough for a range.
  static Expected<TreeSpace> make(const Method& method, const Flavour& flavour, int digits);

  /// The same space in the words of the text grammar, like MachineSpace::in_grammar: the switches
  /// and values of the active parameters form the text of a tree.
  static Expected<ParameterSpace> in_grammar(const Method& method, const Flavour& flavour,
                                             int digits);

  const ParameterSpace& parameters() const { return space_; }

  /// Converts between trees and valid configurations of this space.
  Tree to_tree(const Configuration& configuration) const;
  Configuration from_tree(const Tree& tree) const;

 private:
  /// The indices of one subtree's parameters.
  struct SubtreeSlot {
    std::size_t action = 0;
    std::vector<ModuleSlot> actions;
    std::size_t condition = 0;
    std::vector<ModuleSlot> conditions;
  };

  /// The indices of a tree's parameters.
  struct TreeSlot {
    std::size_t count = kNoParameter;
    std::vector<SubtreeSlot> subtrees;
  };

  TreeSpace(ParameterSpace space, const Flavour& flavour, TreeSlot slot)
      : space_(std::move(space)), flavour_(&flavour), slot_(std::move(slot)) {}

  static TreeSlot build(const Method& method, ModuleParameters& parameters);

  ParameterSpace space_;
  const Flavour* flavour_;
  TreeSlot slot_;
};

}  // namespace swarmsmith
