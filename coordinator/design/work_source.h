#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/task.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Candidates of a design that are out of its race: those before `before` that are not `kept`.
struct PassedCandidates {
  DesignId design;
  CandidateId before;
  std::vector<CandidateId> kept{};
};

/// The source of tasks and the receiver of outcomes: a campaign. Pure: no clock, no sockets, no
/// store; data that must be stored is returned as rows. The class is abstract because the cluster's
/// tests implement a small campaign; by default, a source has no look-ahead and no commands.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  /// Tasks that became wanted since the last call, the most urgent first. Each task is returned
  /// once; a task that `take_more` returned earlier and that has no outcome yet is returned again
  /// when it is wanted.
  virtual std::vector<Task> take_tasks() = 0;

  /// At most about `count` further tasks for idle slots, out of `slots` slots in total: the source
  /// first begins further designs, and then adds evaluations that will probably be wanted
  /// (Task::ahead). Their outcomes do not change the answer.
  virtual std::vector<Task> take_more(std::size_t /*count*/, std::size_t /*slots*/) { return {}; }

  /// Tasks of `take_more` that are no longer needed and need not be run.
  virtual std::vector<EvaluationKey> take_dropped() { return {}; }

  /// Designs that have ended for good since the last call; no command can restart them, and their
  /// duplicate results need not be recognised. Outcomes of earlier tasks may still come.
  virtual std::vector<DesignId> take_ended() { return {}; }

  /// Candidates for whose results no design waits any more, since the last call: their duplicate
  /// results need not be recognised. Further tasks and outcomes of them may come.
  virtual std::vector<PassedCandidates> take_passed() { return {}; }

  /// Carries out "cancel" or "extend"; its row comes through `take_rows`, with the step after which
  /// it takes effect. Errors: there is no such design, or the command is not possible for it; the
  /// message says which commands are possible.
  virtual Expected<void> carry_out(const CommandRow& command) {
    return bad_input("this campaign knows no such command", std::string(word_of(command.kind)));
  }

  /// The task of an evaluation that was asked for earlier, to evaluate it again; none if the task
  /// is no longer known.
  virtual std::optional<Task> task_of(const EvaluationKey& /*key*/) const { return std::nullopt; }

  /// The first outcome of a task that was handed out; called once for each task.
  virtual void tell(const Outcome& outcome) = 0;

  /// Rows that are due since the last call, in the order in which they must be stored: the row of
  /// an outcome comes before all decisions that follow from it.
  virtual std::vector<Row> take_rows() = 0;

  /// Whether no task will be wanted any more, now or later.
  virtual bool finished() const = 0;

  /// The reason why the source cannot continue, if it cannot: its inputs contradict each other.
  virtual std::optional<Error> error() const { return std::nullopt; }

  /// The designs that are not over, in order; these can be paused.
  virtual std::vector<DesignId> unfinished() const { return {}; }
};

}  // namespace swarmsmith
