#include "analysis/report/report.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/report/internal/sections.h"

namespace swarmsmith {
namespace {

std::string title_of(const std::vector<CampaignRecord>& campaigns) {
  std::vector<std::string> names;
  for (const CampaignRecord& campaign : campaigns)
    names.push_back(campaign.name);
  return fmt::format("Report of {}", fmt::join(names, ", "));
}

std::string summary_of(const std::vector<DesignRecord>& designs) {
  std::set<std::string> missions;
  std::set<std::string> methods;
  std::int64_t used = 0;
  std::ptrdiff_t finished = 0;
  for (const DesignRecord& design : designs) {
    missions.insert(design.mission);
    methods.insert(design.method);
    used += design.used;
    if (design.state == "finished") ++finished;
  }
  return fmt::format(
      "{} design{}, {} finished: missions {}; methods {}; {} experiments. In every table and "
      "figure "
      "a higher score is better. Captions name the views of the store that have the numbers.",
      designs.size(), designs.size() == 1 ? "" : "s", finished, fmt::join(missions, ", "),
      fmt::join(methods, ", "), used);
}

}  // namespace

Expected<std::string> html_report(StoreReader& store, const ReportOptions& options) {
  const auto known = designs(store, {});
  if (!known) return Unexpected(known.error());
  const auto asked = campaigns(store);
  if (!asked) return Unexpected(asked.error());
  for (const DesignId design : options.designs) {
    if (std::ranges::find(*known, design, &DesignRecord::design) == known->end())
      return unexpected(ErrorKind::NotFound, "the store has no design " + to_string(design));
  }
  ReportDraft draft(store, options);
  write_question(draft);
  write_results(draft);
  for (const DesignRecord& design : *known) {
    const bool wanted = options.designs.empty() ||
                        std::ranges::find(options.designs, design.design) != options.designs.end();
    if (wanted) write_design(draft, design);
  }
  write_provenance(draft);
  write_settings(draft);
  if (draft.trouble()) return Unexpected(*draft.trouble());
  return draft.page().finish(title_of(*asked), summary_of(*known));
}

}  // namespace swarmsmith
