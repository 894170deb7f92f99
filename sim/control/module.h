#pragma once

#include <optional>
#include <string_view>

namespace swarmsmith {

/// The kinds of module that control software is put together from: behaviours, then conditions.
/// Outside the program a module is known by its id (`neighbour_count`); numbers exist only in the
/// texts of a flavour's grammar and are translated by its table.
enum class Module {
  Exploration,
  Stop,
  Phototaxis,
  AntiPhototaxis,
  Attraction,
  Repulsion,
  BlackFloor,
  GrayFloor,
  WhiteFloor,
  NeighbourCount,
  InvertedNeighbourCount,
  FixedProbability,
  ColorDetection,
};

/// The module's id: lower case, words joined by underscores. What stores and views show.
std::string_view id_of(Module module);

/// The module with this id, if there is one.
std::optional<Module> module_from_id(std::string_view id);

}  // namespace swarmsmith
