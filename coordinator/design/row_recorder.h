#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/candidate_text.h"
#include "coordinator/design/candidate_totals.h"
#include "coordinator/design/task.h"
#include "irace_core/experiment.h"
#include "irace_core/race_event.h"
#include "storage/rows.h"

namespace swarmsmith {

/// The row of an outcome; iteration 0 when no race used it.
EvaluationRow evaluation_row(const Outcome& outcome, std::int64_t iteration, double bound,
                             const std::string& source);

/// Makes rows of what becomes of one design, in the order in which it happens. A design that is
/// played again comes first to what the store has: rows are given from the last stored step on, and
/// until then the steps are compared with the stored ones.
class RowRecorder {
 public:
  RowRecorder(DesignId design, std::string source, std::vector<std::uint64_t> step_digests);

  /// The design as it stands; what follows changes it.
  const DesignStateRow& design() const { return design_; }
  void set_state(DesignState state) { design_.state = state; }
  void set_reason(std::string reason) { design_.reason = std::move(reason); }
  void set_best(std::int64_t number) { design_.best = candidate(number); }

  void record_state();
  void record_candidate(const ConfigurationSampled& sampled, CandidateText text);
  void record_iteration(const IterationStarted& started);
  /// Error: the store has another step in its place.
  Expected<void> record_step(const RaceStep& step);
  void record_end(const IterationEnded& ended);
  void record_estimate(const TimeEstimated& estimated);
  void record_warning(std::string_view text);
  /// A command that acts.
  void record_command(CommandRow command);

  /// Once for each pair of a purpose; they come in the order of their numbers.
  void record_pair(Purpose purpose, const Experiment& experiment);
  /// The race has asked for what is in the store; when no iteration has used it so far, it takes it
  /// from this row.
  void record_use(const StoredScore& score);
  void record_unused(const EvaluationKey& key);
  /// A run that the race used.
  void record_run(std::int64_t number, double score);
  /// What a targetEvaluator said of a run, see CandidateTotals.
  void record_judged(std::int64_t number, std::int64_t pair, double score);

  /// Of the race, so far.
  std::int64_t steps() const { return static_cast<std::int64_t>(steps_); }
  /// The store has steps that are still to come.
  bool is_replaying() const { return steps_ < step_digests_.size(); }
  /// The next step would not be the one that the store has.
  Error other_step() const;
  /// What takes place before the first iteration counts to it: the first estimate of max_time.
  std::int64_t counted_iteration() const;
  /// All that were made have the numbers up to this one.
  std::int64_t n_candidates() const { return totals_.count(); }
  /// None for 0.
  CandidateId candidate(std::int64_t number) const;

  /// Appends the rows that became due to `rows`.
  void move_rows_to(std::vector<Row>& rows);

 private:
  void record(Row row);

  DesignStateRow design_;
  std::string source_;
  std::vector<std::uint64_t> step_digests_;  ///< in the store; of step n at index n - 1
  std::size_t steps_ = 0;
  CandidateTotals totals_;
  std::set<std::int64_t> alive_;           ///< numbers, in the current iteration
  std::map<Purpose, std::int64_t> pairs_;  ///< number of the last one that has a row
  std::vector<Row> rows_;
};

}  // namespace swarmsmith
