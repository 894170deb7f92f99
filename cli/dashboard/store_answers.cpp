#include "cli/dashboard/store_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "analysis/records/records.h"
#include "analysis/statistics/summary.h"
#include "cli/arguments/thing_id.h"
#include "cli/dashboard/view_texts.h"
#include "cli/output/evaluation_history.h"
#include "cli/output/stored_campaigns.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

using Cell = StoreReader::Cell;

constexpr std::int64_t kMostNumber = 1'000'000'000'000;
/// If there are more ancestors, the nearest ones are shown.
constexpr int kMostAncestors = 100;

std::string cell_of(const Rows& rows, std::size_t row, std::string_view column) {
  const auto at = std::ranges::find(rows.columns, column) - rows.columns.begin();
  return rows.cells[row][static_cast<std::size_t>(at)].text;
}

std::optional<JsonObject> first_row(const Rows& rows) {
  return rows.cells.empty() ? std::nullopt : std::optional(row_as_json(rows, 0));
}

/// Returns the first error among the rows.
Expected<void> all_read(std::initializer_list<const Expected<Rows>*> all) {
  for (const Expected<Rows>* rows : all)
    if (!*rows) return Unexpected(rows->error());
  return {};
}

/// The JSON value in a column that contains JSON as text.
JsonPiece json_in(const std::string& text) {
  return {nlohmann::json::accept(text) ? text : json_text(text)};
}

/// {"v":1, ...} with the columns of a statement.
Expected<Answer> columns_answer(const Question& question, const std::string& sql) {
  const auto rows = rows_of(question, sql);
  if (!rows) return Unexpected(rows.error());
  JsonObject object = answer_object();
  add_columns(object, *rows);
  return json_answer(object);
}

/// " WHERE design = 3", from the parameter.
Expected<std::string> of_design(const Question& question) {
  const auto design = question.design_parameter();
  if (!design) return Unexpected(design.error());
  return *design ? " WHERE design = " + std::to_string((*design)->value) : std::string();
}

/// An entry of one of the store's lists of events.
struct Happening {
  std::string at;
  std::optional<std::int64_t> seq;
  std::string severity;
  std::string kind;
  std::string data;
};

/// A list of events; its first column is the time. Audits that found the same bits are left out:
/// there are some each second, and they would hide everything else. A failure is shown only once,
/// from v_failures, which has the most details.
struct List {
  const char* kind;
  const char* severity;
  const char* sql;  ///< {} is the place of a condition on `at`
};

constexpr std::array<List, 4> kLists = {{
    {"command", "info",
     "SELECT at, number, who, kind AS command, 'd' || nullif(design, 0) AS design, step, budget "
     "FROM v_commands WHERE {} ORDER BY number DESC"},
    {"failure", "warning",
     "SELECT at, id, 'd' || design AS design, 'c' || candidate AS candidate, attempt, worker, "
     "host, "
     "reason FROM v_failures WHERE at IS NOT NULL AND {} ORDER BY at DESC"},
    {"attempt", "info",
     "SELECT at, id, 'd' || design AS design, 'c' || candidate AS candidate, attempt, worker, "
     "host, "
     "held_ms, outcome FROM v_attempts WHERE outcome NOT IN ('audited', 'failed') AND {} "
     "ORDER BY at DESC"},
    {"conflict", "error",
     "SELECT * FROM (SELECT time AS at, 'c' || candidate AS candidate, pair, kept_score, "
     "other_score, other_worker FROM conflict) WHERE {} ORDER BY at DESC"},
}};

Expected<void> add_list(const Question& question, const List& list, const std::string& condition,
                        std::int64_t limit, std::vector<Happening>& happenings) {
  const auto rows = rows_of(
      question, fmt::format(fmt::runtime(list.sql), condition) + fmt::format(" LIMIT {}", limit));
  if (!rows) return Unexpected(rows.error());
  for (std::size_t i = 0; i < rows->cells.size(); ++i)
    happenings.push_back({.at = rows->cells[i].front().text,
                          .seq = std::nullopt,
                          .severity = list.severity,
                          .kind = list.kind,
                          .data = row_as_json(*rows, i).text()});
  return {};
}

Expected<Rows> ancestors_of(const Question& question, const std::string& parent) {
  Rows all;
  std::string next = parent;
  for (int i = 0; i < kMostAncestors && !next.empty(); ++i) {
    auto rows = rows_of(question,
                        "SELECT candidate, iteration, parent, n_states, n_transitions, runs, mean, "
                        "eliminated_in, fsm_config FROM v_candidates WHERE candidate = " +
                            next);
    if (!rows) return Unexpected(rows.error());
    all.columns = rows->columns;
    if (rows->cells.empty()) break;
    next = rows->cells.front()[2].text;
    all.cells.push_back(std::move(rows->cells.front()));
  }
  return all;
}

/// The mean of the winner's tests with its interval; null if there are no tests.
Expected<std::optional<JsonObject>> tests_of(const Question& question) {
  const auto rows =
      rows_of(question, fmt::format("SELECT score FROM v_design_scores WHERE design = {} AND "
                                    "purpose = 'test'",
                                    question.design.value));
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) return std::optional<JsonObject>();
  std::vector<double> scores;
  for (const auto& cells : rows->cells)
    scores.push_back(cells.front().real());
  const MeanInterval interval = mean_interval(scores);
  return std::optional(JsonObject()
                           .add("n", scores.size())
                           .add("mean", interval.mean)
                           .add("low", interval.mean - interval.half_width)
                           .add("high", interval.mean + interval.half_width));
}

/// Columns of v_real_runs, and `reasons` of the last scoring.
constexpr std::array<std::string_view, 23> kRealRunColumns = {
    "id",       "run",    "name",     "candidate",  "design",           "mission",
    "source",   "score",  "verdict",  "counts",     "measured_verdict", "overridden_by",
    "reason",   "biased", "recorded", "duration_s", "robots",           "cameras",
    "scorings", "scored", "stored",   "program",    "reasons"};

}  // namespace

Expected<Answer> campaign_answer(const Question& question) {
  const auto rows = rows_of(question, "SELECT * FROM v_campaigns ORDER BY campaign");
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) return unexpected(ErrorKind::Corrupt, "the store has no campaign");
  return json_answer(answer_object()
                         .add("campaign", row_as_json(*rows, 0))
                         .add("campaigns", rows_as_json(*rows))
                         .add("store", (question.is_snapshot ? kSomeStore : question.file).string())
                         .add("schema", question.store.schema())
                         .add("is_written", !question.is_snapshot && has_writer(question.file)));
}

Expected<Answer> events_answer(const Question& question) {
  const auto after = question.integer("after", 0, 0, kMostNumber);
  if (!after) return Unexpected(after.error());
  const auto limit = question.integer("limit", 200, 1, 10'000);
  if (!limit) return Unexpected(limit.error());
  const auto events = rows_of(
      question, fmt::format("SELECT seq, time, severity, kind, text FROM event WHERE seq > {} "
                            "AND (kind <> 'evaluation failed' OR EXISTS (SELECT 1 FROM v_failures "
                            "WHERE at IS NULL)) ORDER BY seq DESC LIMIT {}",
                            *after, *limit));
  if (!events) return Unexpected(events.error());
  std::vector<Happening> happenings;
  for (std::size_t i = 0; i < events->cells.size(); ++i)
    happenings.push_back({.at = cell_of(*events, i, "time"),
                          .seq = std::atoll(cell_of(*events, i, "seq").c_str()),
                          .severity = cell_of(*events, i, "severity"),
                          .kind = cell_of(*events, i, "kind"),
                          .data = json_in(cell_of(*events, i, "text")).text});
  const std::string since =
      *after == 0 ? "1" : fmt::format("at >= (SELECT time FROM event WHERE seq = {})", *after);
  for (const List& list : kLists) {
    if (auto added = add_list(question, list, since, *limit, happenings); !added)
      return Unexpected(added.error());
  }
  std::ranges::stable_sort(happenings, std::ranges::greater(), &Happening::at);
  happenings.resize(std::min(happenings.size(), static_cast<std::size_t>(*limit)));
  const auto last = rows_of(question, "SELECT coalesce(max(seq), 0) FROM event");
  if (!last) return Unexpected(last.error());
  return json_answer(answer_object()
                         .add("last", cell_as_json(last->cells.front().front()))
                         .add("events", json_list(happenings, [](const Happening& each) {
                                return JsonObject()
                                    .add("seq", each.seq)
                                    .add("at", each.at)
                                    .add("severity", each.severity)
                                    .add("kind", each.kind)
                                    .add("data", JsonPiece{each.data});
                              })));
}

Expected<Answer> convergence_answer(const Question& question) {
  const auto where = of_design(question);
  if (!where) return Unexpected(where.error());
  return columns_answer(
      question,
      "SELECT design, iteration, experiments_used AS used, candidate, mean, n, rank FROM "
      "v_convergence" +
          (where->empty() ? " WHERE rank = 1" : *where) + " ORDER BY design, iteration, rank");
}

Expected<Answer> design_answer(const Question& question) {
  if (auto known = check_design(question); !known) return Unexpected(known.error());
  const std::string id = std::to_string(question.design.value);
  const std::string own = " WHERE design = " + id;
  auto design = rows_of(question, "SELECT * FROM " + designs_with_means(question.design));
  auto iterations = rows_of(question,
                            "SELECT iteration, planned, budget, configurations, "
                            "elites, soft_restart, postselection FROM "
                            "v_iterations" +
                                own + " ORDER BY iteration");
  const auto elites = rows_of(question,
                              "SELECT iteration, rank, candidate, mean, n, "
                              "experiments_used FROM v_convergence" +
                                  own + " ORDER BY iteration, rank");
  const auto machine =
      rows_of(question,
              "SELECT c.candidate, c.fsm_config AS text, d.flavour, c.n_states, c.n_transitions "
              "FROM v_designs AS d JOIN v_candidates AS c ON c.candidate = d.best_candidate "
              "WHERE d.design = " +
                  id);
  const auto commands = rows_of(question,
                                "SELECT number, at, who, kind, step, budget FROM "
                                "v_commands" +
                                    own + " ORDER BY number");
  if (auto read = all_read({&design, &iterations, &elites, &machine, &commands}); !read)
    return Unexpected(read.error());
  const auto tests = tests_of(question);
  if (!tests) return Unexpected(tests.error());
  const auto stages = StoredStages::read(question.store, question.design);
  if (!stages) return Unexpected(stages.error());
  for (auto& cells : iterations->cells) {
    const std::string& number = cells.front().text;
    const bool is_last_race = cells.back().text == "1";
    if (stages->search(id) != nullptr) {
      cells.push_back({StoreReader::Cell::Type::Text, stages->round(id, number)});
    } else if (is_last_race) {
      cells.push_back({StoreReader::Cell::Type::Text, number + ", last race"});
    } else {
      cells.push_back({});
    }
  }
  iterations->columns.emplace_back("round");
  letter_ids(*design);
  return json_answer(answer_object()
                         .add("design", first_row(*design))
                         .add("iterations", rows_as_json(*iterations))
                         .add("elites", rows_as_json(*elites))
                         .add("machine", first_row(*machine))
                         .add("tests", *tests)
                         .add("commands", rows_as_json(*commands)));
}

Expected<Answer> steps_answer(const Question& question) {
  if (auto known = check_design(question); !known) return Unexpected(known.error());
  const auto after = question.integer("after", 0, 0, kMostNumber);
  if (!after) return Unexpected(after.error());
  return columns_answer(question,
                        fmt::format("SELECT step, iteration, pair, marker, bound, alive_before, "
                                    "alive_after, best, mean_best, evaluated, used, statistic, "
                                    "p_value, kendall_w, spearman_rho, qvar FROM v_race_steps "
                                    "WHERE design = {} AND step > {} ORDER BY step",
                                    question.design.value, *after));
}

Expected<Answer> candidate_answer(const Question& question) {
  const auto id = id_from_text<CandidateTag>(question.id);
  if (!id) return bad_input("must be a candidate such as c812", question.id);
  const std::string own = " WHERE candidate = " + std::to_string(id->value);
  auto candidate = rows_of(question, "SELECT * FROM v_candidates" + own);
  if (!candidate) return Unexpected(candidate.error());
  if (candidate->cells.empty())
    return unexpected(ErrorKind::NotFound, "the store has no such candidate", question.id);
  const auto ancestors = ancestors_of(question, cell_of(*candidate, 0, "parent"));
  const auto scores =
      rows_of(question,
              "SELECT id, pair, instance, seed, iteration, status, score, source FROM "
              "v_evaluations" +
                  own + " AND purpose = 'race' ORDER BY pair");
  const auto later =
      rows_of(question,
              "SELECT id, purpose, source, pair, instance, seed, status, score FROM "
              "v_evaluations" +
                  own + " AND purpose <> 'race' ORDER BY purpose, source, pair LIMIT 2000");
  const auto design = rows_of(question,
                              "SELECT design, mission, method, repetition, state, "
                              "best_candidate, flavour FROM v_designs WHERE design = " +
                                  cell_of(*candidate, 0, "design"));
  if (auto read = all_read({&ancestors, &scores, &later, &design}); !read)
    return Unexpected(read.error());
  Rows lettered = *design;
  letter_ids(lettered);
  letter_ids(*candidate);
  JsonObject columns;
  add_columns(columns, *scores);
  return json_answer(answer_object()
                         .add("candidate", first_row(*candidate))
                         .add("design", first_row(lettered))
                         .add("ancestors", rows_as_json(*ancestors))
                         .add("scores", columns)
                         .add("later", rows_as_json(*later)));
}

Expected<Answer> evaluation_answer(const Question& question) {
  const auto id = parse_thing_id(question.id);
  if (!id || id->letter != 'e')
    return bad_input("must be an evaluation such as e81200007", question.id);
  const auto history = read_history(question.store, *id);
  if (!history) return Unexpected(history.error());
  if (!history->is_known())
    return unexpected(ErrorKind::NotFound, "the store has no such evaluation", question.id);
  return Answer{.body = history_as_json(question.id, *history).text() + "\n"};
}

Expected<Answer> scores_answer(const Question& question) {
  const auto where = of_design(question);
  if (!where) return Unexpected(where.error());
  return columns_answer(question,
                        "SELECT design, mission, method, repetition, candidate, source, "
                        "purpose, pair, instance, seed, score FROM v_design_scores" +
                            *where + " ORDER BY design, purpose, source, pair");
}

Expected<Answer> leaderboard_answer(const Question& question) {
  return columns_answer(question, "SELECT * FROM v_leaderboard ORDER BY mission, rank, design");
}

Expected<Answer> modules_answer(const Question& question) {
  return columns_answer(question,
                        "SELECT * FROM v_module_frequency ORDER BY mission, method, module");
}

Expected<Answer> real_runs_answer(const Question& question) {
  // Older stores do not have them.
  constexpr std::int64_t kFirstSchema = 5;
  const auto where = of_design(question);
  if (!where) return Unexpected(where.error());
  if (question.store.schema() < kFirstSchema) {
    std::string none;
    for (const std::string_view column : kRealRunColumns)
      none += fmt::format("{}NULL AS {}", none.empty() ? "" : ", ", column);
    return columns_answer(question, "SELECT " + none + " WHERE 0");
  }
  return columns_answer(
      question, fmt::format("SELECT {} FROM (SELECT *, (SELECT s.reasons FROM v_real_scores AS s "
                            "WHERE s.run = v_real_runs.run ORDER BY s.scoring DESC LIMIT 1) AS "
                            "reasons FROM v_real_runs{}) ORDER BY run",
                            fmt::join(kRealRunColumns, ", "), *where));
}

Expected<Answer> views_answer(const Question& question) {
  const auto rows =
      rows_of(question,
              "SELECT v.name AS view, c.name AS column FROM (SELECT name, type FROM "
              "sqlite_temp_master UNION SELECT name, type FROM sqlite_master WHERE NOT EXISTS "
              "(SELECT 1 FROM sqlite_temp_master)) AS v JOIN "
              "pragma_table_info(v.name) AS c WHERE v.type = 'view' AND v.name GLOB 'v_*' "
              "ORDER BY v.name, c.cid");
  if (!rows) return Unexpected(rows.error());
  std::vector<std::pair<std::string, std::vector<std::string>>> views;
  for (const auto& cells : rows->cells) {
    if (views.empty() || views.back().first != cells[0].text) views.push_back({cells[0].text, {}});
    views.back().second.push_back(cells[1].text);
  }
  return json_answer(answer_object().add(
      "views", json_list(views, [](const auto& view) {
        return JsonObject()
            .add("name", view.first)
            .add("text", text_of_view(view.first))
            .add("columns", json_list(view.second, [&](const std::string& column) {
                   return JsonObject()
                       .add("name", column)
                       .add("text", text_of_column(view.first, column));
                 }));
      })));
}

Expected<std::vector<JsonPiece>> stored_workers(StoreReader& store, bool is_written) {
  // Has the fields of a live worker; those known only to a coordinator are null.
  const auto rows = select(
      store,
      fmt::format("SELECT worker AS number, {} AS state, host, job, client, slots, NULL AS held, "
                  "NULL AS running, done, failed, connections, NULL AS done_per_s, NULL AS busy, "
                  "NULL AS last_heard_s, pid, build, first_seen, last_seen FROM v_workers ORDER BY "
                  "worker",
                  is_written ? "state" : "CASE state WHEN 'connected' THEN 'gone' ELSE state END"),
      kRecordLimits);
  if (!rows) return Unexpected(rows.error());
  std::vector<JsonPiece> workers;
  for (std::size_t i = 0; i < rows->cells.size(); ++i)
    workers.push_back({row_as_json(*rows, i).text()});
  return workers;
}

}  // namespace swarmsmith::cli
