#include "sim/control/flavour.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/suggestion.h"

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

using Type = ParameterSpec::Type;

/// A bound as people write it: 5, 0.5, 1000000.
std::string text_of(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> complaint_about(const ParameterSpec& parameter, double value) {
  if (parameter.type != Type::Real && value != std::floor(value)) {
    return parameter.name + " must be an integer";
  }
  const bool above = parameter.least_included ? value >= parameter.least : value > parameter.least;
  if (above && value <= parameter.most) return std::nullopt;
  std::string range = parameter.least_included ? "at least " : "more than ";
  range += text_of(parameter.least);
  if (parameter.most < kLargest) range += " and at most " + text_of(parameter.most);
  return parameter.name + " must be " + range;
}

const ModuleSpec* Flavour::find(Module module) const {
  for (const auto* table : {&behaviours, &conditions}) {
    for (const ModuleSpec& spec : *table) {
      if (spec.module == module) return &spec;
    }
  }
  return nullptr;
}

std::string_view name_of(ColorLabel label) {
  static constexpr std::array<std::string_view, 4> kNames = {"green", "blue", "red", "yellow"};
  return kNames[static_cast<std::size_t>(label)];
}

std::string_view name_of(TurnClock clock) {
  return clock == TurnClock::Cycles ? "cycles" : "seconds";
}

Expected<const Flavour*> find_flavour(std::string_view name) {
  std::vector<std::string> known;
  for (const Flavour* flavour : all_flavours()) {
    if (flavour->name == name) return flavour;
    known.push_back(flavour->name);
  }
  return unexpected(ErrorKind::NotFound, "there is no flavour `" + std::string(name) + "`" +
                                             did_you_mean(name, known) +
                                             "; known are: " + joined(known));
}

Expected<Flavour> find_flavour(std::string_view name, TurnClock turn_clock) {
  const Expected<const Flavour*> known = find_flavour(name);
  if (!known) return Unexpected(known.error());
  Flavour flavour = **known;
  flavour.exploration.turn_clock = turn_clock;
  return flavour;
}

}  // namespace swarmsmith
