#include "sim/control/conditions.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "base/math.h"
#include "base/overloaded.h"
#include "sim/control/flavour.h"
#include "sim/control/readings.h"

namespace swarmsmith {
namespace {

void need_parameters(std::span<const double> parameters, std::size_t count) {
  if (parameters.size() == count) return;
  throw std::invalid_argument("a condition takes " + std::to_string(count) + " parameters, not " +
                              std::to_string(parameters.size()));
}

std::size_t parameter_count(Module module) {
  const bool two = module == Module::NeighbourCount || module == Module::InvertedNeighbourCount ||
                   module == Module::ColorDetection;
  return two ? 2 : 1;
}

int count_neighbours(Senses& senses) {
  return static_cast<int>(senses.neighbours().size());
}

}  // namespace

std::string_view name_of(ColorLabel label) {
  static constexpr std::array<std::string_view, 4> kNames = {"green", "blue", "red", "yellow"};
  return kNames[static_cast<std::size_t>(label)];
}

Module module_of(const Condition& condition) {
  return std::visit(
      Overloaded{[](const BlackFloor&) { return Module::BlackFloor; },
                 [](const GrayFloor&) { return Module::GrayFloor; },
                 [](const WhiteFloor&) { return Module::WhiteFloor; },
                 [](const NeighbourCount&) { return Module::NeighbourCount; },
                 [](const InvertedNeighbourCount&) { return Module::InvertedNeighbourCount; },
                 [](const FixedProbability&) { return Module::FixedProbability; },
                 [](const ColorDetection&) { return Module::ColorDetection; }},
      condition);
}

std::vector<double> parameters_of(const Condition& condition) {
  using Values = std::vector<double>;
  return std::visit(Overloaded{[](const BlackFloor& c) { return Values{c.probability}; },
                               [](const GrayFloor& c) { return Values{c.probability}; },
                               [](const WhiteFloor& c) { return Values{c.probability}; },
                               [](const NeighbourCount& c) {
                                 return Values{static_cast<double>(c.xi), c.eta};
                               },
                               [](const InvertedNeighbourCount& c) {
                                 return Values{static_cast<double>(c.xi), c.eta};
                               },
                               [](const FixedProbability& c) { return Values{c.probability}; },
                               [](const ColorDetection& c) {
                                 return Values{c.probability, static_cast<double>(c.label)};
                               }},
                    condition);
}

Condition make_condition(Module module, std::span<const double> parameters) {
  need_parameters(parameters, parameter_count(module));
  switch (module) {
    case Module::BlackFloor:
      return BlackFloor{parameters[0]};
    case Module::GrayFloor:
      return GrayFloor{parameters[0]};
    case Module::WhiteFloor:
      return WhiteFloor{parameters[0]};
    case Module::NeighbourCount:
      return NeighbourCount{.eta = parameters[1], .xi = static_cast<int>(parameters[0])};
    case Module::InvertedNeighbourCount:
      return InvertedNeighbourCount{.eta = parameters[1], .xi = static_cast<int>(parameters[0])};
    case Module::FixedProbability:
      return FixedProbability{parameters[0]};
    case Module::ColorDetection:
      return ColorDetection{parameters[0], static_cast<ColorLabel>(parameters[1])};
    case Module::Exploration:
    case Module::Stop:
    case Module::Phototaxis:
    case Module::AntiPhototaxis:
    case Module::Attraction:
    case Module::Repulsion:
      break;
  }
  throw std::invalid_argument(std::string(id_of(module)) + " is not a condition");
}

double neighbour_sigmoid(double eta, int xi, int neighbours) {
  return 1.0 / (1.0 + exp(eta * (xi - neighbours)));
}

double enabling_probability(const Condition& condition, Senses& senses, const Flavour& flavour) {
  const FloorModel& floor = flavour.floor;
  const auto on_gray = [&senses](const GrayRange& range, double probability) {
    return range.contains(gray_level(senses.ground_color())) ? probability : 0.0;
  };
  return std::visit(
      Overloaded{[&](const BlackFloor& c) { return on_gray(floor.black, c.probability); },
                 [&](const GrayFloor& c) { return on_gray(floor.gray, c.probability); },
                 [&](const WhiteFloor& c) { return on_gray(floor.white, c.probability); },
                 [&](const NeighbourCount& c) {
                   return neighbour_sigmoid(c.eta, c.xi, count_neighbours(senses));
                 },
                 [&](const InvertedNeighbourCount& c) {
                   return 1.0 - neighbour_sigmoid(c.eta, c.xi, count_neighbours(senses));
                 },
                 [](const FixedProbability& c) { return c.probability; },
                 [&](const ColorDetection& c) {
                   const bool seen = perceived_label(senses.ground_color(), floor) == c.label;
                   return seen ? c.probability : 0.0;
                 }},
      condition);
}

}  // namespace swarmsmith
