#include "sim/control/control_software.h"

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

using Running = std::variant<MachineControl, TreeControl, NetworkControl>;

Running run(const Controller& controller, const Flavour& flavour, Rng rng) {
  return std::visit(
      Overloaded{
          [&](const Machine& machine) -> Running { return MachineControl(machine, flavour, rng); },
          [&](const Tree& tree) -> Running { return TreeControl(tree, flavour, rng); },
          [&](const Network& network) -> Running { return NetworkControl(network, flavour); }},
      controller);
}

}  // namespace

Rng control_stream(std::int64_t seed, int robot) {
  return Rng(static_cast<std::uint64_t>(seed)).split("control", static_cast<std::uint64_t>(robot));
}

ControlSoftware::ControlSoftware(const Controller& controller, const Flavour& flavour, Rng rng)
    : running_(run(controller, flavour, rng)) {}

}  // namespace swarmsmith
