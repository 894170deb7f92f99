#include "sim/control/conditions.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "sim/control/internal/module_kinds.h"

namespace swarmsmith {

Module module_of(const Condition& condition) {
  return module_at<Condition>(condition.index());
}

std::vector<double> parameters_of(const Condition& condition) {
  return values_of(condition);
}

Condition make_condition(Module module, std::span<const double> parameters) {
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

std::vector<ModuleSpec> conditions_of(std::string_view flavour) {
  return specs_of<Condition>(flavour);
}

}  // namespace swarmsmith
