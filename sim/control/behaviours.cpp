#include "sim/control/behaviours.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "sim/control/internal/module_kinds.h"

namespace swarmsmith {

Module module_of(const Behaviour& behaviour) {
  if (const auto* external = std::get_if<ExternalBehaviour>(&behaviour))
    return external_behaviour(external->number);
  return module_at<Behaviour>(behaviour.index());
}

std::vector<double> parameters_of(const Behaviour& behaviour) {
  return values_of(behaviour);
}

Behaviour make_behaviour(Module module, std::span<const double> parameters) {
  if (is_external(module) && is_behaviour(module)) {
    const int number = static_cast<int>(module) - static_cast<int>(external_behaviour(0));
    return ExternalBehaviour{number, {parameters.begin(), parameters.end()}};
  }
  const auto made = made_of<Behaviour>(module, parameters);
  if (!made) throw std::invalid_argument(std::string(id_of(module)) + " is not a behaviour");
  return *made;
}

Command act(const Behaviour& behaviour, Senses& senses, const Flavour& flavour,
            BehaviourMemory& memory, Rng& rng) {
  return std::visit([&](const auto& kind) { return kind.act(senses, flavour, memory, rng); },
                    behaviour);
}

UsedSenses senses_used_by(const Behaviour& behaviour, const Flavour& flavour) {
  return std::visit([&](const auto& kind) { return kind.uses(flavour); }, behaviour);
}

}  // namespace swarmsmith
