#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// The configurations that the run of a scenario found, by irace's ids.
struct StoredConfigurations {
  std::map<std::int64_t, Configuration> all;
  std::map<std::int64_t, std::vector<std::int64_t>> elites;  ///< by iteration, best first

  /// Adds the id to a list, unless the list has it, or another one with equal values: a run may
  /// sample a configuration twice, and a race or a file of configurations has each only once.
  void add_to(std::vector<std::int64_t>& ids, std::int64_t id) const;
  /// The error NotFound lists the existing ids.
  Expected<Configuration> find(std::int64_t id, const std::string& option) const;
};

/// From the row of a candidate; empty if it does not belong to the space.
std::optional<Configuration> configuration_of(const ParameterSpace& space,
                                              const CandidateRow& candidate);

/// Reads the store of a run of this scenario. An error if there is no such store, if the run is not
/// finished, or if it has other parameters.
Expected<StoredConfigurations> read_stored_configurations(const std::filesystem::path& store,
                                                          const ParameterSpace& space);

}  // namespace swarmsmith::cli
