#include "cli/irace/stored_configurations.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "cli/irace/parameter_values.h"
#include "storage/store.h"

namespace swarmsmith::cli {

std::optional<Configuration> configuration_of(const ParameterSpace& space,
                                              const CandidateRow& candidate) {
  const auto values = parse_parameter_values(candidate.parameters);
  if (!values) return std::nullopt;
  Configuration configuration(space.size());
  for (const auto& [name, value] : *values) {
    const auto index = space.index_of(name);
    if (!index) return std::nullopt;
    const auto* number = std::get_if<double>(&value);
    if (space.is_numeric(*index)) {
      if (number == nullptr) return std::nullopt;
      configuration.set(*index, *number);
      continue;
    }
    const auto* text = std::get_if<std::string>(&value);
    for (std::size_t i = 0; text != nullptr && i < space.value_count(*index); ++i) {
      const auto position = static_cast<double>(i);
      if (space.scalar(*index, position).text == *text) configuration.set(*index, position);
    }
  }
  if (!space.check(configuration)) return std::nullopt;
  return configuration;
}

void StoredConfigurations::add_to(std::vector<std::int64_t>& ids, std::int64_t id) const {
  const Configuration& values = all.at(id);
  if (std::ranges::none_of(ids, [&](std::int64_t other) { return all.at(other) == values; }))
    ids.push_back(id);
}

Expected<Configuration> StoredConfigurations::find(std::int64_t id,
                                                   const std::string& option) const {
  const auto found = all.find(id);
  if (found != all.end()) return found->second;
  return unexpected(ErrorKind::NotFound,
                    "there is no configuration " + std::to_string(id) + ": the run has 1 to " +
                        std::to_string(all.size()) + " (`swarmsmith ls candidates` lists them)",
                    option);
}

Expected<StoredConfigurations> read_stored_configurations(const std::filesystem::path& store,
                                                          const ParameterSpace& space) {
  auto reader = StoreReader::open(store);
  if (!reader) return Unexpected(reader.error());
  StoredConfigurations stored;
  std::optional<Error> error;
  (*reader)->each_answer_row([&](const Row& row) {
    if (const auto* elite = std::get_if<EliteRow>(&row)) {
      stored.elites[elite->iteration].push_back(number_of(elite->candidate));
    }
    const auto* candidate = std::get_if<CandidateRow>(&row);
    if (candidate == nullptr || error) return;
    if (auto configuration = configuration_of(space, *candidate)) {
      stored.all.emplace(number_of(candidate->id), std::move(*configuration));
    } else {
      error = Error{ErrorKind::Conflict,
                    "its configuration " + std::to_string(number_of(candidate->id)) +
                        " is not one of these parameters: give the scenario that made this store",
                    store.string()};
    }
  });
  if (error) return Unexpected(std::move(*error));
  if (stored.elites.empty() || !(*reader)->finished()) {
    return bad_input("the run is not over: give the same command without this option first",
                     store.string());
  }
  return stored;
}

}  // namespace swarmsmith::cli
