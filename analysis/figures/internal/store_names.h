#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// What a store has names for, each in a fixed order (`NameOrder`).
/// A thing's place is its colour in every figure of the store, whatever a figure leaves out.
struct StoreNames {
  std::vector<std::string> methods;          ///< of all designs
  std::vector<std::string> missions;         ///< of all designs
  std::vector<std::string> sources;          ///< of all scores of winners, where asked for
  std::map<std::string, std::string> units;  ///< by mission: what its scores count, where known

  /// The mission in words, with its unit in brackets: "aggregation (robots)".
  std::string title_of(const std::string& mission) const;
};

/// All but the sources, for which the store reads all scores.
Expected<StoreNames> names_of(StoreReader& store);
Expected<StoreNames> names_with_sources(StoreReader& store);

/// The number of names when it is none of them.
std::size_t place_of(const std::vector<std::string>& names, std::string_view name);

}  // namespace swarmsmith
