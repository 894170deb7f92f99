#include "tests/cluster/simulated_disk.h"

#include <set>
#include <utility>

#include "base/overloaded.h"
#include "coordinator/pool/task_key.h"
#include "storage/answer.h"

namespace swarmsmith::cluster {
namespace {

/// Rows that hold a latest value.
bool is_replaced(const Row& row) {
  return std::holds_alternative<CandidateTotalsRow>(row) ||
         std::holds_alternative<DesignStateRow>(row) ||
         std::holds_alternative<CampaignStateRow>(row) || std::holds_alternative<WorkerRow>(row);
}

}  // namespace

void SimulatedDisk::open(bool closes_beside) {
  is_open_ = true;
  is_locked_ = !(is_unclean_ && closes_beside);
  is_unclean_ = false;
}

void SimulatedDisk::crash() {
  is_open_ = is_locked_ = false;
  is_unclean_ = true;
  if (named_) rows_ = std::move(*named_);
  named_.reset();
}

void SimulatedDisk::visit() {
  const bool is_last = !is_locked_;
  if (is_last && is_open_ && !named_) named_ = rows_;
}

SimulatedDisk::RowKey SimulatedDisk::key_of(const Row& row) {
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  const auto of_evaluation = [](const EvaluationKey& key) {
    return Key{key.candidate.value, static_cast<std::int64_t>(key.purpose), key.pair};
  };
  const Key key = std::visit(
      Overloaded{[](const CandidateRow& r) {
                   return Key{r.id.value, 0, 0};
                 },
                 [](const PairRow& r) {
                   return Key{r.design.value, static_cast<std::int64_t>(r.purpose), r.number};
                 },
                 [&](const EvaluationRow& r) { return of_evaluation(r.key); },
                 [&](const UnusedRow& r) { return of_evaluation(r.key); },
                 [](const IterationRow& r) {
                   return Key{r.design.value, r.number, 0};
                 },
                 [](const RaceStepRow& r) {
                   return Key{r.design.value, r.step, 0};
                 },
                 [](const EliminationRow& r) {  // who was dropped may come back in the last race
                   return Key{r.candidate.value, r.iteration, 0};
                 },
                 [](const EliteRow& r) {
                   return Key{r.design.value, r.iteration, r.rank};
                 },
                 [](const CandidateTotalsRow& r) {
                   return Key{r.candidate.value, 0, 0};
                 },
                 [](const DesignStateRow& r) {
                   return Key{r.design.value, 0, 0};
                 },
                 [](const CampaignStateRow&) { return Key{}; },
                 [](const WorkerRow& r) {
                   return Key{r.id, 0, 0};
                 },
                 [&](const ConflictRow& r) { return of_evaluation(r.key); },
                 [](const FailureRow&) { return Key{}; }, [](const EventRow&) { return Key{}; },
                 [&](const AttemptRow& r) { return of_evaluation(r.key); },
                 [](const CommandRow& r) {
                   return Key{r.number, 0, 0};
                 },
                 [](const ForgivenRow&) { return Key{}; }},
      row);
  return std::tuple_cat(std::tuple(row.index()), key);
}

std::string SimulatedDisk::commit(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    std::string complaint = put(row);
    if (!complaint.empty()) return complaint + ": " + describe(row);
  }
  return {};
}

std::string SimulatedDisk::put(const Row& row) {
  if (std::holds_alternative<EventRow>(row) || std::holds_alternative<FailureRow>(row)) return {};
  if (const auto* forgiven = std::get_if<ForgivenRow>(&row)) {
    for (auto& [key, stored] : rows_) {
      auto* worker = std::get_if<WorkerRow>(&stored);
      const bool is_meant = worker != nullptr && worker->principal == forgiven->principal &&
                            worker->state == WorkerState::Quarantined;
      if (is_meant) worker->state = WorkerState::Left;
    }
    return {};
  }
  if (std::holds_alternative<ConflictRow>(row)) return "two results with other bits";
  if (std::string complaint = missing_reference(row); !complaint.empty()) return complaint;
  if (const auto* unused = std::get_if<UnusedRow>(&row)) {
    const auto at = rows_.find(key_of(EvaluationRow{.key = unused->key}));
    if (at == rows_.end()) return "an evaluation that is not there is unused";
    std::get<EvaluationRow>(at->second).iteration = 0;
    return {};
  }
  const auto [at, fresh] = rows_.emplace(key_of(row), row);
  if (fresh) return {};
  if (is_replaced(row)) {
    at->second = row;
    return {};
  }
  if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
    auto& first = std::get<EvaluationRow>(at->second);
    const bool is_wanted_after_all = first.iteration == 0 && evaluation->iteration != 0;
    if (!is_wanted_after_all) return "two rows of one evaluation";
    first.iteration = evaluation->iteration;
  }
  if (!same_answer(at->second, row)) return "a row is given again, but not the same";
  return {};
}

bool SimulatedDisk::has_candidate(CandidateId id) const {
  return rows_.contains(key_of(CandidateRow{.id = id}));
}

/// A store refuses such rows, and with them all that comes later.
std::string SimulatedDisk::missing_reference(const Row& row) const {
  const CandidateId id =
      std::visit(Overloaded{[](const CandidateRow& r) { return r.parent; },
                            [](const EvaluationRow& r) { return r.key.candidate; },
                            [](const RaceStepRow& r) { return r.best; },
                            [](const EliteRow& r) { return r.candidate; },
                            [](const EliminationRow& r) { return r.candidate; },
                            [](const CandidateTotalsRow& r) { return r.candidate; },
                            [](const DesignStateRow& r) { return r.best; },
                            [](const auto&) { return CandidateId{}; }},
                 row);
  return !id || has_candidate(id) ? "" : "a row of a candidate that is not there";
}

bool SimulatedDisk::holds(PackedKey evaluation) const {
  return rows_.contains(key_of(EvaluationRow{.key = unpack(evaluation)}));
}

template <class Kind>
std::vector<Kind> SimulatedDisk::rows_of() const {
  std::vector<Kind> found;
  const std::size_t index = Row(Kind{}).index();
  for (auto at = rows_.lower_bound({index, INT64_MIN, 0, 0});
       at != rows_.end() && at->second.index() == index; ++at) {
    found.push_back(std::get<Kind>(at->second));
  }
  return found;
}

std::vector<StoredScore> SimulatedDisk::scores() const {
  std::vector<StoredScore> scores;
  for (const EvaluationRow& row : rows_of<EvaluationRow>())
    scores.push_back({.key = row.key,
                      .status = row.status,
                      .measured = row.measured,
                      .iteration = row.iteration,
                      .worker = row.worker});
  return scores;
}

std::vector<StoredStep> SimulatedDisk::steps() const {
  std::vector<StoredStep> steps;
  for (const RaceStepRow& row : rows_of<RaceStepRow>())
    steps.push_back({row.design, row.step, row.digest});
  return steps;
}

std::vector<DesignStateRow> SimulatedDisk::design_states() const {
  return rows_of<DesignStateRow>();
}

std::vector<CommandRow> SimulatedDisk::commands() const {
  return rows_of<CommandRow>();
}

std::int64_t SimulatedDisk::next_worker() const {
  const std::vector<WorkerRow> workers = rows_of<WorkerRow>();
  return workers.empty() ? 1 : workers.back().id + 1;
}

bool SimulatedDisk::finished() const {
  const std::vector<CampaignStateRow> states = rows_of<CampaignStateRow>();
  return !states.empty() && states.back().state == "finished";
}

StoredTrust SimulatedDisk::trust() const {
  StoredTrust trust;
  for (const WorkerRow& row : rows_of<WorkerRow>()) {
    if (row.principal.empty()) continue;
    trust.principals.emplace(row.id, row.principal);
    if (auto quarantine = quarantine_of(row)) trust.quarantined.push_back(std::move(*quarantine));
  }
  for (const AttemptRow& row : rows_of<AttemptRow>()) {
    if (row.outcome == AttemptOutcome::Audited) trust.audited.insert(row.key);
  }
  const std::vector<CampaignStateRow> states = rows_of<CampaignStateRow>();
  trust.distrusted = !states.empty() && states.back().state == "distrusted";
  return trust;
}

std::vector<std::string> SimulatedDisk::answer() const {
  std::vector<std::string> lines;
  // A race's pair counts once a step was held on it: before, it was only looked ahead at.
  std::set<std::pair<DesignId, std::int64_t>> stepped;
  for (const RaceStepRow& step : rows_of<RaceStepRow>())
    stepped.emplace(step.design, step.pair);
  for (const auto& [key, row] : rows_) {
    const auto* pair = std::get_if<PairRow>(&row);
    const bool is_ahead = pair != nullptr && pair->purpose == Purpose::Race &&
                          !stepped.contains({pair->design, pair->number});
    if (in_answer(row) && !is_ahead) lines.push_back(describe(row));
  }
  return lines;
}

}  // namespace swarmsmith::cluster
