#include "coordinator/cli/stored_runs.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/cli/query_output.h"
#include "sim/control/machine_text.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;

/// From the JSON object of what decides the campaign, whose values are texts.
int engine_version_in(const std::string& deciding) {
  constexpr std::string_view kKey = R"("engine.version":")";
  const std::size_t at = deciding.find(kKey);
  return at == std::string::npos ? 0 : std::atoi(deciding.c_str() + at + kKey.size());
}

std::int64_t integer_of(const Cell& cell) {
  return std::strtoll(cell.text.c_str(), nullptr, 10);
}

/// A literal.
std::string sql_text(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    quoted += letter;
    if (letter == '\'') quoted += letter;
  }
  return quoted + "'";
}

/// With a run's columns in the order of `read_outcome`.
std::string select_evaluations(const std::string& condition) {
  return "SELECT e.id, 'c' || e.candidate, e.seed, e.status, e.score, e.state_digest, e.source, "
         "c.fsm_config, d.mission, d.method, d.design FROM (SELECT * FROM v_evaluations WHERE " +
         condition +
         ") AS e JOIN v_candidates AS c ON c.candidate = e.candidate "
         "JOIN v_designs AS d ON d.design = e.design";
}

/// What the evaluation's own row says.
StoredRun read_outcome(const std::vector<Cell>& cells) {
  StoredRun run{.id = cells[0].text, .candidate = cells[1].text};
  run.seed = integer_of(cells[2]);
  run.rejected = cells[3].text == "rejected";
  if (cells[4].type != Cell::Type::Null) {
    run.outcome = StoredOutcome{std::strtod(cells[4].text.c_str(), nullptr),
                                static_cast<std::uint64_t>(integer_of(cells[5]))};
  }
  return run;
}

Expected<Profile> profile_of(const Campaign& campaign, const std::string& source) {
  if (!campaign.target && source == campaign.profile.name) return campaign.profile;
  if (source == "real") {
    return bad_input("it was filmed, not simulated: there is nothing to simulate again");
  }
  if (campaign.target) {
    return bad_input(
        "a program scored it: there is nothing to simulate again; `show` has its seed "
        "and what was given to the program");
  }
  return built_in_profile(source);
}

}  // namespace

bool same_bits(const StoredOutcome& stored, const SimulationResult& result) {
  return std::bit_cast<std::uint64_t>(stored.score) ==
             std::bit_cast<std::uint64_t>(result.score + 0.0) &&
         stored.state_digest == result.state_digest;
}

std::string other_engine(int stored_version) {
  if (stored_version == kEngineVersion) return "";
  return "the store's scores are of version " + std::to_string(stored_version) +
         " of the engine, this program has version " + std::to_string(kEngineVersion) +
         ", which need not give the same bits";
}

Expected<StoredRuns> StoredRuns::open(std::unique_ptr<StoreReader> store) {
  const std::vector<StoredCampaign> campaigns = store->campaigns();
  StoredRuns runs(std::move(store));
  if (campaigns.size() > 1) return runs;
  const auto source = runs.source_of({campaigns.front().designs_before + 1});
  if (!source) return Unexpected(source.error());
  if (!(*source)->campaign) return Unexpected((*source)->campaign.error());
  return runs;
}

Expected<const StoredRuns::Source*> StoredRuns::source_of(DesignId design) {
  const auto stored = store_->campaign_of(design);
  if (!stored) return Unexpected(stored.error());
  const auto known = sources_.find(stored->id);
  if (known != sources_.end()) return &known->second;
  const int engine_version = engine_version_in(stored->row.deciding);
  auto campaign = parse_campaign(stored->row.file, "the store's campaign file");
  if (campaign) {
    return &sources_.emplace(stored->id, Source{std::move(*campaign), engine_version})
                .first->second;
  }
  Error error = campaign.error().front();
  const std::string older = other_engine(engine_version);
  error.message += "; this version cannot replay the store";
  if (!older.empty()) error.message += " (" + older + ")";
  return &sources_.emplace(stored->id, Source{Unexpected(error), engine_version}).first->second;
}

Expected<StoredRun> StoredRuns::evaluation(const ThingId& id) {
  const auto rows = select(*store_, select_evaluations(is_evaluation(id)));
  if (!rows) return Unexpected(rows.error());
  const std::string name = "e" + id.digits + id.purpose;
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no evaluation " + name);
  }
  const auto& cells = rows->cells.front();
  if (cells[2].type == Cell::Type::Null) {
    return bad_input("the store does not say on which seed it was made", name);
  }
  StoredRun run = read_outcome(cells);
  const auto completed = complete(
      run, {cells[7].text, cells[8].text, cells[9].text, cells[6].text, {integer_of(cells[10])}});
  if (!completed) return bad_input(to_string(completed.error()), name);
  return run;
}

Expected<StoredRun> StoredRuns::candidate(const ThingId& id, std::int64_t seed) {
  const auto rows =
      select(*store_,
             "SELECT c.fsm_config, d.mission, d.method, d.design FROM v_candidates AS c "
             "JOIN v_designs AS d ON d.design = c.design WHERE c.candidate = " +
                 id.digits);
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate c" + id.digits);
  }
  const auto& cells = rows->cells.front();
  const DesignId design{integer_of(cells[3])};
  const auto source = source_of(design);
  if (!source) return Unexpected(source.error());
  if (!(*source)->campaign) return Unexpected((*source)->campaign.error());
  const std::string& profile = (*(*source)->campaign).profile.name;
  // The pair may have served the race and more: all of these hold the same outcome.
  const auto known =
      select(*store_,
             select_evaluations("candidate = " + id.digits + " AND seed = " + std::to_string(seed) +
                                " AND source = " + sql_text(profile)) +
                 " ORDER BY e.purpose = 'race' DESC, e.pair",
             {.rows = 1});
  if (!known) return Unexpected(known.error());
  StoredRun run{.id = {}, .candidate = "c" + id.digits};
  if (!known->cells.empty()) run = read_outcome(known->cells.front());
  run.seed = seed;
  const auto completed =
      complete(run, {cells[0].text, cells[1].text, cells[2].text, profile, design});
  if (!completed) return bad_input(to_string(completed.error()), run.candidate);
  return run;
}

Expected<std::vector<std::string>> StoredRuns::sample(std::int64_t count) {
  // The n-th of N rows is taken when a multiple of N / count lies in (n - 1, n].
  const std::string number = std::to_string(count);
  const auto rows =
      select(*store_,
             "WITH all_of (id, n, total) AS (SELECT id, row_number() OVER (ORDER BY candidate, "
             "purpose, pair), count(*) OVER () FROM v_evaluations "
             "WHERE status = 'ok' AND source <> 'real' AND seed IS NOT NULL) "
             "SELECT id FROM all_of WHERE n * " +
                 number + " / total > (n - 1) * " + number + " / total ORDER BY n",
             {.rows = 1'000'000'000, .seconds = 600});
  if (!rows) return Unexpected(rows.error());
  std::vector<std::string> ids;
  for (const auto& cells : rows->cells)
    ids.push_back(cells.front().text);
  return ids;
}

Expected<void> StoredRuns::complete(StoredRun& run, const Origin& origin) {
  const auto source = source_of(origin.design);
  if (!source) return Unexpected(source.error());
  if (!(*source)->campaign) return Unexpected((*source)->campaign.error());
  const Campaign& campaign = *(*source)->campaign;
  run.engine_version = (*source)->engine_version;
  auto profile = profile_of(campaign, origin.source);
  if (!profile) return Unexpected(profile.error());
  run.profile = std::move(*profile);
  const auto mission = std::ranges::find_if(
      campaign.missions, [&](const auto& known) { return known.mission.name == origin.mission; });
  if (mission == campaign.missions.end()) {
    return bad_input("the store's campaign has no mission " + origin.mission);
  }
  run.mission = mission->mission;
  const auto method = std::ranges::find_if(
      campaign.methods, [&](const Method& known) { return known.name == origin.method; });
  if (method == campaign.methods.end()) {
    return bad_input("the store's campaign has no method " + origin.method);
  }
  auto flavour = find_flavour(method->flavour, method->turn_clock);
  if (!flavour) return Unexpected(flavour.error());
  run.flavour = std::move(*flavour);
  auto machine = parse_machine(origin.machine, run.flavour);
  if (!machine) return Unexpected(machine.error());
  run.machine = std::move(*machine);
  auto instance = instance_of(run.mission, run.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = std::move(*instance);
  return {};
}

}  // namespace swarmsmith::cli
