#include "analysis/figures/internal/parameter_words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "analysis/records/names.h"

namespace swarmsmith {
namespace {

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// "0" stays, "0x1" becomes "0.1"; empty if the text is not a place.
std::optional<std::string> place_in(std::string_view text) {
  std::string place(text);
  const std::size_t cross = place.find('x');
  if (cross != std::string::npos) place[cross] = '.';
  const bool is_place =
      !place.empty() && is_digit(place.front()) && is_digit(place.back()) &&
      std::ranges::all_of(place, [](char letter) { return is_digit(letter) || letter == '.'; });
  return is_place ? std::optional(place) : std::nullopt;
}

/// "exploration tau", or "beta" if several modules have the symbol; empty if no module has it.
std::string parameter_of(std::string_view symbol, const std::vector<ModuleSpec>& modules) {
  std::string found;
  std::string shared;
  for (const ModuleSpec& module : modules) {
    for (const ParameterSpec& parameter : module.parameters) {
      if (parameter.symbol != symbol) continue;
      shared = parameter.name;
      found = found.empty() ? as_words(module.id) + " " + parameter.name : shared;
    }
  }
  return found;
}

}  // namespace

std::string words_of_parameter(std::string_view name, const Flavour& flavour) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOfMachines = {
      {{"S", "behaviour"}, {"C", "condition"}, {"N", "target"}, {"NumConnections", "edges of"}}};
  if (name == "NumStates") return "states";
  const auto begin = std::ranges::find_if(name, is_digit);
  const std::string_view symbol = name.substr(0, static_cast<std::size_t>(begin - name.begin()));
  const auto place = place_in(name.substr(symbol.size()));
  if (!place) return std::string(name);
  const auto* known =
      std::ranges::find(kOfMachines, symbol, &std::pair<std::string_view, std::string_view>::first);
  std::string words(known != kOfMachines.end() ? known->second : "");
  if (words.empty()) words = parameter_of(symbol, flavour.behaviours);
  if (words.empty()) words = parameter_of(symbol, flavour.conditions);
  return words.empty() ? std::string(name) : words + " " + *place;
}

}  // namespace swarmsmith
