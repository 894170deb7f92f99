#include "cli/replay/stored_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "cli/output/query_output.h"
#include "coordinator/campaign/campaign_file.h"
#include "sim/files/profile_file.h"
#include "storage/stored_enums.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;

/// How many of `count` evenly spaced items are among the first n of `total`.
std::int64_t multiples(std::int64_t n, std::int64_t count, std::int64_t total) {
  return n * count / total;
}

/// The column with the party that is responsible for a worker, as far as this schema has it.
std::string who(std::int64_t schema) {
  if (schema >= 6) return "w.principal";
  return schema >= 3 ? "w.client" : "''";
}

/// SQL that returns the columns of a run in the order of `read_outcome`.
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

/// Reads the row of the evaluation.
StoredRun read_outcome(const std::vector<Cell>& cells) {
  StoredRun run{.id = cells[0].text, .candidate = cells[1].text};
  run.seed = cells[2].integer();
  run.rejected = cells[3].text == "rejected";
  if (cells[4].type != Cell::Type::Null) {
    run.outcome = Measured{cells[4].real(), static_cast<std::uint64_t>(cells[5].integer())};
  }
  run.worker = cells[9].integer();
  run.host = cells[10].text;
  run.who = cells[11].text;
  return run;
}

/// The profile with the name of a source, or the reason why there is none.
Expected<Profile> profile_of(const DesignWorld& world, const std::string& source) {
  if (world.profile && source == world.profile->name) return *world.profile;
  const auto further = std::ranges::find(world.further_profiles, source, &Profile::name);
  if (further != world.further_profiles.end()) return *further;
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

/// Adds the other inputs of the run, besides its seed and its profile.
Expected<void> complete(StoredRun& run, const DesignWorld& world, const std::string& text) {
  if (!world.mission) {
    return bad_input("the store's campaign has no mission " + world.design.mission);
  }
  run.engine_version = world.engine_version;
  run.mission = world.mission->mission;
  if (world.flavour.empty()) {
    return bad_input("the store's campaign has no method " + world.design.method);
  }
  auto flavour =
      find_flavour(world.flavour, world.turn_clock.value_or(TurnClock::Cycles), world.own_flavour);
  if (!flavour) return Unexpected(flavour.error());
  run.flavour = std::move(*flavour);
  auto controller = parse_controller(text, run.flavour);
  if (!controller) return Unexpected(controller.error());
  if (const auto complaint = complaint_about_running(*controller, run.flavour))
    return bad_input(*complaint);
  run.controller = std::move(*controller);
  auto instance = instance_of(run.mission, run.seed);
  if (!instance) return Unexpected(instance.error());
  run.instance = std::move(*instance);
  return {};
}

/// For millions of rows that are read one by one.
constexpr StoreReader::QueryLimits kAllRows{.rows = std::numeric_limits<std::int64_t>::max(),
                                            .seconds = 600,
                                            .bytes = std::numeric_limits<std::int64_t>::max()};

/// Calls `on_row` for each row; an error if some rows are missing.
Expected<void> each_row(StoreReader& store, const std::string& sql,
                        const std::function<void(const std::vector<Cell>&)>& on_row) {
  const auto end = store.query(
      sql, kAllRows, [](const auto&) {}, on_row);
  if (!end) return Unexpected(end.error());
  if (end->truncated) {
    return unexpected(
        ErrorKind::Unavailable,
        fmt::format("the evaluations could not be read within {} s", kAllRows.seconds));
  }
  return {};
}

/// Draws evaluations in a pseudo-random order. For each responsible party it keeps the first
/// `count` of that order, and nothing else of the store.
class Draw {
 public:
  explicit Draw(const StoredRuns::Wanted& wanted)
      : seed_(wanted.seed), count_(static_cast<std::size_t>(wanted.scores)) {}

  /// `key` is different for each evaluation. The order is by numbers below 2^31, whose squares do
  /// not overflow.
  void add(const std::string& who, std::int64_t key, const std::string& id) {
    constexpr std::int64_t kPrime = 2'147'483'629;
    const std::int64_t x = (key + seed_) % kPrime;
    const std::int64_t y = (x * x + seed_) % kPrime;
    const std::int64_t place = y * y % kPrime;
    std::vector<Drawn>& first = first_[who];  // a heap: the last one in the order is at the front
    if (first.size() == count_) {
      if (std::tie(place, id) >= std::tie(first.front().first, first.front().second)) return;
      std::ranges::pop_heap(first);
      first.pop_back();
    }
    first.emplace_back(place, id);
    std::ranges::push_heap(first);
  }

  /// The drawn ids, from each responsible party in turn.
  std::vector<std::string> ids() {
    std::vector<std::pair<std::size_t, Drawn>> all;
    for (auto& [who, first] : first_) {
      std::ranges::sort(first);
      for (std::size_t n = 0; n < first.size(); ++n)
        all.emplace_back(n, std::move(first[n]));
    }
    std::ranges::sort(all);
    all.resize(std::min(all.size(), count_));
    std::vector<std::string> ids;
    for (auto& [n, drawn] : all)
      ids.push_back(std::move(drawn.second));
    return ids;
  }

 private:
  using Drawn = std::pair<std::int64_t, std::string>;  ///< place in the order, id
  std::int64_t seed_;
  std::size_t count_;
  std::map<std::string, std::vector<Drawn>> first_;  ///< by responsible party
};

}  // namespace

std::string other_engine(int stored_version, int version) {
  // A campaign with several missions has the highest of their versions.
  const bool is_same =
      stored_version == version ||
      (version >= kEngineVersion && version < stored_version && stored_version <= kVoteVersion);
  if (is_same || stored_version == 0) return "";
  return "the store's scores are of version " + std::to_string(stored_version) +
         " of the engine, this program has version " + std::to_string(version) +
         ", which may give other bits";
}

Expected<StoredRuns> StoredRuns::open(std::unique_ptr<StoreReader> store) {
  auto runs = open(*store);
  if (runs) runs->owned_ = std::move(store);
  return runs;
}

Expected<StoredRuns> StoredRuns::open(StoreReader& store) {
  auto worlds = DesignWorlds::read(store);
  if (!worlds) return Unexpected(worlds.error());
  if (worlds->designs().empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no designs: there is nothing to simulate");
  }
  const auto first = worlds->of(worlds->designs().front().id);
  if (first) return StoredRuns(store, std::move(*worlds));
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
  const auto world = world_of({cells[8].integer()});
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

Expected<StoredRun> StoredRuns::candidate(const ThingId& id, std::int64_t seed,
                                          const std::string& profile_name) {
  const auto rows =
      select(*store_, "SELECT fsm_config, design FROM v_candidates WHERE candidate = " + id.digits);
  if (!rows) return Unexpected(rows.error());
  StoredRun run{.id = {}, .candidate = "c" + id.digits};
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + run.candidate);
  }
  const auto& cells = rows->cells.front();
  const auto world = world_of({cells[1].integer()});
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
  std::string source = world->profile ? world->profile->name : "command";
  if (!profile_name.empty()) source = profile_name;
  auto profile = profile_of(*world, source);
  if (!profile && !profile_name.empty())
    return bad_input("neither the store nor this program has this profile", profile_name);
  if (!profile) return bad_input(to_string(profile.error()), run.candidate);
  // The pair may have been used for the race and for other purposes; all these rows have the same
  // outcome.
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
  // The n-th of N rows is taken if a multiple of N / count lies in (n - 1, n]. Rows that were not
  // simulated here have no state digest.
  constexpr const char* kSimulated =
      " FROM v_evaluations WHERE status = 'ok' AND source <> 'real' AND seed IS NOT NULL "
      "AND (state_digest <> 0 OR purpose <> 'score')";
  std::int64_t total = 0;
  const auto counted = each_row(*store_, std::string("SELECT count(*)") + kSimulated,
                                [&](const auto& cells) { total = cells.front().integer(); });
  if (!counted) return Unexpected(counted.error());
  std::vector<std::string> ids;
  std::int64_t n = 0;
  const auto read = each_row(
      *store_, std::string("SELECT id") + kSimulated + " ORDER BY candidate, purpose, pair",
      [&](const auto& cells) {
        ++n;
        if (n <= total && multiples(n, count, total) > multiples(n - 1, count, total))
          ids.push_back(cells.front().text);
      });
  if (!read) return Unexpected(read.error());
  return ids;
}

Expected<std::vector<std::string>> StoredRuns::drawn(const std::string& given,
                                                     const Wanted& wanted) {
  std::map<std::int64_t, std::string> who_answers;
  const auto read_workers =
      each_row(*store_, "SELECT w.worker, " + who(store_->schema()) + " FROM v_workers AS w",
               [&](const auto& cells) { who_answers[cells[0].integer()] = cells[1].text; });
  if (!read_workers) return Unexpected(read_workers.error());
  Draw draw(wanted);
  const std::string but = wanted.tests ? " AND e.purpose NOT IN " + words_in_sql(is_test) : "";
  const auto read =
      each_row(*store_,
               "SELECT e.id, e.worker, e.candidate * 100003 + e.pair * 7 + (e.purpose = 'test')" +
                   given + " AND e.status = 'ok'" + but,
               [&](const auto& cells) {
                 const auto known = who_answers.find(cells[1].integer());
                 draw.add(known == who_answers.end() ? "" : known->second, cells[2].integer(),
                          cells[0].text);
               });
  if (!read) return Unexpected(read.error());
  return draw.ids();
}

Expected<std::vector<std::string>> StoredRuns::chosen(const Wanted& wanted) {
  const std::string campaigns = of_campaigns();
  if (campaigns.empty()) return std::vector<std::string>{};
  const std::string given = " FROM v_evaluations AS e WHERE e.source <> 'real' AND " + campaigns;
  const std::string in_order = " ORDER BY e.candidate, e.purpose, e.pair";
  std::vector<std::string> parts;
  if (wanted.rejections)
    parts.push_back("SELECT e.id" + given + " AND e.status = 'rejected'" + in_order);
  if (wanted.tests)
    parts.push_back("SELECT e.id" + given + " AND e.status = 'ok' AND e.purpose IN " +
                    words_in_sql(is_test) + in_order);
  std::vector<std::string> all;
  for (const std::string& sql : parts) {
    const auto ids = ids_of(sql);
    if (!ids) return Unexpected(ids.error());
    all.insert(all.end(), ids->begin(), ids->end());
  }
  if (wanted.scores > 0) {
    const auto ids = drawn(given, wanted);
    if (!ids) return Unexpected(ids.error());
    all.insert(all.end(), ids->begin(), ids->end());
  }
  return all;
}

Expected<std::vector<std::string>> StoredRuns::ids_of(const std::string& sql) {
  std::vector<std::string> ids;
  const auto read =
      each_row(*store_, sql, [&](const auto& cells) { ids.push_back(cells.front().text); });
  if (!read) return Unexpected(read.error());
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
  // The campaign's file is read once for all evaluations of the design.
  if (!world_ || world_->design.id != design) {
    auto world = worlds_.of(design);
    if (!world) return Unexpected(world.error());
    if (!*world) return bad_input("the store has no design " + to_string(design));
    world_ = std::move(**world);
  }
  return *world_;
}

}  // namespace swarmsmith::cli
