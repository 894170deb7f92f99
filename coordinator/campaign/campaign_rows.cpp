#include "coordinator/campaign/campaign_rows.h"

#include <algorithm>

#include "base/hash.h"
#include "base/rng.h"
#include "base/text/json.h"
#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/internal/sections.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/iterated_race.h"

namespace swarmsmith {
namespace {

/// A positive seed within the integer range of SQLite and TOML.
std::int64_t design_seed(std::uint64_t campaign_seed, std::int64_t id) {
  Rng rng = Rng(campaign_seed).split("design", static_cast<std::uint64_t>(id));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(rng.next() >> 1U));
}

/// In the order of the digest, so that a person can compare two campaigns line by line.
std::string deciding_json(const Deciding& entries) {
  JsonObject object;
  for (const auto& [key, value] : entries)
    object.add(key, value);
  return object.text();
}

}  // namespace

std::string campaign_digest(const Campaign& campaign) {
  Digest digest;
  for (const auto& [key, value] : deciding(campaign)) {
    digest.add(key);
    digest.add(value);
  }
  return digest.hex();
}

CampaignRow campaign_row(const Campaign& campaign) {
  return {.name = campaign.name,
          .digest = campaign_digest(campaign),
          .deciding = deciding_json(deciding(campaign)),
          .file = normalised_text(campaign),
          .seed = static_cast<std::int64_t>(campaign.seed)};
}

std::int64_t repetitions_of(const Campaign& campaign, const Method& method) {
  // A given machine is one design, because all its repetitions would be the same.
  const bool is_given = !method.baseline.empty() && method.baseline != kRandomMachine;
  return is_given ? 1 : campaign.repetitions;
}

std::int64_t design_budget(const Campaign& campaign, const CampaignMission& mission,
                           const Method& method) {
  if (!method.baseline.empty()) return 0;
  const bool races = words_of(method.search).has_tests;
  if (!campaign.race.min_experiments || !races) return campaign.race.max_experiments;
  const auto space = MethodSpace::make(method, static_cast<int>(campaign.digits));
  if (!space) return campaign.race.max_experiments;
  return total_budget(space->parameters(), race_on(campaign, mission));
}

std::vector<DesignRow> design_rows(const Campaign& campaign) {
  std::vector<DesignRow> rows;
  for (const CampaignMission& mission : campaign.missions) {
    for (const Method& method : campaign.methods) {
      const std::int64_t budget = design_budget(campaign, mission, method);
      for (std::int64_t repetition = 1; repetition <= repetitions_of(campaign, method);
           ++repetition) {
        const auto id = static_cast<std::int64_t>(rows.size()) + 1;
        rows.push_back({.id = {id},
                        .mission = mission.mission.name,
                        .method = method.name,
                        .flavour = method.parameters.empty() ? method.flavour : "",
                        .repetition = repetition,
                        // All designs of an ablation use the pairs of the campaign's seed.
                        .seed = campaign.race.ablation ? static_cast<std::int64_t>(campaign.seed)
                                                       : design_seed(campaign.seed, id),
                        .budget = budget});
      }
    }
  }
  return rows;
}

Searches searches_of(const Campaign& campaign) {
  Searches searches;
  for (const DesignRow& row : design_rows(campaign)) {
    const auto method = std::ranges::find(campaign.methods, row.method, &Method::name);
    const bool is_raced = kind_of(method->search) == SearchKind::Irace || !method->baseline.empty();
    if (!is_raced) searches.emplace(row.id, method->search);
  }
  return searches;
}

}  // namespace swarmsmith
