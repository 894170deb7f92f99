#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "analysis/report/internal/sections.h"

namespace swarmsmith {
namespace {

/// The keys of a campaign's file below `prefix`, which is cut off; texts without their quotes.
/// Lists without entries say nothing.
void write_keys(ReportDraft& draft, std::int64_t campaign, const std::string& caption,
                const std::string& prefix) {
  draft.facts(caption,
              fmt::format("SELECT substr(j.key, {0}), trim(j.value, '\"') FROM v_campaigns AS c, "
                          "json_each(c.deciding) AS j WHERE c.campaign = {1} AND "
                          "substr(j.key, 1, {0} - 1) = {2} AND j.value <> '[]' ORDER BY j.id",
                          prefix.size() + 1, campaign, sql_quoted(prefix)));
}

/// What the designs of a campaign have in this column.
std::set<std::string> names_of(const std::vector<DesignRecord>& designs,
                               std::string DesignRecord::*name) {
  std::set<std::string> names;
  for (const DesignRecord& design : designs)
    names.insert(design.*name);
  return names;
}

void write_campaign(ReportDraft& draft, const CampaignRecord& campaign,
                    const std::vector<DesignRecord>& designs) {
  const auto id = campaign.campaign;
  std::vector<DesignRecord> own;
  std::ranges::copy_if(designs, std::back_inserter(own),
                       [&](const DesignRecord& design) { return design.campaign == id; });
  draft.page().heading(3, "Campaign " + campaign.name);
  for (const std::string& mission : names_of(own, &DesignRecord::mission))
    write_keys(draft, id, "Mission " + mission, "mission." + mission + ".");
  for (const std::string& method : names_of(own, &DesignRecord::method))
    write_keys(draft, id, "Method " + method, "method." + method + ".");
}

}  // namespace

void write_question(ReportDraft& draft, const std::vector<DesignRecord>& designs) {
  draft.page().heading(2, "What was asked");
  draft.table("Designs: one iterated race each (v_designs).",
              {{"design", Show::Design},
               {"mission"},
               {"method"},
               {"repetition", Show::Count},
               {"budget (experiments)", Show::Count},
               {"used", Show::Count},
               {"state"},
               {"why it ended"}},
              "SELECT design, mission, method, repetition, budget, used, state, reason "
              "FROM v_designs ORDER BY design",
              1000);
  const auto all = draft.take(campaigns(draft.store()));
  for (const CampaignRecord& campaign : all)
    write_campaign(draft, campaign, designs);
}

void write_settings(ReportDraft& draft) {
  HtmlPage& page = draft.page();
  page.begin_chapter();
  page.heading(2, "All settings");
  page.paragraph(
      "What else decides the answer, with the names of the campaign file; defaults are written "
      "out.");
  for (const CampaignRecord& campaign : draft.take(campaigns(draft.store()))) {
    write_keys(draft, campaign.campaign, "Race of " + campaign.name + ".", "race.");
    write_keys(draft, campaign.campaign, "Simulator of " + campaign.name + ".", "simulator.");
    write_keys(draft, campaign.campaign, "Engine of " + campaign.name + ".", "engine.");
  }
  page.end_chapter();
}

}  // namespace swarmsmith
