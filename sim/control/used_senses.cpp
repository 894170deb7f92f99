#include "sim/control/used_senses.h"

#include <cstddef>
#include <variant>
#include <vector>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

void add_avoidance(const Flavour& flavour, UsedSenses& used) {
  used.proximity = true;
  if (flavour.obstacles.neighbours_as_obstacles) used.neighbours = true;
}

void add(const Behaviour& behaviour, const Flavour& flavour, UsedSenses& used) {
  const auto follows_light = [&] {
    used.light = true;
    add_avoidance(flavour, used);
  };
  const auto follows_neighbours = [&] {
    used.neighbours = true;
    add_avoidance(flavour, used);
  };
  std::visit(Overloaded{[&](const Exploration&) { add_avoidance(flavour, used); },
                        [](const Stop&) {}, [&](const Phototaxis&) { follows_light(); },
                        [&](const AntiPhototaxis&) { follows_light(); },
                        [&](const Attraction&) { follows_neighbours(); },
                        [&](const Repulsion&) { follows_neighbours(); }},
             behaviour);
}

void add(const Condition& condition, UsedSenses& used) {
  std::visit(Overloaded{[&](const BlackFloor&) { used.ground_color = true; },
                        [&](const GrayFloor&) { used.ground_color = true; },
                        [&](const WhiteFloor&) { used.ground_color = true; },
                        [&](const ColorDetection&) { used.ground_color = true; },
                        [&](const NeighbourCount&) { used.neighbours = true; },
                        [&](const InvertedNeighbourCount&) { used.neighbours = true; },
                        [](const FixedProbability&) {}},
             condition);
}

}  // namespace

UsedSenses senses_used_by(const Controller& controller, const Flavour& flavour) {
  UsedSenses used;
  std::visit(Overloaded{[&](const Machine& machine) {
                          const std::vector<bool> reachable = reachable_states(machine);
                          for (std::size_t i = 0; i < machine.states.size(); ++i) {
                            if (!reachable[i]) continue;
                            const State& state = machine.states[i];
                            add(state.behaviour, flavour, used);
                            for (const Transition& transition : state.transitions)
                              add(transition.condition, used);
                          }
                        },
                        [&](const Tree& tree) {
                          for (const Subtree& subtree : tree.subtrees) {
                            add(subtree.condition, used);
                            add(subtree.action, flavour, used);
                          }
                        },
                        [&](const Network& network) {
                          used = {.proximity = true,
                                  .ground_color = true,
                                  .neighbours = true,
                                  .light = network.inputs == NetworkInputs::Rm12};
                        }},
             controller);
  return used;
}

}  // namespace swarmsmith
