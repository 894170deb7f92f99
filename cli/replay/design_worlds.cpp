#include "cli/replay/design_worlds.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/text/csv.h"
#include "cli/output/query_output.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/results/imported_world.h"

namespace swarmsmith::cli {
namespace {

/// From the JSON object of what decides the campaign, whose values are texts.
int engine_version_in(const std::string& deciding) {
  const auto json = nlohmann::json::parse(deciding, nullptr, false);
  const std::string version = json.is_object() ? json.value("engine.version", "") : "";
  return static_cast<int>(integer_in(version).value_or(0));
}

/// A mission whose name is a built-in one's.
std::optional<CampaignMission> built_in(const std::string& name) {
  auto found = built_in_mission(name);
  if (!found) return std::nullopt;
  CampaignMission mission;
  mission.mission = std::move(*found);
  return mission;
}

/// What the campaign's file says of the design.
void put_campaign(DesignWorld& world, const Campaign& campaign) {
  world.has_programs = campaign.target.has_value();
  if (!world.has_programs) world.profile = campaign.profile;
  world.test_profiles = campaign.test_profiles;
  for (const CampaignMission& mission : campaign.missions) {
    if (!world.has_programs && mission.mission.name == world.design.mission)
      world.mission = mission;
  }
  const auto method = std::ranges::find(campaign.methods, world.design.method, &Method::name);
  if (method == campaign.methods.end()) return;
  world.has_parameters = !method->parameters.empty();
  world.flavour = world.has_parameters ? "" : method->flavour;
  world.own_flavour = method->own_flavour;
  world.turn_clock = method->turn_clock;
}

}  // namespace

Expected<DesignWorlds> DesignWorlds::read(StoreReader& store) {
  DesignWorlds worlds;
  auto designs = known_designs(store);
  if (!designs) return Unexpected(designs.error());
  worlds.designs_ = std::move(*designs);
  const auto files = select(store, "SELECT id, file, deciding FROM campaign ORDER BY id");
  if (!files) return Unexpected(files.error());
  for (const auto& cells : files->cells) {
    File file{cells[1].text, engine_version_in(cells[2].text)};
    if (!file.text.empty() && !is_imported_text(file.text)) {
      auto campaign = parse_campaign(file.text, "the store's campaign file");
      file.campaign = campaign ? Expected<Campaign>(std::move(*campaign))
                               : Unexpected(campaign.error().front());
    } else {
      file.imported = read_imported_world(file.text);
    }
    worlds.files_.emplace(cells[0].integer(), std::move(file));
  }
  worlds.seed_ = static_cast<std::uint64_t>(store.campaign().seed);
  return worlds;
}

Expected<std::optional<DesignWorld>> DesignWorlds::of(DesignId design) const {
  const auto known = std::ranges::find(designs_, design, &KnownDesign::id);
  if (known == designs_.end()) return std::optional<DesignWorld>();
  DesignWorld world{.design = *known};
  const auto file = files_.find(known->campaign);
  if (file != files_.end() && file->second.campaign) {
    world.engine_version = file->second.engine_version;
    const Expected<Campaign>& campaign = *file->second.campaign;
    if (!campaign) return Unexpected(campaign.error());
    put_campaign(world, *campaign);
    return world;
  }
  world.flavour = known->flavour;
  world.has_parameters = known->flavour.empty();
  if (world.has_parameters) return world;
  world.mission = built_in(known->mission);
  if (file == files_.end()) return world;
  const Expected<ImportedWorld>& imported = *file->second.imported;
  if (!imported) return Unexpected(imported.error());
  for (const MissionEntry& entry : imported->missions) {
    if (entry.mission.name == known->mission) world.mission = CampaignMission{entry, {}};
  }
  world.profile = imported->profile;
  world.own_flavour = imported->own_flavour;
  return world;
}

}  // namespace swarmsmith::cli
