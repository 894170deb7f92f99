#include "sim/control/conditions.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "sim/control/internal/module_kinds.h"

namespace swarmsmith {

Module module_of(const Condition& condition) {
  if (const auto* external = std::get_if<ExternalCondition>(&condition))
    return external_condition(external->number);
  return module_at<Condition>(condition.index());
}

std::vector<double> parameters_of(const Condition& condition) {
  return values_of(condition);
}

Condition make_condition(Module module, std::span<const double> parameters) {
  if (is_external(module) && !is_behaviour(module)) {
    const int number = static_cast<int>(module) - static_cast<int>(external_condition(0));
    return ExternalCondition{number, {parameters.begin(), parameters.end()}};
  }
  const auto made = made_of<Condition>(module, parameters);
  if (!made) throw std::invalid_argument(std::string(id_of(module)) + " is not a condition");
  return *made;
}

double enabling_probability(const Condition& condition, Senses& senses, const Flavour& flavour) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) { return kind.enabling(Kind::Reads::of(senses), flavour); },
      condition);
}

UsedSenses senses_used_by(const Condition& condition) {
  return std::visit([]<class Kind>(const Kind& /*kind*/) { return Kind::Reads::kUses; }, condition);
}

}  // namespace swarmsmith
