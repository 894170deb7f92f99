#include "sim/control/sensors.h"

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

Sensors obstacles(const Flavour& flavour) {
  return flavour.obstacles.neighbours_as_obstacles ? Sensor::Proximity | Sensor::Neighbours
                                                   : Sensors(Sensor::Proximity);
}

Sensors sensors_of(const Behaviour& behaviour, const Flavour& flavour) {
  const Sensors around = obstacles(flavour);
  return std::visit(
      Overloaded{[&](const Exploration&) { return around; }, [](const Stop&) { return Sensors(); },
                 [&](const Phototaxis&) { return around | Sensor::LightRing; },
                 [&](const AntiPhototaxis&) { return around | Sensor::LightRing; },
                 [&](const Attraction&) { return around | Sensor::Neighbours; },
                 [&](const Repulsion&) { return around | Sensor::Neighbours; }},
      behaviour);
}

Sensors sensors_of(const Condition& condition) {
  return std::visit(
      Overloaded{[](const NeighbourCount&) { return Sensors(Sensor::Neighbours); },
                 [](const InvertedNeighbourCount&) { return Sensors(Sensor::Neighbours); },
                 [](const FixedProbability&) { return Sensors(); },
                 [](const auto& /*floor*/) { return Sensors(Sensor::GroundColor); }},
      condition);
}

Sensors sensors_of(const Machine& machine, const Flavour& flavour) {
  const std::vector<bool> reachable = reachable_states(machine);
  Sensors all;
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    if (!reachable[i]) continue;
    all = all | sensors_of(machine.states[i].behaviour, flavour);
    for (const Transition& transition : machine.states[i].transitions)
      all = all | sensors_of(transition.condition);
  }
  return all;
}

Sensors sensors_of(const Tree& tree, const Flavour& flavour) {
  Sensors all;
  for (const Subtree& subtree : tree.subtrees)
    all = all | sensors_of(subtree.action, flavour) | sensors_of(subtree.condition);
  return all;
}

/// All its inputs in each cycle.
Sensors sensors_of(const Network& network, const Flavour& flavour) {
  const Sensors all = obstacles(flavour) | Sensor::GroundColor | Sensor::Neighbours;
  return network.inputs == NetworkInputs::Rm12 ? all | Sensor::LightRing : all;
}

}  // namespace

Sensors sensors_of(const Controller& controller, const Flavour& flavour) {
  return std::visit([&](const auto& one) { return sensors_of(one, flavour); }, controller);
}

}  // namespace swarmsmith
