#include "cli/replay/design_worlds.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/text/csv.h"
#include "cli/output/query_output.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/results/imported_world.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

/// Reads the version from the JSON object of the campaign's deciding settings, whose values are
/// texts.
int engine_version_in(const std::string& deciding) {
  const auto json = nlohmann::json::parse(deciding, nullptr, false);
  const std::string version = json.is_object() ? json.value("engine.version", "") : "";
  return static_cast<int>(integer_in(version).value_or(0));
}

/// The built-in mission with this name.
std::optional<CampaignMission> built_in(const std::string& name) {
  auto found = built_in_mission(name);
  if (!found) return std::nullopt;
  CampaignMission mission;
  mission.mission = std::move(*found);
  return mission;
}

/// Adds the settings from the campaign's file.
void put_campaign(DesignWorld& world, const Campaign& campaign) {
  world.has_programs = campaign.target.has_value();
  if (!world.has_programs) world.profile = campaign.profile;
  world.further_profiles.insert(world.further_profiles.begin(), campaign.test_profiles.begin(),
                                campaign.test_profiles.end());
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
  for (const auto& [name, text] : store.kept_profiles()) {
    if (auto profile = parse_profile(text, name + ".toml"))
      worlds.kept_profiles_.push_back(std::move(*profile));
  }
  worlds.seed_ = static_cast<std::uint64_t>(store.campaign().seed);
  return worlds;
}

namespace {

/// The first value for each name, and its campaign.
template <class Value>
class FirstOfName {
 public:
  explicit FirstOfName(std::string kind) : kind_(std::move(kind)) {}

  void look_at(const std::string& name, const Value& value, std::int64_t campaign,
               std::vector<std::string>& sentences) {
    auto& [first, whose, is_mixed] =
        known_.try_emplace(name, std::tuple(value, campaign, false)).first->second;
    if (is_mixed || first == value) return;
    is_mixed = true;
    sentences.push_back("campaigns " + std::to_string(whose) + " and " + std::to_string(campaign) +
                        " have different " + kind_ + "s of the name " + name +
                        "; tables and figures treat their scores as scores of one " + kind_);
  }

 private:
  std::string kind_;
  std::map<std::string, std::tuple<Value, std::int64_t, bool>> known_;
};

}  // namespace

std::vector<std::string> DesignWorlds::mixed_names() const {
  std::vector<std::string> sentences;
  if (files_.size() < 2) return sentences;
  FirstOfName<Mission> missions("mission");
  FirstOfName<Profile> profiles("profile");
  std::set<std::pair<std::int64_t, std::string>> seen;
  for (const KnownDesign& design : designs_) {
    if (!seen.emplace(design.campaign, design.mission).second) continue;
    const auto world = of(design.id);
    if (!world || !*world || !(*world)->mission) continue;
    missions.look_at(design.mission, (*world)->mission->mission, design.campaign, sentences);
    const auto& profile = (*world)->profile;
    if (profile) profiles.look_at(profile->name, *profile, design.campaign, sentences);
  }
  return sentences;
}

Expected<std::optional<DesignWorld>> DesignWorlds::of(DesignId design) const {
  const auto known = std::ranges::find(designs_, design, &KnownDesign::id);
  if (known == designs_.end()) return std::optional<DesignWorld>();
  DesignWorld world{.design = *known, .further_profiles = kept_profiles_};
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

void warn_of_mixed_names(const std::string& store, Output& output) {
  const auto reader = StoreReader::open(store);
  if (!reader) return;
  const auto worlds = DesignWorlds::read(**reader);
  if (!worlds) return;
  for (const std::string& sentence : worlds->mixed_names())
    print_note(output, "warning: " + sentence);
}

}  // namespace swarmsmith::cli
