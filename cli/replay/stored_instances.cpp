#include "cli/replay/stored_instances.h"

#include <algorithm>
#include <map>

#include "cli/output/query_output.h"
#include "cli/replay/design_worlds.h"
#include "sim/mission/instance_csv.h"

namespace swarmsmith::cli {
namespace {

/// Seeds of simulated tests and later evaluations; real runs have no seed.
Expected<std::map<DesignId, std::set<std::int64_t>>> seeds_by_design(StoreReader& store) {
  const auto rows =
      select(store, "SELECT DISTINCT design, seed FROM v_design_scores WHERE seed IS NOT NULL",
             {.rows = 10'000'000, .seconds = 600, .bytes = std::int64_t{1} << 32U});
  if (!rows) return Unexpected(rows.error());
  std::map<DesignId, std::set<std::int64_t>> seeds;
  for (const auto& cells : rows->cells)
    seeds[{cells[0].integer()}].insert(cells[1].integer());
  return seeds;
}

/// The entry of that mission; added if there is none.
ScoredMission& entry_of(std::vector<ScoredMission>& all, const Mission& mission) {
  const auto same = std::ranges::find(all, mission, &ScoredMission::mission);
  if (same != all.end()) return *same;
  const auto namesakes = std::ranges::count_if(
      all, [&](const ScoredMission& other) { return other.mission.name == mission.name; });
  const std::string number = namesakes == 0 ? "" : "-" + std::to_string(namesakes + 1);
  return all.emplace_back(ScoredMission{mission.name + number, mission, {}});
}

Expected<std::map<std::int64_t, Instance>> instances_of(const ScoredMission& scored) {
  std::map<std::int64_t, Instance> instances;
  for (const std::int64_t seed : scored.seeds) {
    auto instance = instance_of(scored.mission, seed);
    if (!instance) return Unexpected(instance.error());
    instances.emplace(seed, std::move(*instance));
  }
  return instances;
}

}  // namespace

Expected<std::vector<ScoredMission>> scored_missions(StoreReader& store,
                                                     const MissionFilter& filter) {
  const auto worlds = DesignWorlds::read(store);
  if (!worlds) return Unexpected(worlds.error());
  const auto seeds = seeds_by_design(store);
  if (!seeds) return Unexpected(seeds.error());
  std::vector<ScoredMission> all;
  for (const KnownDesign& known : worlds->designs()) {
    if (filter.design && known.id != *filter.design) continue;
    if (!filter.mission.empty() && known.mission != filter.mission) continue;
    const auto found = seeds->find(known.id);
    if (found == seeds->end()) continue;
    const auto world = worlds->of(known.id);
    if (!world) return Unexpected(world.error());
    if (!*world || !(*world)->mission) continue;
    entry_of(all, (*world)->mission->mission).seeds.merge(std::set(found->second));
  }
  return all;
}

Expected<std::string> starts_table(const ScoredMission& scored) {
  const auto instances = instances_of(scored);
  if (!instances) return Unexpected(instances.error());
  return starts_csv(*instances);
}

Expected<std::string> patches_table(const ScoredMission& scored) {
  if (scored.mission.shuffled.places.empty()) return std::string();
  const auto instances = instances_of(scored);
  if (!instances) return Unexpected(instances.error());
  return patches_csv(*instances);
}

}  // namespace swarmsmith::cli
