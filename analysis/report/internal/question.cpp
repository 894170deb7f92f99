#include <string>
#include <vector>

#include <fmt/format.h>

#include "analysis/report/internal/sections.h"

namespace swarmsmith {
namespace {

/// Writes the keys of a campaign's file below `prefix`, which is removed, with texts without
/// quotes. Leaves out empty lists.
void write_keys(ReportDraft& draft, std::int64_t campaign, const std::string& caption,
                const std::string& prefix) {
  draft.facts(caption,
              fmt::format("SELECT substr(j.key, {0}), trim(j.value, '\"') FROM v_campaigns AS c, "
                          "json_each(c.deciding) AS j WHERE c.campaign = {1} AND "
                          "substr(j.key, 1, {0} - 1) = {2} AND j.value <> '[]' ORDER BY j.id",
                          prefix.size() + 1, campaign, sql_text(prefix)));
}

/// The distinct values of this column of v_designs for the designs of a campaign.
std::vector<std::string> names_of(ReportDraft& draft, std::int64_t campaign,
                                  const std::string& column) {
  std::vector<std::string> names;
  const auto rows = draft.take(view_facts(
      draft.store(), fmt::format("SELECT {0}, min(design) FROM v_designs WHERE campaign = {1} "
                                 "GROUP BY {0} ORDER BY min(design)",
                                 column, campaign)));
  names.reserve(rows.size());
  for (const auto& row : rows)
    names.push_back(row.first);
  return names;
}

void write_campaign(ReportDraft& draft, const CampaignRecord& campaign) {
  const auto id = campaign.campaign;
  draft.page().heading(3, "Campaign " + campaign.name, false);
  for (const std::string& mission : names_of(draft, id, "mission"))
    write_keys(draft, id, "Mission " + mission, "mission." + mission + ".");
  for (const std::string& method : names_of(draft, id, "method"))
    write_keys(draft, id, "Method " + method, "method." + method + ".");
}

}  // namespace

void write_question(ReportDraft& draft) {
  draft.page().begin_folded("What was asked");
  const auto all = draft.take(campaigns(draft.store()));
  for (const CampaignRecord& campaign : all)
    write_campaign(draft, campaign);
  draft.page().end_folded();
}

void write_settings(ReportDraft& draft) {
  HtmlPage& page = draft.page();
  page.begin_folded("All settings");
  page.paragraph(
      "What else decides the answer, with the names of the campaign file; defaults are written "
      "out.");
  for (const CampaignRecord& campaign : draft.take(campaigns(draft.store()))) {
    write_keys(draft, campaign.campaign, "Race of " + campaign.name + ".", "race.");
    write_keys(draft, campaign.campaign, "Simulator of " + campaign.name + ".", "simulator.");
    write_keys(draft, campaign.campaign, "Engine of " + campaign.name + ".", "engine.");
  }
  page.end_folded();
}

}  // namespace swarmsmith
