#include "sim/control/used_senses.h"

#include <cstddef>
#include <variant>
#include <vector>

#include "base/overloaded.h"

namespace swarmsmith {
UsedSenses senses_used_by(const Controller& controller, const Flavour& flavour) {
  UsedSenses used;
  std::visit(Overloaded{[&](const Machine& machine) {
                          const std::vector<bool> reachable = reachable_states(machine);
                          for (std::size_t i = 0; i < machine.states.size(); ++i) {
                            if (!reachable[i]) continue;
                            const State& state = machine.states[i];
                            used = used | senses_used_by(state.behaviour, flavour);
                            for (const Transition& transition : state.transitions)
                              used = used | senses_used_by(transition.condition);
                          }
                        },
                        [&](const Tree& tree) {
                          for (const Subtree& subtree : tree.subtrees) {
                            used = used | senses_used_by(subtree.condition);
                            used = used | senses_used_by(subtree.action, flavour);
                          }
                        },
                        [&](const Network& network) {
                          used = {.proximity = true,
                                  .ground_color = true,
                                  .neighbours = true,
                                  .light = network.inputs == NetworkInputs::Rm12 ||
                                           network.inputs == NetworkInputs::Rm11};
                        }},
             controller);
  return used;
}

}  // namespace swarmsmith
