#include "cli/output/evaluation_history.h"

#include <optional>
#include <utility>

#include "storage/stored_enums.h"

namespace swarmsmith::cli {

bool EvaluationHistory::is_race() const {
  const SearchOptions* search = stages.search(design);
  return search == nullptr || words_of(*search).has_tests;
}

std::string cell_text(const Rows& rows, const std::string& column) {
  for (std::size_t i = 0; i < rows.columns.size() && !rows.cells.empty(); ++i) {
    if (rows.columns[i] == column) return rows.cells.front()[i].text;
  }
  return {};
}

namespace {

/// " AND m.iteration IN (...) AND m.step IN (...)": the steps in which the design raced on the
/// pair. They are listed one by one so that v_race_matrix computes only these steps, not all races
/// of the design.
Expected<std::string> steps_of_pair(StoreReader& store, const std::string& design,
                                    const std::string& pair) {
  const auto steps =
      select(store, "SELECT iteration, step FROM v_race_steps WHERE design = " + design +
                        " AND pair = " + pair);
  if (!steps) return Unexpected(steps.error());
  std::string lists[2];
  for (const auto& cells : steps->cells) {
    for (std::size_t i = 0; i < 2; ++i)
      lists[i] += (lists[i].empty() ? "" : ",") + cells[i].text;
  }
  return " AND m.iteration IN (" + lists[0] + ") AND m.step IN (" + lists[1] + ")";
}

}  // namespace

Expected<EvaluationHistory> read_history(StoreReader& store, const ThingId& id) {
  const std::string candidate = id.digits + " / 100000";
  const std::string pair = id.digits + " % 100000";
  const std::string is_it = is_evaluation(id);
  const std::string design = std::to_string(design_of_thing(id).value);
  const auto of_pair = steps_of_pair(store, design, pair);
  if (!of_pair) return Unexpected(of_pair.error());
  EvaluationHistory history;
  const std::pair<std::string, Rows*> parts[] = {
      {"SELECT candidate, design, iteration, parent, fsm_config, parameters, eliminated_in, "
       "eliminated_at, eliminated_by FROM v_candidates WHERE candidate = " +
           candidate,
       &history.candidate},
      {"SELECT * FROM v_evaluations WHERE " + is_it, &history.evaluation},
      {"SELECT m.iteration, m.step, m.rank, s.marker, s.alive_before, s.alive_after FROM "
       "v_race_matrix AS m JOIN v_race_steps AS s ON s.design = m.design AND s.step = m.step "
       "WHERE m.design = " +
           design + " AND m.candidate = " + candidate + *of_pair +
           (id.purpose.empty() ? "" : " AND 0") + " ORDER BY m.step",
       &history.steps},
      {"SELECT at, attempt, worker, host, held_ms, outcome FROM v_attempts WHERE " + is_it +
           " ORDER BY at, attempt",
       &history.attempts},
      {"SELECT at, attempt, worker, host, reason, command, output, errors FROM v_failures WHERE " +
           is_it + " AND at IS NOT NULL ORDER BY at",
       &history.failures},
      {"SELECT time AS at, kept_score, other_score, other_worker FROM conflict WHERE candidate = " +
           candidate + " AND pair = " + pair + " AND purpose = " +
           std::to_string(static_cast<int>(purpose_of_letter(id.purpose).value_or(Purpose::Race))) +
           " ORDER BY time",
       &history.conflicts},
      {"SELECT w.worker, w.host, w.pid, w.job, w.client, w.build, w.state FROM v_workers AS w "
       "WHERE "
       "w.worker = (SELECT worker FROM v_evaluations WHERE " +
           is_it + ")",
       &history.worker}};
  for (const auto& [sql, rows] : parts) {
    auto found = select(store, sql);
    if (!found) return Unexpected(found.error());
    *rows = std::move(*found);
  }
  auto stages = StoredStages::read(store);
  if (!stages) return Unexpected(stages.error());
  history.stages = std::move(*stages);
  history.design = to_string(design_of_thing(id));
  letter_ids(history.candidate);
  letter_ids(history.evaluation);
  return history;
}

std::string why(const EvaluationHistory& history) {
  const std::string purpose = cell_text(history.evaluation, "purpose");
  if (purpose == "test")
    return history.is_race() ? "a test of its candidate after the race, outside of the budget"
                             : "a test of its candidate after the search, outside of the budget";
  const auto known = purpose_of_word(purpose);
  if (known && !facts_of(*known)->why.empty()) return std::string(facts_of(*known)->why);
  const std::string iteration = cell_text(history.evaluation, "iteration");
  if (iteration.empty()) return "look-ahead: no race has asked for it";
  const std::string step = cell_text(history.steps, "step");
  const std::string part = history.stages.round(history.design, iteration);
  return (history.is_race() ? "the race of " + ("iteration " + iteration) : part) +
         (step.empty() ? "" : ", first in step " + step);
}

JsonObject history_as_json(const std::string& id, const EvaluationHistory& history) {
  const auto one = [](const Rows& rows) {
    return rows.cells.empty() ? std::nullopt : std::optional(row_as_json(rows, 0));
  };
  const bool has_outcome = !history.evaluation.cells.empty();
  return std::move(JsonObject()
                       .add("v", 1)
                       .add("id", id)
                       .add("candidate", one(history.candidate))
                       .add("evaluation", one(history.evaluation))
                       .add("asked_for", has_outcome ? std::optional(why(history)) : std::nullopt)
                       .add("worker", one(history.worker))
                       .add("steps", rows_as_json(history.steps))
                       .add("attempts", rows_as_json(history.attempts))
                       .add("failures", rows_as_json(history.failures))
                       .add("conflicts", rows_as_json(history.conflicts)));
}

}  // namespace swarmsmith::cli
