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

/// What a run of a scenario found, by irace's ids.
struct StoredConfigurations {
  std::map<std::int64_t, Configuration> all;
  std::map<std::int64_t, std::vector<std::int64_t>> elites;  ///< by iteration, best first

  /// NotFound with the ids that there are.
  Expected<Configuration> find(std::int64_t id, const std::string& option) const;
};

/// Of a row of a candidate; nothing when it is not one of the space.
std::optional<Configuration> configuration_of(const ParameterSpace& space,
                                              const CandidateRow& candidate);

/// Of a store of this scenario's run; an error when there is none, none that is over, or one of
/// other parameters.
Expected<StoredConfigurations> read_stored_configurations(const std::filesystem::path& store,
                                                          const ParameterSpace& space);

}  // namespace swarmsmith::cli
