#include "sim/control/flavour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "base/suggestion.h"
#include "base/text/toml_text.h"
#include "sim/control/internal/module_kinds.h"

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

using Type = ParameterSpec::Type;

}  // namespace

std::optional<std::string> complaint_about(const ParameterSpec& parameter, double value) {
  if (parameter.type != Type::Real && value != std::floor(value)) {
    return parameter.name + " must be an integer";
  }
  const bool above = parameter.least_included ? value >= parameter.least : value > parameter.least;
  if (above && value <= parameter.most) return std::nullopt;
  std::string range = parameter.least_included ? "at least " : "more than ";
  range += number_text(parameter.least);
  if (parameter.most < kLargest) range += " and at most " + number_text(parameter.most);
  return parameter.name + " must be " + range;
}

std::vector<ParameterSpec> parameters_of_kind(Module module) {
  if (is_external(module)) return {};
  return is_behaviour(module) ? parameters_of_kind<Behaviour>(module)
                              : parameters_of_kind<Condition>(module);
}

const ModuleSpec* Flavour::find(Module module) const {
  for (const auto* table : {&behaviours, &conditions}) {
    for (const ModuleSpec& spec : *table) {
      if (spec.module == module) return &spec;
    }
  }
  return nullptr;
}

const ModuleSpec* Flavour::find(std::string_view id) const {
  for (const auto* table : {&behaviours, &conditions}) {
    for (const ModuleSpec& spec : *table) {
      if (spec.id == id) return &spec;
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

Expected<const Flavour*> find_flavour(std::string_view name, const Flavour* own) {
  if (own != nullptr) return own;
  std::vector<std::string> known;
  for (const Flavour* flavour : all_flavours()) {
    if (flavour->name == name) return flavour;
    known.push_back(flavour->name);
  }
  return unexpected(ErrorKind::NotFound, "there is no flavour `" + std::string(name) + "`" +
                                             did_you_mean(name, known) +
                                             "; known are: " + joined(known));
}

Expected<Flavour> find_flavour(std::string_view name, TurnClock turn_clock, const Flavour* own) {
  const Expected<const Flavour*> known = find_flavour(name, own);
  if (!known) return Unexpected(known.error());
  Flavour flavour = **known;
  flavour.exploration.turn_clock = turn_clock;
  return flavour;
}

std::vector<const Flavour*> flavours_for(std::string_view reference) {
  std::vector<const Flavour*> flavours;
  for (const Flavour* flavour : all_flavours()) {
    if (flavour->reference == reference) flavours.push_back(flavour);
  }
  return flavours;
}

const Flavour* kept_flavour(Flavour flavour) {
  if (const auto ours = find_flavour(flavour.name); ours && **ours == flavour) return nullptr;
  static std::mutex mutex;
  static std::deque<Flavour> kept;
  const std::lock_guard lock(mutex);
  const auto known = std::ranges::find(kept, flavour);
  return known != kept.end() ? &*known : &kept.emplace_back(std::move(flavour));
}

}  // namespace swarmsmith
