#include "coordinator/design/command_log.h"

#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "coordinator/campaign/campaign.h"

namespace swarmsmith {

Expected<void> check_command(const DesignPlan& plan, std::span<const CommandRow> earlier,
                             const CommandRow& command) {
  const std::string name = to_string(plan.row.id);
  if (!is_of_race(command.kind)) {
    return bad_input("a design can be cancelled and extended, nothing else",
                     std::string(word_of(command.kind)));
  }
  if (plan.only_test)
    return bad_input("the design has no race: its configurations are only tested", name);
  // After a cancel no command is possible (docs/irace.md, "More budget, and an early end").
  for (const CommandRow& before : earlier) {
    if (before.kind == CommandKind::Cancel) return bad_input("it was cancelled before", name);
  }
  if (command.kind == CommandKind::Cancel) return {};
  if (const std::string_view why = words_of(plan.search).no_extension; !why.empty())
    return bad_input(std::string(why), name);
  if (plan.scenario.max_time > 0) {
    return bad_input("its budget is time (max_time), but an extension is a number of experiments",
                     name);
  }
  if (command.budget < 1 || command.budget > kLargestBudget) {
    return bad_input(fmt::format("an extension must be 1 to {} experiments, not {}", kLargestBudget,
                                 command.budget),
                     name);
  }
  return {};
}

CommandLog::CommandLog(std::vector<CommandRow> commands) : commands_(std::move(commands)) {
  // First those with a step, in the order in which they took effect, so that a replay meets them in
  // this order; then those that wait, in the order in which they were given.
  const auto place = [](const CommandRow& command) {
    return std::tuple(!command.step.has_value(), command.step.value_or(0), command.number);
  };
  std::ranges::sort(commands_, {}, place);
}

void CommandLog::add(const CommandRow& command) {
  commands_.push_back(command);
  // Only this log decides when a command takes effect.
  commands_.back().step.reset();
}

const CommandRow* CommandLog::next(CommandKind kind, std::int64_t steps) const {
  SWARMSMITH_ASSERT(acted_ <= commands_.size(), "no more commands have acted than were given");
  const auto next = commands_.begin() + static_cast<std::ptrdiff_t>(acted_);
  if (next == commands_.end()) return nullptr;
  // A replay: neither this command nor a later one may take effect before its recorded step.
  if (next->step) return next->kind == kind && *next->step == steps ? &*next : nullptr;
  // A cancel does not wait for an extension that was requested before it.
  const auto found = std::find_if(next, commands_.end(),
                                  [&](const CommandRow& command) { return command.kind == kind; });
  return found == commands_.end() ? nullptr : &*found;
}

CommandRow CommandLog::act(CommandRow command, std::int64_t steps) {
  SWARMSMITH_ASSERT(command.step.value_or(steps) == steps,
                    "a command acts again after the same step as before");
  const auto removed = std::erase_if(
      commands_, [&](const CommandRow& other) { return other.number == command.number; });
  SWARMSMITH_ASSERT(removed == 1, "a command acts once");
  command.step = steps;
  // Behind those that took effect earlier: in this order a replay repeats them.
  commands_.insert(commands_.begin() + static_cast<std::ptrdiff_t>(acted_), command);
  ++acted_;
  return command;
}

}  // namespace swarmsmith
