#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <tuple>

#include "base/text/toml_text.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/design/design_runner.h"

namespace swarmsmith {
Expected<void> check_command(const DesignPlan& plan, const CommandRow& command) {
  const std::string name = to_string(plan.row.id);
  if (command.kind != "cancel" && command.kind != "extend") {
    return bad_input("a design can be cancelled and extended, nothing else", command.kind);
  }
  if (plan.only_test) return bad_input("it has no race: given configurations are tested", name);
  for (const CommandRow& earlier : plan.commands) {
    if (earlier.kind == "cancel") return bad_input("it was cancelled before", name);
  }
  if (command.kind == "cancel") return {};
  if (plan.scenario.max_time > 0) {
    return bad_input("its budget is time (max_time), and an extension is in experiments", name);
  }
  if (command.budget < 1 || command.budget > kLargestBudget) {
    return bad_input(fmt::format("an extension is 1 to {} experiments, and not {}", kLargestBudget,
                                 command.budget),
                     name);
  }
  return {};
}

Expected<void> DesignRunner::command(const CommandRow& command, std::vector<Row>& rows) {
  if (auto checked = check_command(plan_, command); !checked) return checked;
  const std::string name = to_string(id());
  if (state_ == DesignState::Stopped) return bad_input("it is stopped: " + reason_, name);
  if (command.kind == "cancel") {
    if (state_ == DesignState::Finished) return bad_input("it is finished", name);
    if (state_ == DesignState::Testing) {
      return bad_input("its race is over; only the tests of its elites are left", name);
    }
  } else if (state_ == DesignState::Finished) {
    const auto least = race_->least_extension();
    if (!least) return Unexpected(least.error());
    if (command.budget < *least) {
      return bad_input(fmt::format("{} experiments more give no further iteration; the least that "
                                   "do are {}",
                                   command.budget, *least),
                       name);
    }
  }
  plan_.commands.push_back(command);
  plan_.commands.back().step.reset();
  rows.emplace_back(plan_.commands.back());
  return {};
}

void DesignRunner::sort_commands() {
  const auto place = [](const CommandRow& command) {
    return std::tuple(!command.step.has_value(), command.step.value_or(0), command.number);
  };
  std::ranges::sort(plan_.commands, {}, place);
}

const CommandRow* DesignRunner::next_command(const char* kind) const {
  const auto next = plan_.commands.begin() + static_cast<std::ptrdiff_t>(next_command_);
  if (next == plan_.commands.end()) return nullptr;
  // One that has acted once acts again there, and nothing before it.
  if (next->step) {
    const bool acts = next->kind == kind && *next->step == static_cast<std::int64_t>(steps_);
    return acts ? &*next : nullptr;
  }
  const auto found = std::find_if(next, plan_.commands.end(),
                                  [&](const CommandRow& command) { return command.kind == kind; });
  return found == plan_.commands.end() ? nullptr : &*found;
}

/// Not in the first estimate of max_time, which has no steps to be named. A new one waits until
/// what is stored has been played again, and until the calls of a targetEvaluator have given the
/// step that they are for: those that were made count.
bool DesignRunner::is_cancelled() const {
  const CommandRow* command = next_command("cancel");
  if (command == nullptr || iteration_ == 0) return false;
  return command->step || (!awaited_.empty() && steps_ >= stored_.step_digests.size() &&
                           !batch_.front().is_evaluation);
}

/// What came of the runs after the last step depends on who was how quick: it counts nowhere.
void DesignRunner::cancel(std::vector<Task>& tasks, std::vector<Row>& rows) {
  std::set<EvaluationKey> unused;
  for (std::size_t i = consumed_; i < given_.size(); ++i)
    unused.insert(given_[i].score.key);
  for (const StoredScore& score : scores_) {
    if (score.key.candidate) unused.insert(score.key);
  }
  for (const auto& [packed, score] : stored_.race_scores)
    unused.insert(score.key);
  stored_.race_scores.clear();
  for (const EvaluationKey& key : unused) {
    if (key.purpose == Purpose::Race) record(UnusedRow{key}, rows);
  }
  // Tasks that nobody has taken yet go at once, the others are let go.
  std::erase_if(tasks, [&](const Task& task) {
    if (design_of(task.key.candidate) != id()) return false;
    return awaited_.erase(packed_key(task.key)) + ahead_.erase(packed_key(task.key)) > 0;
  });
  for (const auto& [packed, position] : awaited_) {
    const Experiment& experiment = batch_[position];
    const EvaluationKey key{candidate(experiment.configuration), Purpose::Race, experiment.pair};
    ahead_.emplace(packed, Ahead{key, experiment.bound, false});
  }
  awaited_.clear();
  for (auto& [packed, task] : ahead_) {
    if (!std::exchange(task.dropped, true)) dropped_.push_back(task.key);
  }
  record_acted(*next_command("cancel"), rows);
  state_ = DesignState::Stopped;
  reason_ = "cancelled";
  record_state(rows);
}

Expected<bool> DesignRunner::extend(std::vector<Task>& tasks, std::vector<Row>& rows) {
  const CommandRow* next = next_command("extend");
  if (next == nullptr) return false;
  const CommandRow command = *next;
  if (!race_) {
    warn("there is no race to extend", rows);
    return false;
  }
  if (auto extended = race_->extend(command.budget); !extended) {
    warn("it cannot be extended: " + to_string(extended.error()), rows);
    return false;
  }
  record_acted(command, rows);
  state_ = DesignState::Racing;
  reason_.clear();
  if (std::exchange(test_calls_wanted_, false)) {
    test_calls_ += plan_.tests.count;
    calls_known_ += plan_.tests.count;
  }
  if (auto recorded = record_events(rows); !recorded) return Unexpected(recorded.error());
  record_state(rows);
  want_batch(tasks, rows);
  return true;
}

void DesignRunner::record_acted(CommandRow command, std::vector<Row>& rows) {
  std::erase_if(plan_.commands,
                [&](const CommandRow& other) { return other.number == command.number; });
  command.step = static_cast<std::int64_t>(steps_);
  plan_.commands.insert(plan_.commands.begin() + static_cast<std::ptrdiff_t>(next_command_),
                        command);
  ++next_command_;
  record(std::move(command), rows);
}

void DesignRunner::warn(const std::string& text, std::vector<Row>& rows) const {
  record(EventRow{.severity = "warning",
                  .kind = "race",
                  .text = "{\"design\":" + quoted_text(to_string(plan_.row.id)) +
                          ",\"text\":" + quoted_text(text) + "}"},
         rows);
}

}  // namespace swarmsmith
