#include "sim/control/module_parts.h"

#include <limits>
#include <utility>

namespace swarmsmith {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
/// Sums of weights up to this, and their squares, are far from overflow.
constexpr double kLargestWeight = 1'000'000;

using Type = ParameterSpec::Type;

}  // namespace

ParameterSpec beta_parameter() {
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

ParameterSpec alpha_parameter(std::string symbol, std::string token) {
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

ParameterSpec xi_parameter(std::string symbol) {
  return {.name = "xi",
          .symbol = std::move(symbol),
          .token = "p",
          .type = Type::Integer,
          .low = 0,
          .high = 10,
          .digits = 0,
          .least = 0,
          .most = kLargestCount};
}

ParameterSpec eta_parameter(std::string symbol) {
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

}  // namespace swarmsmith
