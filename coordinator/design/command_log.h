#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/plans.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Returns an error for a command that is not possible for a design in any state: only races can be
/// cancelled and extended, some searches cannot be extended, only a budget in experiments can be
/// extended, and no command may follow a cancel among the `earlier` ones.
Expected<void> check_command(const DesignPlan& plan, std::span<const CommandRow> earlier,
                             const CommandRow& command);

/// The commands for one design: first those that have taken effect, in this order, then those that
/// wait. A command with a step took effect earlier, according to the store, and takes effect again
/// after exactly this step in a replay; no command can take effect before it.
class CommandLog {
 public:
  explicit CommandLog(std::vector<CommandRow> commands);

  /// Adds a command that waits from now on.
  void add(const CommandRow& command);
  /// The next command of this kind that can take effect after `steps` steps, or null.
  const CommandRow* next(CommandKind kind, std::int64_t steps) const;
  /// A command returned by `next` takes effect after `steps` steps; returns its row.
  CommandRow act(CommandRow command, std::int64_t steps);

  std::span<const CommandRow> all() const { return commands_; }

 private:
  std::vector<CommandRow> commands_;
  std::size_t acted_ = 0;  ///< how many of them, from the front, have taken effect
};

}  // namespace swarmsmith
