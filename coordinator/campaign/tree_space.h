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
/// condition with their parameters, as machines have them (docs/methods.md; 45 parameters for
/// everything that `watermelon` has, 41 for `chocolate`).
class TreeSpace {
 public:
  /// `digits`: decimals of reals. Fails when a range cannot be kept with these digits.
  static Expected<TreeSpace> make(const Method& method, const Flavour& flavour, int digits);

  /// The same space in the words of the text grammar, as MachineSpace::in_grammar has it: switches
  /// and values of the active parameters, put together, are the text of a tree.
  static Expected<ParameterSpace> in_grammar(const Method& method, const Flavour& flavour,
                                             int digits);

  const ParameterSpace& parameters() const { return space_; }

  /// The tree of a valid configuration of this space, and back.
  Tree to_tree(const Configuration& configuration) const;
  Configuration from_tree(const Tree& tree) const;

 private:
  /// Where the parameters of one subtree are.
  struct SubtreeSlot {
    std::size_t action = 0;
    std::vector<ModuleSlot> actions;
    std::size_t condition = 0;
    std::vector<ModuleSlot> conditions;
  };

  /// Where the parameters of a tree are.
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
