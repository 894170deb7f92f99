#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// The names in a store, each list in a fixed order (`NameOrder`).
/// The index of a name decides its colour in every figure of the store, even if a figure leaves out
/// other names.
struct StoreNames {
  std::vector<std::string> methods;          ///< of all designs
  std::vector<std::string> missions;         ///< of all designs
  std::vector<std::string> sources;          ///< of all scores of winners, if requested
  std::map<std::string, std::string> units;  ///< by mission: the unit of its scores, if known

  /// The mission in words, with its unit in brackets: "aggregation (robots)".
  std::string title_of(const std::string& mission) const;
};

/// All names except sources, for which the store would have to read all scores.
Expected<StoreNames> names_of(StoreReader& store);
Expected<StoreNames> names_with_sources(StoreReader& store);

/// The index of a name; the number of names if it is not among them.
std::size_t place_of(const std::vector<std::string>& names, std::string_view name);

}  // namespace swarmsmith
