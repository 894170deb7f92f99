#include "cli/replay/design_argument.h"

#include <algorithm>

#include "cli/arguments/thing_id.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "storage/store.h"

namespace swarmsmith::cli {
namespace {

Expected<Campaign> campaign_or_last(CampaignOrErrors read, Output& output) {
  if (read) return std::move(*read);
  const std::vector<Error>& errors = read.error();
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    print_error(output, errors[i]);
  return Unexpected(errors.back());
}

}  // namespace

Expected<Campaign> campaign_of(const std::string& file, Output& output) {
  if (!is_database(file)) return campaign_or_last(read_campaign(file), output);
  const auto store = StoreReader::open(file);
  if (!store) return Unexpected(store.error());
  const std::vector<StoredCampaign> campaigns = (*store)->campaigns();
  if (campaigns.size() > 1) {
    return unexpected(ErrorKind::Conflict,
                      "the store holds " + std::to_string(campaigns.size()) +
                          " campaigns; name a campaign file, or the store of one campaign",
                      file);
  }
  if (campaigns.front().state == "imported")
    return bad_input("its designs were imported, and there is no campaign file of them", file);
  return campaign_or_last(parse_campaign(campaigns.front().row.file, file), output);
}

Expected<DesignRow> find_design(const Campaign& campaign, const std::string& word) {
  const std::vector<DesignRow> designs = design_rows(campaign);
  if (word.empty()) {
    const bool all_alike = std::ranges::all_of(designs, [&](const DesignRow& design) {
      return design.mission == designs.front().mission && design.method == designs.front().method;
    });
    if (all_alike) return designs.front();
  }
  const auto id = parse_thing_id(word);
  for (const DesignRow& design : designs) {
    if (id && id->letter == 'd' && to_string(design.id) == word) return design;
  }
  std::string known;
  for (const DesignRow& design : designs) {
    known += (known.empty() ? "" : ", ") + to_string(design.id) + " " + design.mission + " " +
             design.method + " repetition " + std::to_string(design.repetition);
    if (design.id.value == 20 && designs.size() > 20) {
      known += ", ...";
      break;
    }
  }
  return bad_input(word.empty() ? "no design given; the campaign has: " + known
                                : "the campaign has no design " + word + "; it has: " + known,
                   "--design");
}

void put_into_world(NamedMachine& machine, const Campaign& campaign, const DesignRow& design) {
  machine.profile = campaign.profile;
  machine.mission = *std::ranges::find_if(campaign.missions, [&](const CampaignMission& candidate) {
    return candidate.mission.name == design.mission;
  });
  const Method& method = *std::ranges::find(campaign.methods, design.method, &Method::name);
  machine.flavour = method.flavour;
  machine.own_flavour = method.own_flavour;
  machine.turn_clock = method.turn_clock;
}

}  // namespace swarmsmith::cli
