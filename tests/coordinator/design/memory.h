#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "storage/answer.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Keeps the rows as a store would: the first evaluation counts, absolute values are replaced.
struct Memory {
  std::vector<Row> rows;

  std::vector<StoredScore> scores() const {
    std::vector<StoredScore> found;
    for (const Row& row : rows) {
      if (const auto* e = std::get_if<EvaluationRow>(&row)) {
        found.push_back({e->key, e->status, e->score, e->state_digest, e->time, e->bound});
      }
    }
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
    for (const Row& row : rows) {
      if (!in_answer(row)) continue;
      if (const auto* state = std::get_if<DesignStateRow>(&row)) {
        states[state->design] = describe(row);
      } else if (const auto* sums = std::get_if<CandidateTotalsRow>(&row)) {
        totals[sums->candidate] = describe(row);
      } else {
        texts.push_back(describe(row));
      }
    }
    for (const auto& [id, text] : totals)
      texts.push_back(text);
    for (const auto& [id, text] : states)
      texts.push_back(text);
    std::ranges::sort(texts);
    const auto [first, last] = std::ranges::unique(texts);
    texts.erase(first, last);
    return texts;
  }
};

}  // namespace swarmsmith
