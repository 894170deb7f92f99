#include "coordinator/campaign/campaign_text.h"

#include <algorithm>

#include "coordinator/campaign/internal/sections.h"
#include "irace_core/iterated_race.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {

std::string normalised_text(const Campaign& campaign) {
  return text_of(sections_of(campaign));
}

int engine_version_of(const Campaign& campaign) {
  int version = kEngineVersion;
  for (const CampaignMission& mission : campaign.missions) {
    version = std::max(version, engine_version_of(mission.mission, campaign.profile));
    for (const Profile& profile : campaign.test_profiles)
      version = std::max(version, engine_version_of(mission.mission, profile));
  }
  return version;
}

Deciding deciding(const Campaign& campaign) {
  Deciding entries;
  for (const Section& section : sections_of(campaign)) {
    for (const SectionLine& line : section.lines) {
      if (line.decides) entries.emplace_back(section.prefix + line.key, line.value);
    }
  }
  entries.emplace_back("engine.version", std::to_string(engine_version_of(campaign)));
  entries.emplace_back("race.version", std::to_string(kRaceVersion));
  // Other searches appear only if a method uses them, so that old digests do not change.
  for (const SearchKind kind : all_searches()) {
    const bool is_used = std::ranges::any_of(
        campaign.methods, [kind](const Method& method) { return kind_of(method.search) == kind; });
    if (kind == SearchKind::Irace || !is_used) continue;
    entries.emplace_back("search." + std::string(name_of(kind)) + ".version",
                         std::to_string(words_of(kind).version));
  }
  return entries;
}

}  // namespace swarmsmith
