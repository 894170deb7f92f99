#include "coordinator/campaign/campaign_text.h"

#include "coordinator/campaign/internal/sections.h"
#include "irace_core/iterated_race.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {

std::string normalised_text(const Campaign& campaign) {
  return text_of(sections_of(campaign));
}

Deciding deciding(const Campaign& campaign) {
  Deciding entries;
  for (const Section& section : sections_of(campaign)) {
    for (const SectionLine& line : section.lines) {
      if (line.decides) entries.emplace_back(section.prefix + line.key, line.value);
    }
  }
  entries.emplace_back("engine.version", std::to_string(kEngineVersion));
  entries.emplace_back("race.version", std::to_string(kRaceVersion));
  return entries;
}

}  // namespace swarmsmith
