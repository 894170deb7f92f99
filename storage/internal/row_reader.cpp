#include "storage/internal/row_reader.h"

#include <string>

#include <fmt/format.h>

#include "base/assert.h"
#include "storage/internal/candidate_code.h"
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

/// A value that this version does not know: of a later one, or damage.
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

/// A store of schema 1, which has none of the columns that targets brought: read as it is.
bool is_first_schema(const sqlite::Connection& connection) {
  return schema_of(connection) == 1;
}

/// Conditions on a column that names a design, or a candidate.
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

/// To the ids of a store of its own.
Shift shift_of(const Part& part) {
  return {.designs = -part.designs_before};
}

/// Runs `sql` and hands on what `make` makes of each row.
template <class Make>
void each(const sqlite::Connection& connection, const Part& part, const std::string& sql,
          const OnRow& on_row, Make make) {
  Statement row(connection, sql);
  const Shift shift = shift_of(part);
  while (row.step())
    on_row(shift.designs == 0 ? Row(make(row)) : shifted(make(row), shift));
}

std::string design_states_of(const Part& part) {
  return "SELECT id, state, used, iteration, best, best_mean, reason FROM design WHERE " +
         designs_of(part, "id") + " ORDER BY id";
}

DesignStateRow design_state(const Statement& row) {
  return {.design = design_at(row, 0),
          .state = known(state_of(row.integer(1)), "the state", row.integer(1)),
          .used = row.integer(2),
          .iteration = row.integer(3),
          .best = candidate_at(row, 4),
          .best_mean = row.real(5),
          .reason = row.text(6)};
}

IterationRow iteration(const Statement& row) {
  return {.design = design_at(row, 0),
          .number = row.integer(1),
          .of = row.integer(2),
          .budget = row.integer(3),
          .configurations = row.integer(4),
          .elites = row.integer(5),
          .soft_restart = row.integer(6) != 0,
          .postselection = row.integer(8) != 0,
          .model_digest = row.bits(7)};
}

std::optional<std::string> optional_text(const Statement& row, int column) {
  return row.is_null(column) ? std::nullopt : std::optional(row.text(column));
}

std::string codes_in(const sqlite::Connection& connection) {
  return schema_of(connection) < 4 ? "NULL, NULL" : "code, module_code";
}

/// Calls `take(candidate, whole)` with every candidate by id; `whole` is false when the store lacks
/// phrases of its texts. Stores before schema 4 know no phrases: their texts are as they are.
template <class Take>
void each_candidate(const sqlite::Connection& connection, const Part& part, Take take) {
  PhraseBook phrases;
  if (schema_of(connection) >= 4) phrases.load(connection);
  Statement row(
      connection,
      "SELECT id, iteration, parent, states, transitions, machine, parameters, modules, " +
          codes_in(connection) + " FROM candidate WHERE " + candidates_of(part, "id") +
          " ORDER BY id");
  const Shift shift = shift_of(part);
  while (row.step()) {
    CandidateRow candidate{.id = candidate_at(row, 0),
                           .iteration = row.integer(1),
                           .parent = candidate_at(row, 2),
                           .parameters = {},
                           .machine = {},
                           .modules = {},
                           .states = row.integer(3),
                           .transitions = row.integer(4)};
    const StoredTexts texts{.machine = row.text(5),
                            .parameters = row.text(6),
                            .modules = row.text(7),
                            .code = optional_text(row, 8),
                            .module_code = optional_text(row, 9)};
    const bool whole = phrases.decode(texts, candidate);
    take(std::get<CandidateRow>(shifted(std::move(candidate), shift)), whole);
  }
}

PairRow pair(const Statement& row) {
  return {.design = design_at(row, 0),
          .purpose = purpose_at(row, 1),
          .number = row.integer(2),
          .instance = row.integer(3),
          .seed = row.integer(4)};
}

EvaluationRow evaluation(const Statement& row) {
  return {.key = key_at(row, 0),
          .iteration = row.integer(3),
          .status = status_at(row, 4),
          .score = row.real(5),
          .state_digest = row.bits(6),
          .time = row.real(11),
          .bound = row.real(12),
          .source = row.text(7),
          .wall_us = row.integer(8),
          .worker = row.integer(9),
          .attempt = row.integer(10)};
}

RaceStepRow race_step(const Statement& row) {
  const std::string marker = row.text(4);
  return {.design = design_at(row, 0),
          .step = row.integer(1),
          .iteration = row.integer(2),
          .pair = row.integer(3),
          .marker = marker.empty() ? 'x' : marker.front(),
          .evaluated = row.integer(5),
          .alive_before = row.integer(6),
          .alive_after = row.integer(7),
          .best = candidate_at(row, 8),
          .mean_best = row.real(9),
          .used = row.integer(10),
          .statistic = row.optional_real(11),
          .p_value = row.optional_real(12),
          .kendall_w = row.optional_real(13),
          .spearman_rho = row.optional_real(14),
          .qvar = row.optional_real(15),
          .bound = row.optional_real(17),
          .digest = row.bits(16)};
}

EliminationRow elimination(const Statement& row) {
  return {.candidate = candidate_at(row, 0),
          .iteration = row.integer(1),
          .step = row.integer(2),
          .rank_sum = row.real(3),
          .reason = row.text(4)};
}

EliteRow elite(const Statement& row) {
  return {.design = design_at(row, 0),
          .iteration = row.integer(1),
          .rank = row.integer(2),
          .candidate = candidate_at(row, 3),
          .mean = row.real(4),
          .runs = row.integer(5)};
}

CandidateTotalsRow totals(const Statement& row) {
  return {.candidate = candidate_at(row, 0),
          .runs = row.integer(1),
          .score_sum = row.real(2),
          .score_squares = row.real(3)};
}

CommandRow command(const Statement& row) {
  return {.number = row.integer(0),
          .kind = command_kind_of(row.text(1)),
          .design = design_at(row, 2),
          .step = row.is_null(3) ? std::nullopt : std::optional(row.integer(3)),
          .budget = row.integer(4),
          .who = row.text(5)};
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
  std::vector<StoredScore> scores;
  const std::string times = is_first_schema(connection) ? "NULL, NULL" : "time, bound";
  Statement row(connection, "SELECT candidate, purpose, pair, status, score, state_digest, " +
                                times + ", iteration, worker FROM evaluation WHERE " +
                                candidates_of(part, "candidate") +
                                " ORDER BY candidate, purpose, pair");
  const Shift shift = shift_of(part);
  while (row.step()) {
    scores.push_back({.key = shifted(key_at(row, 0), shift),
                      .status = status_at(row, 3),
                      .score = row.real(4),
                      .state_digest = row.bits(5),
                      .time = row.real(6),
                      .bound = row.real(7),
                      .iteration = row.integer(8),
                      .worker = row.integer(9)});
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
  Statement row(connection,
                "SELECT id, state, used, iteration, best, best_mean, reason FROM design"
                " WHERE campaign = 1 ORDER BY id");
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
      "SELECT number, kind, design, step, budget, who FROM command WHERE " +
          designs_of(part, "design") + " ORDER BY number",
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
  // The last event about the principal says why, or about its one process.
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
  // Its bytes do not stay behind in the file either.
  connection.execute(
      "PRAGMA secure_delete = ON; DELETE FROM meta WHERE key = 'lease_secret';"
      "PRAGMA secure_delete = OFF");
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
              " names phrases that do not exist, or makes more text of them than a store's");
    }
    on_row(candidate);
  });
}

void read_answer(const sqlite::Connection& connection, const Part& part, const OnRow& on_row) {
  const std::string designs = designs_of(part, "design");
  const std::string candidates = candidates_of(part, "candidate");
  each(connection, part, design_states_of(part), on_row, design_state);
  const bool first = is_first_schema(connection);
  each(connection, part,
       std::string("SELECT *") + (first ? ", 0" : "") + " FROM iteration WHERE " + designs +
           " ORDER BY design, number",
       on_row, iteration);
  read_candidates(connection, part, on_row);
  const std::string always = "purpose IN " + numbers_in_sql(always_counts);
  const std::string race = fmt::format("purpose = {}", static_cast<int>(Purpose::Race));
  // A pair that only look-ahead has touched so far is not part of the answer.
  each(connection, part,
       "SELECT * FROM pair WHERE " + designs + " AND (" + always + " OR " + race +
           " AND (design, number) IN (SELECT design, pair FROM race_step))"
           " ORDER BY design, purpose, number",
       on_row, pair);
  each(connection, part,
       std::string("SELECT candidate, purpose, pair, iteration, status, score, state_digest,"
                   " (SELECT name FROM source WHERE id = evaluation.source), wall_us, worker,"
                   " attempt, ") +
           (first ? "NULL, NULL" : "time, bound") + " FROM evaluation WHERE " + candidates +
           " AND (" + always + " OR " + race +
           " AND iteration IS NOT NULL)"
           " ORDER BY candidate, purpose, pair",
       on_row, evaluation);
  each(connection, part,
       std::string("SELECT *") + (first ? ", NULL" : "") + " FROM race_step WHERE " + designs +
           " ORDER BY design, step",
       on_row, race_step);
  each(connection, part,
       "SELECT * FROM elimination WHERE " + candidates + " ORDER BY candidate, iteration", on_row,
       elimination);
  each(connection, part,
       "SELECT * FROM elite WHERE " + designs + " ORDER BY design, iteration, rank", on_row, elite);
  each(connection, part,
       "SELECT * FROM candidate_totals WHERE " + candidates + " ORDER BY candidate", on_row,
       totals);
  if (schema_of(connection) < 3) return;
  each(connection, part,
       "SELECT number, kind, design, step, budget, who FROM command"
       " WHERE kind IN ('cancel', 'extend') AND step IS NOT NULL AND " +
           designs + " ORDER BY design, step, number",
       on_row, command);
}

}  // namespace swarmsmith
