#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/plans.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What speaks against a command to a design, whatever its state: only races can be cancelled and
/// extended, by experiments where the budget is in experiments, and nothing follows a cancel among
/// the `earlier` ones.
Expected<void> check_command(const DesignPlan& plan, std::span<const CommandRow> earlier,
                             const CommandRow& command);

/// The commands to one design: those that have acted, in that order, then those that wait. One with
/// a step has acted in the store, and acts again after that very step when the design is replayed;
/// nothing acts before it.
class CommandLog {
 public:
  explicit CommandLog(std::vector<CommandRow> commands);

  /// One that waits from now on.
  void add(const CommandRow& command);
  /// The next of this kind that acts after `steps` steps, if it can act now; null if there is none.
  const CommandRow* next(CommandKind kind, std::int64_t steps) const;
  /// One that `next` gave acts after `steps` steps; its row.
  CommandRow act(CommandRow command, std::int64_t steps);

  std::span<const CommandRow> all() const { return commands_; }

 private:
  std::vector<CommandRow> commands_;
  std::size_t acted_ = 0;  ///< of them, the first ones
};

}  // namespace swarmsmith
