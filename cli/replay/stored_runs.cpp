#include "cli/replay/stored_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "cli/output/query_output.h"
#include "coordinator/campaign/campaign_file.h"
#include "sim/files/profile_file.h"
#include "storage/stored_enums.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;

std::int64_t integer_of(const Cell& cell) {
  return std::strtoll(cell.text.c_str(), nullptr, 10);
}

/// Who answers for a worker, as far as a store of this schema says it.
std::string who(std::int64_t schema) {
  if (schema >= 6) return "w.principal";
  return schema >= 3 ? "w.client" : "''";
}

/// With a run's columns in the order of `read_outcome`.
std::string select_evaluations(std::int64_t schema, const std::string& condition) {
  return "SELECT e.id, 'c' || e.candidate, e.seed, e.status, e.score, e.state_digest, e.source, "
         "c.fsm_config, e.design, e.worker, w.host, " +
         who(schema) +
         " FROM (SELECT * FROM v_evaluations "
         "WHERE " +
         condition +
         ") AS e JOIN v_candidates AS c ON c.candidate = e.candidate LEFT JOIN v_workers AS w ON "
         "w.worker = e.worker";
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
  run.worker = integer_of(cells[9]);
  run.host = cells[10].text;
  run.who = cells[11].text;
  return run;
}

/// The profile behind a source, or why there is none.
Expected<Profile> profile_of(const DesignWorld& world, const std::string& source) {
  if (world.profile && source == world.profile->name) return *world.profile;
  const auto further = std::ranges::find(world.test_profiles, source, &Profile::name);
  if (further != world.test_profiles.end()) return *further;
  if (source == "real") {
    return bad_input("it was filmed, not simulated: there is nothing to simulate again");
  }
  if (world.has_programs || source == "command") {
    return bad_input(
        "a program scored it, so it cannot be simulated; `show` has its seed and the program's "
        "arguments");
  }
  auto built_in = built_in_profile(source);
  if (built_in) return built_in;
  return bad_input("neither the store nor this program has the profile " + source +
                   " with which it was made; `evaluate` simulates it with --profile FILE");
}

/// Puts in what the run is a function of, besides its seed and its profile.
Expected<void> complete(StoredRun& run, const DesignWorld& world, const std::string& text) {
  if (!world.mission) {
    return bad_input("the store's campaign has no mission " + world.design.mission);
  }
  run.engine_version = world.engine_version;
  run.mission = world.mission->mission;
  if (world.flavour.empty()) {
    return bad_input("the store's campaign has no method " + world.design.method);
  }
  auto flavour = world.turn_clock ? find_flavour(world.flavour, *world.turn_clock)
                                  : find_flavour(world.flavour, TurnClock::Cycles);
  if (!flavour) return Unexpected(flavour.error());
  run.flavour = std::move(*flavour);
  auto controller = parse_controller(text, run.flavour);
  if (!controller) return Unexpected(controller.error());
  run.controller = std::move(*controller);
  auto instance = instance_of(run.mission, run.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = std::move(*instance);
  return {};
}

/// Scores from each who answers for workers in turn. Their order is drawn from numbers below 2^31,
/// whose squares fit in SQLite's integers.
std::string in_turn(std::int64_t schema, const std::string& given,
                    const StoredRuns::Wanted& wanted) {
  constexpr const char* kSql =
      "WITH drawn AS (SELECT e.id, {who} AS who, (e.candidate * 100003 + e.pair * 7 + "
      "(e.purpose = 'test') + {seed}) % {prime} AS x{given} AND e.status = 'ok'{but}), "
      "mixed AS (SELECT id, who, (x * x + {seed}) % {prime} AS y FROM drawn), "
      "ordered AS (SELECT id, who, y * y % {prime} AS z FROM mixed), "
      "ranked AS (SELECT id, z, row_number() OVER (PARTITION BY who ORDER BY z, id) AS n "
      "FROM ordered) SELECT id FROM ranked ORDER BY n, z, id LIMIT {count}";
  return fmt::format(
      fmt::runtime(kSql), fmt::arg("seed", wanted.seed), fmt::arg("who", who(schema)),
      fmt::arg("prime", 2'147'483'629), fmt::arg("given", given),
      fmt::arg("but", wanted.tests ? " AND e.purpose NOT IN " + words_in_sql(is_test) : ""),
      fmt::arg("count", wanted.scores));
}

}  // namespace

bool same_bits(const StoredOutcome& stored, const SimulationResult& result) {
  return std::bit_cast<std::uint64_t>(stored.score) ==
             std::bit_cast<std::uint64_t>(result.score + 0.0) &&
         stored.state_digest == result.state_digest;
}

std::string other_engine(int stored_version) {
  if (stored_version == kEngineVersion || stored_version == 0) return "";
  return "the store's scores are of version " + std::to_string(stored_version) +
         " of the engine, this program has version " + std::to_string(kEngineVersion) +
         ", which need not give the same bits";
}

Expected<StoredRuns> StoredRuns::open(std::unique_ptr<StoreReader> store) {
  auto worlds = DesignWorlds::read(*store);
  if (!worlds) return Unexpected(worlds.error());
  if (worlds->designs().empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no designs: there is nothing to simulate");
  }
  const auto first = worlds->of(worlds->designs().front().id);
  if (first) return StoredRuns(std::move(store), std::move(*worlds));
  Error error = first.error();
  const std::string older = other_engine(worlds->first_engine_version());
  error.message += "; this version cannot replay the store";
  if (!older.empty()) error.message += " (" + older + ")";
  return Unexpected(error);
}

Expected<StoredRun> StoredRuns::evaluation(const ThingId& id) {
  const auto rows = select(*store_, select_evaluations(store_->schema(), is_evaluation(id)));
  if (!rows) return Unexpected(rows.error());
  const std::string name = "e" + id.digits + id.purpose;
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no evaluation " + name);
  }
  const auto& cells = rows->cells.front();
  const auto world = world_of({integer_of(cells[8])});
  if (!world) return bad_input(to_string(world.error()), name);
  auto profile = profile_of(*world, cells[6].text);
  if (!profile) return bad_input(to_string(profile.error()), name);
  if (cells[2].type == Cell::Type::Null) {
    return bad_input("the store does not say on which seed it was made", name);
  }
  StoredRun run = read_outcome(cells);
  if (run.outcome && run.outcome->state_digest == 0) {
    return bad_input("it was imported without its last state, so it cannot be compared; `replay " +
                         run.candidate + " --seed " + std::to_string(run.seed) + "` simulates it",
                     name);
  }
  run.profile = std::move(*profile);
  const auto completed = complete(run, *world, cells[7].text);
  if (!completed) return bad_input(to_string(completed.error()), name);
  return run;
}

Expected<StoredRun> StoredRuns::candidate(const ThingId& id, std::int64_t seed) {
  const auto rows =
      select(*store_, "SELECT fsm_config, design FROM v_candidates WHERE candidate = " + id.digits);
  if (!rows) return Unexpected(rows.error());
  StoredRun run{.id = {}, .candidate = "c" + id.digits};
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + run.candidate);
  }
  const auto& cells = rows->cells.front();
  const auto world = world_of({integer_of(cells[1])});
  if (!world) return bad_input(to_string(world.error()), run.candidate);
  if (world->has_parameters && !world->has_programs) {
    return bad_input(
        "it is a configuration of a program, not a machine: there is nothing to simulate",
        run.candidate);
  }
  if (!world->profile && !world->has_programs) {
    return bad_input("it was imported, and its store names no profile; `evaluate " + run.candidate +
                         " --profile P --seeds " + std::to_string(seed) + "` simulates it",
                     run.candidate);
  }
  const std::string source = world->profile ? world->profile->name : "command";
  auto profile = profile_of(*world, source);
  if (!profile) return bad_input(to_string(profile.error()), run.candidate);
  // The pair may have served the race and more: all of these hold the same outcome.
  const auto known =
      select(*store_,
             select_evaluations(store_->schema(),
                                "candidate = " + id.digits + " AND seed = " + std::to_string(seed) +
                                    " AND state_digest <> 0 AND source = " + sql_text(source)) +
                 " ORDER BY e.purpose = 'race' DESC, e.pair",
             {.rows = 1});
  if (!known) return Unexpected(known.error());
  if (!known->cells.empty()) run = read_outcome(known->cells.front());
  run.seed = seed;
  run.profile = std::move(*profile);
  const auto completed = complete(run, *world, cells[0].text);
  if (!completed) return bad_input(to_string(completed.error()), run.candidate);
  return run;
}

Expected<std::vector<std::string>> StoredRuns::sample(std::int64_t count) {
  // The n-th of N rows is taken when a multiple of N / count lies in (n - 1, n]. What was not
  // simulated here has no last state.
  const std::string number = std::to_string(count);
  return ids_of(
      "WITH all_of (id, n, total) AS (SELECT id, row_number() OVER (ORDER BY candidate, "
      "purpose, pair), count(*) OVER () FROM v_evaluations "
      "WHERE status = 'ok' AND source <> 'real' AND seed IS NOT NULL "
      "AND (state_digest <> 0 OR purpose <> 'score')) "
      "SELECT id FROM all_of WHERE n * " +
      number + " / total > (n - 1) * " + number + " / total ORDER BY n");
}

Expected<std::vector<std::string>> StoredRuns::chosen(const Wanted& wanted) {
  const std::string campaigns = of_campaigns();
  if (campaigns.empty()) return std::vector<std::string>{};
  const std::string given =
      " FROM v_evaluations AS e LEFT JOIN v_workers AS w ON w.worker = e.worker "
      "WHERE e.source <> 'real' AND " +
      campaigns;
  const std::string in_order = " ORDER BY e.candidate, e.purpose, e.pair";
  std::vector<std::string> parts;
  if (wanted.rejections)
    parts.push_back("SELECT e.id" + given + " AND e.status = 'rejected'" + in_order);
  if (wanted.tests)
    parts.push_back("SELECT e.id" + given + " AND e.status = 'ok' AND e.purpose IN " +
                    words_in_sql(is_test) + in_order);
  if (wanted.scores > 0) parts.push_back(in_turn(store_->schema(), given, wanted));
  std::vector<std::string> all;
  for (const std::string& sql : parts) {
    const auto ids = ids_of(sql);
    if (!ids) return Unexpected(ids.error());
    all.insert(all.end(), ids->begin(), ids->end());
  }
  return all;
}

Expected<std::vector<std::string>> StoredRuns::ids_of(const std::string& sql) {
  const auto rows = select(*store_, sql, {.rows = 1'000'000'000, .seconds = 600});
  if (!rows) return Unexpected(rows.error());
  std::vector<std::string> ids;
  for (const auto& cells : rows->cells)
    ids.push_back(cells.front().text);
  return ids;
}

std::string StoredRuns::of_campaigns() const {
  std::string designs;
  for (const KnownDesign& design : worlds_.designs()) {
    const auto world = worlds_.of(design.id);
    if (world && *world && (*world)->profile)
      designs += (designs.empty() ? "" : ",") + std::to_string(design.id.value);
  }
  if (designs.empty()) return {};
  return "e.purpose IN " + words_in_sql(is_simulated) + " AND e.design IN (" + designs + ")";
}

bool StoredRuns::has_machines() const {
  return std::ranges::any_of(worlds_.designs(), [&](const KnownDesign& design) {
    const auto world = worlds_.of(design.id);
    return world && *world && !(*world)->has_programs && !(*world)->has_parameters;
  });
}

Error programs_scored(const std::string& where) {
  return {ErrorKind::BadInput,
          "programs scored this store, so its evaluations cannot be repeated here; check the races "
          "with `swarmsmith verify` without --sample",
          where};
}

std::string StoredRun::given_by() const {
  if (worker == 0) return {};
  std::string text = "; given by worker " + std::to_string(worker);
  if (!host.empty()) text += " on " + host;
  if (!who.empty()) text += " (" + who + ")";
  return text;
}

Expected<DesignWorld> StoredRuns::world_of(DesignId design) {
  // Its campaign's file is read once for all evaluations of the design.
  if (!world_ || world_->design.id != design) {
    auto world = worlds_.of(design);
    if (!world) return Unexpected(world.error());
    if (!*world) return bad_input("the store has no design " + to_string(design));
    world_ = std::move(**world);
  }
  return *world_;
}

}  // namespace swarmsmith::cli
