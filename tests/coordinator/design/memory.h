#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "storage/answer.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Keeps the rows as a store would: the first evaluation counts, absolute values are replaced.
struct Memory {
  std::vector<Row> rows;

  std::vector<StoredScore> scores() const {
    std::vector<StoredScore> found;
    for (const auto& [key, e] : evaluations())
      found.push_back({key, e.status, e.measured, e.bound, e.iteration});
    return found;
  }
  template <class Kind>
  std::vector<Kind> only() const {
    std::vector<Kind> found;
    for (const Row& row : rows) {
      if (const auto* one = std::get_if<Kind>(&row)) found.push_back(*one);
    }
    return found;
  }
  std::vector<StoredStep> steps() const {
    std::vector<StoredStep> found;
    for (const Row& row : rows) {
      if (const auto* s = std::get_if<RaceStepRow>(&row)) {
        found.push_back({s->design, s->step, s->digest});
      }
    }
    std::ranges::stable_sort(found, {}, &StoredStep::design);
    return found;
  }
  /// What `verify` and `digest` look at, as texts in an order of their own.
  std::vector<std::string> answer() const {
    std::vector<std::string> texts;
    std::map<CandidateId, std::string> totals;
    std::map<DesignId, std::string> states;
    std::map<std::int64_t, std::string> commands;
    for (const Row& row : rows) {
      if (!in_answer(row)) continue;
      if (const auto* state = std::get_if<DesignStateRow>(&row)) {
        states[state->design] = describe(row);
      } else if (const auto* sums = std::get_if<CandidateTotalsRow>(&row)) {
        totals[sums->candidate] = describe(row);
      } else if (const auto* command = std::get_if<CommandRow>(&row)) {
        commands[command->number] = describe(row);
      } else if (!is_evaluation_or_race_pair(row)) {
        texts.push_back(describe(row));
      }
    }
    for (const auto& [id, text] : totals)
      texts.push_back(text);
    for (const auto& [id, text] : states)
      texts.push_back(text);
    for (const auto& [number, text] : commands)
      texts.push_back(text);
    for (const auto& [key, evaluation] : evaluations()) {
      if (in_answer(evaluation)) texts.push_back(describe(evaluation));
    }
    add_stepped_pairs(texts);
    std::ranges::sort(texts);
    texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
    return texts;
  }
  /// As they stand after all rows: the first outcome, and the iteration that used it last.
  std::map<EvaluationKey, EvaluationRow> evaluations() const {
    std::map<EvaluationKey, EvaluationRow> all;
    for (const Row& row : rows) {
      if (const auto* e = std::get_if<EvaluationRow>(&row)) {
        const auto [at, fresh] = all.emplace(e->key, *e);
        if (!fresh && at->second.iteration == 0) at->second.iteration = e->iteration;
      }
      if (const auto* u = std::get_if<UnusedRow>(&row)) {
        if (const auto at = all.find(u->key); at != all.end()) at->second.iteration = 0;
      }
    }
    return all;
  }
  std::vector<CommandRow> commands() const {
    std::map<std::int64_t, CommandRow> all;
    for (const CommandRow& row : only<CommandRow>())
      all[row.number] = row;
    std::vector<CommandRow> found;
    for (const auto& [number, row] : all)
      found.push_back(row);
    return found;
  }

 private:
  static bool is_evaluation_or_race_pair(const Row& row) {
    const auto* pair = std::get_if<PairRow>(&row);
    return std::holds_alternative<EvaluationRow>(row) ||
           (pair != nullptr && pair->purpose == Purpose::Race);
  }
  /// A race's pair counts once a step was held on it.
  void add_stepped_pairs(std::vector<std::string>& texts) const {
    std::set<std::pair<DesignId, std::int64_t>> stepped;
    for (const RaceStepRow& step : only<RaceStepRow>())
      stepped.emplace(step.design, step.pair);
    for (const PairRow& pair : only<PairRow>()) {
      if (pair.purpose == Purpose::Race && stepped.contains({pair.design, pair.number}))
        texts.push_back(describe(pair));
    }
  }
};

}  // namespace swarmsmith
