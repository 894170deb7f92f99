#include "cli/output/stored_campaigns.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/text/csv.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

constexpr const char* kDesigns =
    "SELECT d.design, d.campaign, d.mission, d.method, d.repetition, d.state, d.used, d.budget, "
    "d.iteration, d.best_candidate, d.best_mean, d.reason, t.test_mean, t.test_runs "
    "FROM v_designs AS d LEFT JOIN v_leaderboard AS t ON t.design = d.design ORDER BY d.design";

}  // namespace

std::string designs_with_means(std::optional<DesignId> only) {
  const std::string own = only ? "design = " + std::to_string(only->value) : "true";
  return "(SELECT d.*, t.test_mean, t.test_runs, s.score_mean, s.score_runs FROM (SELECT * FROM "
         "v_designs WHERE " +
         own +
         ") AS d LEFT JOIN v_leaderboard AS t ON t.design = d.design LEFT JOIN (SELECT design, "
         "avg(score) AS score_mean, count(*) AS score_runs FROM v_design_scores WHERE purpose = "
         "'score' AND " +
         own + " GROUP BY design HAVING count(DISTINCT source) = 1) AS s ON s.design = d.design)";
}

Expected<std::vector<CampaignStatus>> stored_campaigns(StoreReader& store, bool is_written) {
  std::vector<CampaignStatus> campaigns;
  std::map<std::string, std::size_t> places;  // index by number
  const auto heads = select(
      store,
      "SELECT campaign, name, state, CASE WHEN json_valid(deciding) THEN "
      "json_extract(deciding, '$.\"race.max_time\"') END, CASE WHEN json_valid(deciding) THEN "
      "json_extract(deciding, '$.\"simulator.kind\"') END FROM v_campaigns ORDER BY campaign");
  if (!heads) return Unexpected(heads.error());
  for (const auto& cells : heads->cells) {
    places.emplace(cells[0].text, campaigns.size());
    campaigns.push_back({.name = cells[1].text, .state = cells[2].text});
    campaigns.back().max_time = number_in(cells[3].text).value_or(0);
    campaigns.back().costs = cells[4].text == "\"command\"";
    if (!is_written && campaigns.back().state == "running") campaigns.back().state = "interrupted";
  }
  std::map<DesignId, bool> paused;
  for (const CommandRow& row : store.commands()) {
    if (is_of_leases(row.kind)) paused[row.design] = row.kind == CommandKind::Pause;
  }
  const auto designs = select(store, kDesigns, {.rows = 10'000'000});
  if (!designs) return Unexpected(designs.error());
  const auto stages = StoredStages::read(store);
  if (!stages) return Unexpected(stages.error());
  for (const auto& cells : designs->cells) {
    DesignStatus design{.id = cells[0].id<DesignId>(),
                        .mission = cells[2].text,
                        .method = cells[3].text,
                        .repetition = cells[4].integer(),
                        .state = design_state_of(cells[5].text).value_or(DesignState::Waiting),
                        .used = cells[6].integer(),
                        .budget = cells[7].integer(),
                        .iteration = cells[8].integer(),
                        .best = cells[9].id<CandidateId>(),
                        .best_mean = cells[10].real(),
                        .test_mean = cells[12].real(),
                        .test_runs = cells[13].integer(),
                        .reason = cells[11].text};
    const auto command = paused.find(design.id);
    design.paused = command != paused.end() && command->second && !is_over(design.state);
    if (const SearchOptions* search = stages->search(cells[0].text); search != nullptr) {
      design.search = words_of(*search).name;
      design.stage = stages->stage(cells[0].text, cells[8].text);
    }
    if (const auto place = places.find(cells[1].text); place != places.end())
      campaigns[place->second].designs.push_back(std::move(design));
  }
  return campaigns;
}

void mark_interrupted(Rows& designs, bool is_written) {
  const std::size_t state = designs.column("state");
  if (is_written || state >= designs.columns.size()) return;
  for (auto& cells : designs.cells) {
    std::string& word = cells[state].text;
    if (word == "racing" || word == "testing") word = "interrupted";
  }
}

}  // namespace swarmsmith::cli
