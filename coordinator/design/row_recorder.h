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

/// The row of an outcome; iteration 0 if no race has used it.
EvaluationRow evaluation_row(const Outcome& outcome, std::int64_t iteration, double bound,
                             const std::string& source);

/// Makes the rows of one design, in the order of its events. A design that is replayed first goes
/// through its stored steps: they are compared with the stored digests, and rows are produced only
/// after the last stored step.
class RowRecorder {
 public:
  RowRecorder(DesignId design, std::string source, std::vector<std::uint64_t> step_digests);

  /// The design's current state, which later events change.
  const DesignStateRow& design() const { return design_; }
  void set_state(DesignState state) { design_.state = state; }
  /// Cut at the length that a store may hold.
  void set_reason(const std::string& reason) { design_.reason = reason.substr(0, kLongestReason); }
  void set_best(std::int64_t number) { design_.best = candidate(number); }

  void record_state();
  void record_candidate(const ConfigurationSampled& sampled, CandidateText text);
  void record_iteration(const IterationStarted& started);
  /// Error: the store has a different step with this number.
  Expected<void> record_step(const RaceStep& step);
  void record_end(const IterationEnded& ended);
  void record_estimate(const TimeEstimated& estimated);
  void record_warning(std::string_view text);
  /// A command takes effect.
  void record_command(CommandRow command);

  /// At most one row for each pair of a purpose; new pairs come in the order of their numbers.
  void record_pair(Purpose purpose, const Experiment& experiment);
  /// The race has asked for a stored score; if no iteration has used it so far, this row makes it
  /// part of the race.
  void record_use(const StoredScore& score);
  void record_unused(const EvaluationKey& key);
  /// The race used a run.
  void record_run(std::int64_t number, double score);
  /// A targetEvaluator gave a score for a run, see CandidateTotals.
  void record_judged(std::int64_t number, std::int64_t pair, double score);

  /// The number of steps of the race so far.
  std::int64_t steps() const { return static_cast<std::int64_t>(steps_); }
  /// Whether the store has steps that the replay has not reached yet.
  bool is_replaying() const { return steps_ < step_digests_.size(); }
  /// The error that the next step differs from the stored one.
  Error other_step() const;
  /// The iteration to which events belong now; the first estimate of max_time, which precedes the
  /// first iteration, counts as part of it.
  std::int64_t counted_iteration() const;
  /// The largest number of a candidate that was created.
  std::int64_t n_candidates() const { return totals_.count(); }
  /// No candidate for 0.
  CandidateId candidate(std::int64_t number) const;

  /// Appends the rows that are due to `rows`.
  void move_rows_to(std::vector<Row>& rows);

 private:
  void record(Row row);

  DesignStateRow design_;
  std::string source_;
  std::vector<std::uint64_t> step_digests_;  ///< stored digests; that of step n at index n - 1
  std::size_t steps_ = 0;
  CandidateTotals totals_;
  std::set<std::int64_t> alive_;           ///< candidates alive in this iteration
  std::map<Purpose, std::int64_t> pairs_;  ///< the last pair of each purpose that has a row
  std::vector<Row> rows_;
};

}  // namespace swarmsmith
