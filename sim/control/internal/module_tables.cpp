#include "sim/control/internal/module_tables.h"

#include <limits>
#include <string>
#include <utility>

// The search ranges are those of the published program's irace file (rvr-automode facts, section
// 6.4).

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLargestCount = 1'000'000;
/// Sums of such weights, and their squares, are far from overflow.
constexpr double kLargestWeight = 1'000'000;

using Type = ParameterSpec::Type;

/// Bound of a turn in cycles: 1..100 in the search.
ParameterSpec tau() {
  return {.name = "tau",
          .symbol = "RWM",
          .token = "rwm",
          .type = Type::Integer,
          .low = 1,
          .high = 100,
          .digits = 0,
          .least = 1,
          .most = kLargestCount};
}

/// Weight of the neighbours: 1..5 in the search, two decimals.
ParameterSpec alpha(std::string symbol, std::string token) {
  return {.name = "alpha",
          .symbol = std::move(symbol),
          .token = std::move(token),
          .type = Type::Real,
          .low = 1,
          .high = 5,
          .digits = 2,
          .least = 0,
          .most = kLargestWeight,
          .least_included = false};
}

ParameterSpec beta() {
  return {.name = "beta",
          .symbol = "P",
          .token = "p",
          .type = Type::Real,
          .low = 0,
          .high = 1,
          .digits = 2,
          .least = 0,
          .most = 1};
}

/// The count at which the sigmoid is one half; the flavours search from different ends.
ParameterSpec xi(std::string symbol, int lowest) {
  return {.name = "xi",
          .symbol = std::move(symbol),
          .token = "p",
          .type = Type::Integer,
          .low = static_cast<double>(lowest),
          .high = 10,
          .digits = 0,
          .least = 0,
          .most = kLargestCount};
}

ParameterSpec eta(std::string symbol) {
  return {.name = "eta",
          .symbol = std::move(symbol),
          .token = "w",
          .type = Type::Real,
          .low = 0,
          .high = 20,
          .digits = 2,
          .least = 0,
          .most = kLargest};
}

ParameterSpec label() {
  return {.name = "label",
          .symbol = "L",
          .token = "l",
          .type = Type::Label,
          .low = 0,
          .high = 3,
          .digits = 0,
          .least = 0,
          .most = 3};
}

}  // namespace

std::vector<ModuleSpec> watermelon_behaviours() {
  return {{Module::Exploration, 0, {tau()}},
          {Module::Stop, 1, {}},
          {Module::Attraction, 2, {alpha("ATT", "att")}},
          {Module::Repulsion, 3, {alpha("REP", "rep")}}};
}

std::vector<ModuleSpec> watermelon_conditions(int lowest_xi) {
  return {{Module::BlackFloor, 0, {beta()}},
          {Module::GrayFloor, 1, {beta()}},
          {Module::WhiteFloor, 2, {beta()}},
          {Module::NeighbourCount, 3, {xi("B", lowest_xi), eta("W")}},
          {Module::InvertedNeighbourCount, 4, {xi("BI", lowest_xi), eta("WI")}},
          {Module::FixedProbability, 5, {beta()}},
          {Module::ColorDetection, 6, {beta(), label()}}};
}

std::vector<LabelSpec> watermelon_labels() {
  return {{ColorLabel::Green, 0, 120, 1},
          {ColorLabel::Blue, 1, 240, 1},
          {ColorLabel::Red, 2, 0, 1},
          {ColorLabel::Yellow, 3, 60, 1}};
}

std::vector<ModuleSpec> chocolate_behaviours() {
  return {{Module::Exploration, 0, {tau()}},
          {Module::Stop, 1, {}},
          {Module::Phototaxis, 2, {}},
          {Module::AntiPhototaxis, 3, {}},
          {Module::Attraction, 4, {alpha("ATT", "att")}},
          {Module::Repulsion, 5, {alpha("REP", "rep")}}};
}

std::vector<ModuleSpec> chocolate_conditions() {
  std::vector<ModuleSpec> conditions = watermelon_conditions(0);
  conditions.pop_back();  // colours are TuttiFrutti's and Watermelon's
  return conditions;
}

}  // namespace swarmsmith
