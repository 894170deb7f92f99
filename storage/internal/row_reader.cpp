#include "storage/internal/row_reader.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "base/assert.h"
#include "storage/internal/candidate_code.h"
#include "storage/internal/columns.h"
#include "storage/renumber.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

using sqlite::Statement;
using OnRow = std::function<void(const Row&)>;

CandidateId candidate_at(const Statement& row, int column) {
  return {row.integer(column)};
}
DesignId design_at(const Statement& row, int column) {
  return {row.integer(column)};
}

/// Throws for a value that this version does not know: it is from a later version, or damaged.
template <class Value>
Value known(std::optional<Value> value, const char* what, std::int64_t number) {
  if (value) return *value;
  throw sqlite::SqliteError(
      SQLITE_CORRUPT,
      fmt::format("the store has {} {}, which this version does not know", what, number));
}
Purpose purpose_at(const Statement& row, int column) {
  return known(purpose_of(row.integer(column)), "the purpose", row.integer(column));
}
EvaluationStatus status_at(const Statement& row, int column) {
  return known(status_of(row.integer(column)), "the status", row.integer(column));
}
EvaluationKey key_at(const Statement& row, int column) {
  return {candidate_at(row, column), purpose_at(row, column + 1), row.integer(column + 2)};
}

/// Conditions that select the part by a column with the id of a design, or of a candidate.
std::string designs_of(const Part& part, const char* column) {
  if (!part.designs) return "1";
  return fmt::format("{} BETWEEN {} AND {}", column, part.designs_before + 1,
                     part.designs_before + *part.designs);
}
std::string candidates_of(const Part& part, const char* column) {
  if (!part.designs) return "1";
  return fmt::format("{} BETWEEN {} AND {}", column, part.designs_before * kCandidatesPerDesign + 1,
                     (part.designs_before + *part.designs) * kCandidatesPerDesign);
}

/// The shift to the ids that the designs have when their campaign is alone in a store.
Shift shift_of(const Part& part) {
  return {.designs = -part.designs_before};
}

/// Runs `sql`, makes a row of each result with `make`, and passes it to `on_row`.
template <class Make>
void each(const sqlite::Connection& connection, const Part& part, const std::string& sql,
          const OnRow& on_row, Make make) {
  Statement row(connection, sql);
  const Shift shift = shift_of(part);
  while (row.step())
    on_row(shift.designs == 0 ? Row(make(row)) : shifted(make(row), shift));
}

std::string design_states_of(const Part& part) {
  return "SELECT " + kDesignStateColumns.names() + " FROM design WHERE " + designs_of(part, "id") +
         " ORDER BY id";
}

DesignStateRow design_state(const Statement& row) {
  return {.design = design_at(row, kDesignStateColumns.at("id")),
          .state = known(state_of(row.integer(kDesignStateColumns.at("state"))), "the state",
                         row.integer(kDesignStateColumns.at("state"))),
          .used = row.integer(kDesignStateColumns.at("used")),
          .iteration = row.integer(kDesignStateColumns.at("iteration")),
          .best = candidate_at(row, kDesignStateColumns.at("best")),
          .best_mean = row.real(kDesignStateColumns.at("best_mean")),
          .reason = row.text(kDesignStateColumns.at("reason"))};
}

IterationRow iteration(const Statement& row) {
  return {.design = design_at(row, kIterationColumns.at("design")),
          .number = row.integer(kIterationColumns.at("number")),
          .of = row.integer(kIterationColumns.at("planned")),
          .budget = row.integer(kIterationColumns.at("budget")),
          .configurations = row.integer(kIterationColumns.at("configurations")),
          .elites = row.integer(kIterationColumns.at("elites")),
          .soft_restart = row.integer(kIterationColumns.at("soft_restart")) != 0,
          .postselection = row.integer(kIterationColumns.at("postselection")) != 0,
          .model_digest = row.bits(kIterationColumns.at("model_digest"))};
}

std::optional<std::string> optional_text(const Statement& row, int column) {
  return row.is_null(column) ? std::nullopt : std::optional(row.text(column));
}

/// Calls `take(candidate, whole)` with every candidate by id; `whole` is false when the store lacks
/// phrases of its texts. Stores before schema 4 have no phrases: their texts are stored as they
/// are.
template <class Take>
void each_candidate(const sqlite::Connection& connection, const Part& part, Take take) {
  PhraseBook phrases;
  if (schema_of(connection) >= 4) phrases.load(connection);
  constexpr auto& kAll = kCandidateColumns;
  Statement row(connection, "SELECT " + kAll.names(schema_of(connection)) +
                                " FROM candidate WHERE " + candidates_of(part, "id") +
                                " ORDER BY id");
  const Shift shift = shift_of(part);
  while (row.step()) {
    CandidateRow candidate{.id = candidate_at(row, kAll.at("id")),
                           .iteration = row.integer(kAll.at("iteration")),
                           .parent = candidate_at(row, kAll.at("parent")),
                           .parameters = {},
                           .machine = {},
                           .modules = {},
                           .states = row.integer(kAll.at("states")),
                           .transitions = row.integer(kAll.at("transitions"))};
    const StoredTexts texts{.machine = row.text(kAll.at("machine")),
                            .parameters = row.text(kAll.at("parameters")),
                            .modules = row.text(kAll.at("modules")),
                            .code = optional_text(row, kAll.at("code")),
                            .module_code = optional_text(row, kAll.at("module_code"))};
    const bool whole = phrases.decode(texts, candidate);
    take(std::get<CandidateRow>(shifted(std::move(candidate), shift)), whole);
  }
}

PairRow pair(const Statement& row) {
  return {.design = design_at(row, kPairColumns.at("design")),
          .purpose = purpose_at(row, kPairColumns.at("purpose")),
          .number = row.integer(kPairColumns.at("number")),
          .instance = row.integer(kPairColumns.at("instance")),
          .seed = row.integer(kPairColumns.at("seed"))};
}

/// The statement has the table's columns, then the iteration, then the name of the source.
EvaluationRow evaluation(const Statement& row) {
  constexpr auto& kAll = kEvaluationColumns;
  static_assert(kAll.size() - kMeasuredFields == 8, "a new column is read here");
  return {.key = key_at(row, kAll.at("candidate")),
          .iteration = row.integer(kAll.size()),
          .status = status_at(row, kAll.at("status")),
          .measured = measured_at(row),
          .bound = row.real(kAll.at("bound")),
          .source = row.text(kAll.size() + 1),
          .worker = row.integer(kAll.at("worker")),
          .attempt = row.integer(kAll.at("attempt"))};
}

RaceStepRow race_step(const Statement& row) {
  const std::string marker = row.text(kRaceStepColumns.at("marker"));
  return {.design = design_at(row, kRaceStepColumns.at("design")),
          .step = row.integer(kRaceStepColumns.at("step")),
          .iteration = row.integer(kRaceStepColumns.at("iteration")),
          .pair = row.integer(kRaceStepColumns.at("pair")),
          .marker = marker.empty() ? 'x' : marker.front(),
          .evaluated = row.integer(kRaceStepColumns.at("evaluated")),
          .alive_before = row.integer(kRaceStepColumns.at("alive_before")),
          .alive_after = row.integer(kRaceStepColumns.at("alive_after")),
          .best = candidate_at(row, kRaceStepColumns.at("best")),
          .mean_best = row.real(kRaceStepColumns.at("mean_best")),
          .used = row.integer(kRaceStepColumns.at("used")),
          .statistic = row.optional_real(kRaceStepColumns.at("statistic")),
          .p_value = row.optional_real(kRaceStepColumns.at("p_value")),
          .kendall_w = row.optional_real(kRaceStepColumns.at("kendall_w")),
          .spearman_rho = row.optional_real(kRaceStepColumns.at("spearman_rho")),
          .qvar = row.optional_real(kRaceStepColumns.at("qvar")),
          .bound = row.optional_real(kRaceStepColumns.at("bound")),
          .digest = row.bits(kRaceStepColumns.at("digest"))};
}

EliminationRow elimination(const Statement& row) {
  return {.candidate = candidate_at(row, kEliminationColumns.at("candidate")),
          .iteration = row.integer(kEliminationColumns.at("iteration")),
          .step = row.integer(kEliminationColumns.at("step")),
          .rank_sum = row.real(kEliminationColumns.at("rank_sum")),
          .reason = row.text(kEliminationColumns.at("reason"))};
}

EliteRow elite(const Statement& row) {
  return {.design = design_at(row, kEliteColumns.at("design")),
          .iteration = row.integer(kEliteColumns.at("iteration")),
          .rank = row.integer(kEliteColumns.at("rank")),
          .candidate = candidate_at(row, kEliteColumns.at("candidate")),
          .mean = row.real(kEliteColumns.at("mean")),
          .runs = row.integer(kEliteColumns.at("runs"))};
}

CandidateTotalsRow totals(const Statement& row) {
  return {.candidate = candidate_at(row, kTotalsColumns.at("candidate")),
          .runs = row.integer(kTotalsColumns.at("runs")),
          .score_sum = row.real(kTotalsColumns.at("score_sum")),
          .score_squares = row.real(kTotalsColumns.at("score_squares"))};
}

CommandRow command(const Statement& row) {
  return {.number = row.integer(kCommandColumns.at("number")),
          .kind = command_kind_of(row.text(kCommandColumns.at("kind"))),
          .design = design_at(row, kCommandColumns.at("design")),
          .step = row.is_null(kCommandColumns.at("step"))
                      ? std::nullopt
                      : std::optional(row.integer(kCommandColumns.at("step"))),
          .budget = row.integer(kCommandColumns.at("budget")),
          .who = row.text(kCommandColumns.at("who"))};
}

}  // namespace

std::int64_t schema_of(const sqlite::Connection& connection) {
  return sqlite::integer_of(connection, "PRAGMA user_version");
}

std::vector<StoredCampaign> read_campaigns(const sqlite::Connection& connection) {
  std::vector<StoredCampaign> campaigns;
  const bool several = schema_of(connection) >= 4;
  Statement row(connection, std::string("SELECT name, digest, deciding, file, seed, id, state, ") +
                                (several ? "designs_before, (SELECT count(*) FROM design AS d"
                                           " WHERE d.campaign = campaign.id)"
                                         : "0, (SELECT count(*) FROM design)") +
                                " FROM campaign ORDER BY id");
  while (row.step()) {
    campaigns.push_back({.id = row.integer(5),
                         .row = {.name = row.text(0),
                                 .digest = row.text(1),
                                 .deciding = row.text(2),
                                 .file = row.text(3),
                                 .seed = row.integer(4)},
                         .state = row.text(6),
                         .designs_before = row.integer(7),
                         .designs = row.integer(8)});
  }
  // Ids of candidates and of evaluations are computed from ids of designs.
  constexpr std::int64_t kMost =
      std::numeric_limits<std::int64_t>::max() / kCandidatesPerDesign / kPairsPerCandidate - 1;
  for (const StoredCampaign& campaign : campaigns) {
    if (campaign.designs_before >= 0 && campaign.designs_before <= kMost - campaign.designs)
      continue;
    connection.fail(SQLITE_CORRUPT, fmt::format("the table campaign says that there are {} designs "
                                                "before those of campaign {}",
                                                campaign.designs_before, campaign.id));
  }
  if (campaigns.empty()) connection.fail(SQLITE_CORRUPT, "the table campaign has no row");
  return campaigns;
}

std::vector<DesignRow> read_designs(const sqlite::Connection& connection, const Part& part) {
  std::vector<DesignRow> designs;
  const std::string flavour = schema_of(connection) < 4 ? "''" : "flavour";
  Statement row(connection, "SELECT id, mission, method, repetition, seed, budget, " + flavour +
                                " FROM design WHERE " + designs_of(part, "id") + " ORDER BY id");
  while (row.step()) {
    designs.push_back({.id = {row.integer(0) - part.designs_before},
                       .mission = row.text(1),
                       .method = row.text(2),
                       .flavour = row.text(6),
                       .repetition = row.integer(3),
                       .seed = row.integer(4),
                       .budget = row.integer(5)});
  }
  return designs;
}

std::vector<StoredScore> read_scores(const sqlite::Connection& connection, const Part& part) {
  constexpr auto& kAll = kEvaluationColumns;
  static_assert(kAll.size() - kMeasuredFields == 8,
                "a new column is read here, if a resume needs it");
  std::vector<StoredScore> scores;
  Statement row(connection, "SELECT " + kAll.names(schema_of(connection)) +
                                ", iteration FROM evaluation WHERE " +
                                candidates_of(part, "candidate") +
                                " ORDER BY candidate, purpose, pair");
  const Shift shift = shift_of(part);
  while (row.step()) {
    scores.push_back({.key = shifted(key_at(row, kAll.at("candidate")), shift),
                      .status = status_at(row, kAll.at("status")),
                      .measured = measured_at(row),
                      .bound = row.real(kAll.at("bound")),
                      .iteration = row.integer(kAll.size()),
                      .worker = row.integer(kAll.at("worker"))});
  }
  return scores;
}

Part first_campaign(const sqlite::Connection& connection) {
  const StoredCampaign first = read_campaigns(connection).front();
  return {.designs_before = first.designs_before, .designs = first.designs};
}

std::vector<StoredStep> read_steps(const sqlite::Connection& connection, const Part& part) {
  std::vector<StoredStep> steps;
  Statement row(connection, "SELECT design, step, digest FROM race_step WHERE " +
                                designs_of(part, "design") + " ORDER BY design, step");
  while (row.step()) {
    steps.push_back({.design = design_at(row, 0), .step = row.integer(1), .digest = row.bits(2)});
  }
  return steps;
}

std::vector<DesignStateRow> read_design_states(const sqlite::Connection& connection) {
  std::vector<DesignStateRow> states;
  Statement row(connection, "SELECT " + kDesignStateColumns.names() +
                                " FROM design WHERE campaign = 1 ORDER BY id");
  while (row.step())
    states.push_back(design_state(row));
  return states;
}

std::vector<TestedDesign> read_tested_designs(const sqlite::Connection& connection) {
  std::vector<TestedDesign> tested;
  Statement row(connection,
                "SELECT e.candidate, avg(e.score), count(*) FROM design AS d"
                " JOIN evaluation AS e ON e.candidate = d.best AND e.purpose = 2"
                " WHERE d.campaign = 1 AND e.score IS NOT NULL AND NOT EXISTS"
                " (SELECT 1 FROM pair AS p WHERE p.design = d.id AND p.purpose = 5)"
                " GROUP BY e.candidate ORDER BY e.candidate");
  while (row.step())
    tested.push_back({.winner = {row.integer(0)}, .mean = row.real(1), .runs = row.integer(2)});
  return tested;
}

std::vector<CommandRow> read_commands(const sqlite::Connection& connection, const Part& part) {
  std::vector<CommandRow> commands;
  if (schema_of(connection) < 3) return commands;
  each(
      connection, part,
      "SELECT " + kCommandColumns.names() + " FROM command WHERE " + designs_of(part, "design") +
          " ORDER BY number",
      [&](const Row& row) { commands.push_back(std::get<CommandRow>(row)); }, command);
  return commands;
}

std::int64_t read_next_worker(const sqlite::Connection& connection) {
  Statement row(connection, "SELECT coalesce(max(id), 0) + 1 FROM worker");
  return row.step() ? row.integer(0) : 1;
}

StoredTrust read_trust(const sqlite::Connection& connection) {
  StoredTrust trust;
  Statement worker(connection,
                   "SELECT id, principal, state, client, identity FROM worker"
                   " WHERE principal <> ''");
  // The reason is in the last event about the principal, or about its one process.
  Statement cause(connection,
                  "SELECT time, text ->> '$.reason' FROM event"
                  " WHERE kind = 'workers in quarantine' AND json_valid(text)"
                  " AND text ->> '$.who' = ?1"
                  " AND (?2 = 0 OR coalesce(text ->> '$.worker', ?2) = ?2)"
                  " ORDER BY seq DESC LIMIT 1");
  while (worker.step()) {
    const WorkerRow row{.id = worker.integer(0),
                        .identity = worker.text(4),
                        .state = worker.text(2) == word_of(WorkerState::Quarantined)
                                     ? WorkerState::Quarantined
                                     : WorkerState::Left,
                        .client = worker.text(3),
                        .principal = worker.text(1)};
    trust.principals.emplace(row.id, row.principal);
    std::optional<Quarantine> quarantine = quarantine_of(row);
    if (!quarantine) continue;
    cause.bind(row.principal, quarantine->identity.empty() ? 0 : row.id);
    if (cause.step()) quarantine->since = cause.text(0), quarantine->reason = cause.text(1);
    trust.quarantined.push_back(std::move(*quarantine));
  }
  Statement audited(connection,
                    "SELECT candidate, purpose, pair FROM attempt WHERE outcome = 'audited'");
  while (audited.step())
    trust.audited.insert(key_at(audited, 0));
  trust.distrusted = sqlite::integer_of(connection,
                                        "SELECT count(*) FROM campaign"
                                        " WHERE id = 1 AND state = 'distrusted'") > 0;
  return trust;
}

std::string keep_secret(sqlite::Connection& connection, const std::string& fresh) {
  sqlite::Transaction transaction(connection);
  Statement(connection, "INSERT OR IGNORE INTO meta VALUES ('lease_secret', ?)").run(fresh);
  const std::string kept =
      sqlite::text_of(connection, "SELECT value FROM meta WHERE key = 'lease_secret'");
  transaction.commit();
  return kept;
}

void forget_secret(sqlite::Connection& connection) {
  // This also removes the secret's bytes from the file.
  connection.execute(
      "PRAGMA secure_delete = ON; DELETE FROM meta WHERE key = 'lease_secret';"
      "PRAGMA secure_delete = OFF");
}

namespace {

/// Prefix of the names of profiles in the table `meta`.
constexpr std::string_view kProfileKey = "profile:";

}  // namespace

std::map<std::string, std::string> read_kept_profiles(const sqlite::Connection& connection) {
  std::map<std::string, std::string> profiles;
  Statement row(connection,
                "SELECT substr(key, ?1 + 1), value FROM meta WHERE substr(key, 1, ?1) = ?2");
  row.bind(std::ssize(kProfileKey), kProfileKey);
  while (row.step())
    profiles.emplace(row.text(0), row.text(1));
  return profiles;
}

bool keep_profile(sqlite::Connection& connection, const std::string& name,
                  const std::string& text) {
  const std::string key = std::string(kProfileKey) + name;
  Statement(connection, "INSERT OR IGNORE INTO meta VALUES (?,?)").run(key, text);
  Statement kept(connection, "SELECT value FROM meta WHERE key = ?");
  kept.bind(key);
  return kept.step() && kept.text(0) == text;
}

bool is_finished(const sqlite::Connection& connection) {
  return sqlite::integer_of(connection,
                            "SELECT count(*) FROM campaign"
                            " WHERE state NOT IN ('finished', 'imported')") == 0;
}

std::vector<CandidateId> candidates_without_phrases(const sqlite::Connection& connection) {
  std::vector<CandidateId> lost;
  each_candidate(connection, {}, [&](const CandidateRow& candidate, bool whole) {
    if (!whole) lost.push_back(candidate.id);
  });
  return lost;
}

void read_candidates(const sqlite::Connection& connection, const Part& part, const OnRow& on_row) {
  each_candidate(connection, part, [&](const CandidateRow& candidate, bool whole) {
    if (!whole) {
      connection.fail(
          SQLITE_CORRUPT,
          to_string(candidate.id) +
              " refers to phrases that do not exist, or its text is longer than a store's");
    }
    on_row(candidate);
  });
}

void read_answer(const sqlite::Connection& connection, const Part& part, const OnRow& on_row) {
  const std::string designs = designs_of(part, "design");
  const std::string candidates = candidates_of(part, "candidate");
  each(connection, part, design_states_of(part), on_row, design_state);
  const std::int64_t schema = schema_of(connection);
  each(connection, part,
       "SELECT " + kIterationColumns.names(schema) + " FROM iteration WHERE " + designs +
           " ORDER BY design, number",
       on_row, iteration);
  read_candidates(connection, part, on_row);
  const std::string always = "purpose IN " + numbers_in_sql(always_counts);
  const std::string race = fmt::format("purpose = {}", static_cast<int>(Purpose::Race));
  // A pair that only look-ahead evaluations have used so far is not part of the answer.
  each(connection, part,
       "SELECT " + kPairColumns.names() + " FROM pair WHERE " + designs + " AND (" + always +
           " OR " + race +
           " AND (design, number) IN (SELECT design, pair FROM race_step))"
           " ORDER BY design, purpose, number",
       on_row, pair);
  each(connection, part,
       "SELECT " + kEvaluationColumns.names(schema) +
           ", iteration, (SELECT name FROM source WHERE id = evaluation.source)"
           " FROM evaluation WHERE " +
           candidates + " AND (" + always + " OR " + race +
           " AND iteration IS NOT NULL)"
           " ORDER BY candidate, purpose, pair",
       on_row, evaluation);
  each(connection, part,
       "SELECT " + kRaceStepColumns.names(schema) + " FROM race_step WHERE " + designs +
           " ORDER BY design, step",
       on_row, race_step);
  each(connection, part,
       "SELECT " + kEliminationColumns.names() + " FROM elimination WHERE " + candidates +
           " ORDER BY candidate, iteration",
       on_row, elimination);
  each(connection, part,
       "SELECT " + kEliteColumns.names() + " FROM elite WHERE " + designs +
           " ORDER BY design, iteration, rank",
       on_row, elite);
  each(connection, part,
       "SELECT " + kTotalsColumns.names() + " FROM candidate_totals WHERE " + candidates +
           " ORDER BY candidate",
       on_row, totals);
  if (schema < 3) return;
  each(connection, part,
       "SELECT " + kCommandColumns.names() +
           " FROM command WHERE kind IN ('cancel', 'extend') AND step IS NOT NULL AND " + designs +
           " ORDER BY design, step, number",
       on_row, command);
}

}  // namespace swarmsmith
