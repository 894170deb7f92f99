#include "storage/renumber.h"

namespace swarmsmith {
namespace {

class Mover {
 public:
  explicit Mover(const Shift& shift) : shift_(shift) {}

  void operator()(CandidateRow& row) const { move(row.id), move(row.parent); }
  void operator()(PairRow& row) const { move(row.design); }
  void operator()(EvaluationRow& row) const { move(row.key), move_worker(row.worker); }
  void operator()(UnusedRow& row) const { move(row.key); }
  void operator()(IterationRow& row) const { move(row.design); }
  void operator()(RaceStepRow& row) const { move(row.design), move(row.best); }
  void operator()(EliminationRow& row) const { move(row.candidate); }
  void operator()(EliteRow& row) const { move(row.design), move(row.candidate); }
  void operator()(CandidateTotalsRow& row) const { move(row.candidate); }
  void operator()(DesignStateRow& row) const { move(row.design), move(row.best); }
  void operator()(CampaignStateRow&) const {}
  void operator()(WorkerRow& row) const { move_worker(row.id); }
  void operator()(ConflictRow& row) const { move(row.key), move_worker(row.other_worker); }
  void operator()(FailureRow& row) const { move(row.key), move_worker(row.worker); }
  void operator()(EventRow&) const {}
  void operator()(AttemptRow& row) const { move(row.key), move_worker(row.worker); }
  void operator()(CommandRow& row) const {
    move(row.design);
    row.number += shift_.commands;
  }
  void operator()(ForgivenRow&) const {}

  void move(EvaluationKey& key) const { move(key.candidate); }

 private:
  void move(DesignId& id) const {
    if (id) id.value += shift_.designs;
  }
  void move(CandidateId& id) const {
    if (id) id.value += shift_.designs * kCandidatesPerDesign;
  }
  void move_worker(std::int64_t& worker) const {
    if (worker != 0) worker += shift_.workers;
  }

  const Shift& shift_;
};

}  // namespace

Row shifted(Row row, const Shift& shift) {
  std::visit(Mover(shift), row);
  return row;
}

EvaluationKey shifted(EvaluationKey key, const Shift& shift) {
  Mover(shift).move(key);
  return key;
}

}  // namespace swarmsmith
