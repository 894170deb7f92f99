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

/// Where tasks come from and outcomes go: a campaign. Pure: no clock, no sockets, no store; what
/// must be written comes out as rows. An abstract class because the cluster's tests put a small
/// campaign of their own behind it; as it stands, a source has no look-ahead and no commands.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  /// Tasks that became wanted since the last call, the most urgent first. Each is returned once;
  /// one that `take_more` gave before, and that has no outcome yet, comes once more when it is
  /// wanted.
  virtual std::vector<Task> take_tasks() = 0;

  /// At most about `count` further tasks for slots that would idle, of `slots` in all: designs that
  /// are not begun yet are begun, and then evaluations are asked for that will probably be wanted
  /// (Task::ahead). Their outcomes change nothing of the answer.
  virtual std::vector<Task> take_more(std::size_t /*count*/, std::size_t /*slots*/) { return {}; }

  /// Tasks of `take_more` that are no longer needed: they need not be run.
  virtual std::vector<EvaluationKey> take_dropped() { return {}; }

  /// Designs that have ended for good since the last call; no command can restart them. Their
  /// second results need not be recognised. Outcomes of tasks that were given may still come.
  virtual std::vector<DesignId> take_ended() { return {}; }

  /// Candidates whose results no design has waited for since the last call: their second results
  /// need not be recognised. Their tasks may still be given, and their outcomes come.
  virtual std::vector<PassedCandidates> take_passed() { return {}; }

  /// Carries out "cancel" or "extend"; its row comes by `take_rows`, with the step at which it
  /// acts. Errors: no such design, or one that cannot do it, with what it can do.
  virtual Expected<void> carry_out(const CommandRow& command) {
    return bad_input("this campaign knows no such command", std::string(word_of(command.kind)));
  }

  /// The task of an evaluation that was asked for, to be made again; nothing when it cannot be told
  /// any more.
  virtual std::optional<Task> task_of(const EvaluationKey& /*key*/) const { return std::nullopt; }

  /// The first outcome of a task that was taken; called once for each task.
  virtual void tell(const Outcome& outcome) = 0;

  /// Rows that became due since the last call, in the order in which they must be stored: an
  /// outcome's own row comes before whatever was decided from it.
  virtual std::vector<Row> take_rows() = 0;

  /// No task is wanted any more, now or later.
  virtual bool finished() const = 0;

  /// Why nothing more will come of it, if so: what it was made from disagrees with itself.
  virtual std::optional<Error> error() const { return std::nullopt; }

  /// The designs that are not over, in order: those that can be paused.
  virtual std::vector<DesignId> unfinished() const { return {}; }
};

}  // namespace swarmsmith
