#include "coordinator/design/campaign_runner.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// Ten designs that look ahead keep 64 slots busy (docs/performance.md).
constexpr std::size_t kSlotsOfADesign = 6;

}  // namespace

CampaignRunner::CampaignRunner(std::vector<DesignPlan> plans,
                               std::map<DesignId, StoredDesign> stored,
                               const std::vector<DesignId>& finished,
                               const std::vector<CommandRow>& commands, OpenDesigns most)
    : most_(most) {
  for (DesignPlan& plan : plans) {
    const DesignId id = plan.row.id;
    all_.push_back(id);
    if (std::ranges::find(finished, id) != finished.end()) {
      // The pool need not remember its outcomes (`take_ended`).
      ended_.push_back(id);
      continue;
    }
    plan.commands = commands_to(id, commands);
    auto known = stored.extract(id);
    const bool is_new = waiting_
                            .emplace(id, Waiting{std::move(plan), known ? std::move(known.mapped())
                                                                        : StoredDesign{}})
                            .second;
    SWARMSMITH_ASSERT(is_new, "a design is planned once");
  }
  // The campaign may have been finished before.
  if (waits_for_extension(commands)) rows_.emplace_back(CampaignStateRow{.state = "running"});
  open_designs();
}

std::vector<Task> CampaignRunner::take_tasks() {
  return std::exchange(tasks_, {});
}

/// The order is by cost: looking one pair ahead costs little, because most tests drop no candidate;
/// another design costs only memory; evaluations on further pairs may turn out to be useless
/// (orchestration facts, 10).
std::vector<Task> CampaignRunner::take_more(std::size_t count, std::size_t slots) {
  std::vector<Task> more = take_tasks();
  // Decision 8 has the reasons for these steps and their limits.
  open_more(count, std::min(most_.at_most, slots / kSlotsOfADesign), more);
  look_ahead(count, 1, more);
  open_more(count, most_.at_most, more);
  for (std::int64_t pairs = 1; pairs <= kMostPairsAhead; pairs *= 2)
    look_ahead(count, pairs, more);
  return more;
}

void CampaignRunner::open_more(std::size_t count, std::size_t limit, std::vector<Task>& tasks) {
  while (!error_ && tasks.size() < count && open_.size() < limit && !waiting_.empty()) {
    open(waiting_.begin());
    std::ranges::move(take_tasks(), std::back_inserter(tasks));
  }
}

void CampaignRunner::look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks) {
  if (tasks.size() >= count) return;
  std::vector<DesignRunner*> designs;
  for (auto& [id, design] : open_)
    designs.push_back(&design);
  // The design nearest to its barrier first: its slots would idle soonest (decision 8).
  std::ranges::stable_sort(designs, {}, &DesignRunner::awaited);
  for (DesignRunner* design : designs) {
    if (tasks.size() >= count) return;
    design->look_ahead(count - tasks.size(), pairs, tasks, rows_);
  }
}

std::vector<EvaluationKey> CampaignRunner::take_dropped() {
  std::vector<EvaluationKey> dropped = std::exchange(dropped_, {});
  for (auto& [id, design] : open_)
    std::ranges::copy(design.take_dropped(), std::back_inserter(dropped));
  return dropped;
}

std::vector<Row> CampaignRunner::take_rows() {
  return std::exchange(rows_, {});
}

std::optional<Task> CampaignRunner::task_of(const EvaluationKey& key) const {
  const DesignId id = design_of(key.candidate);
  if (const auto found = open_.find(id); found != open_.end()) return found->second.task_of(key);
  const auto kept = kept_.find(id);
  return kept == kept_.end() ? std::nullopt : kept->second.task_of(key);
}

void CampaignRunner::tell(const Outcome& outcome) {
  const DesignId id = design_of(outcome.key.candidate);
  // It was handed out ahead, and an outcome that came just before made the race want it.
  std::erase_if(tasks_, [&](const Task& task) { return task.key == outcome.key; });
  if (const auto found = open_.find(id); found != open_.end()) {
    found->second.tell(outcome, rows_);
    advance(found->second);
    open_designs();
  } else if (const auto kept = kept_.find(id); kept != kept_.end()) {
    kept->second.tell(outcome, rows_);
  } else {
    // The design is over and forgotten. The score is stored without an iteration, so it is not part
    // of the answer.
    const auto late = late_.extract(outcome.key);
    SWARMSMITH_ASSERT(!late.empty(), "outcomes belong to tasks that were given");
    rows_.emplace_back(evaluation_row(outcome, 0, late.mapped().bound, late.mapped().source));
  }
}

void CampaignRunner::advance(DesignRunner& design) {
  if (error_) return;
  if (auto advanced = design.advance(tasks_, rows_); !advanced) {
    error_ = advanced.error();
    return;
  }
  if (auto passed = design.take_passed()) passed_.push_back(std::move(*passed));
  if (is_over(design.state())) put_away(design.id());
}

void CampaignRunner::put_away(DesignId id) {
  auto ended = open_.extract(id);
  SWARMSMITH_ASSERT(!ended.empty(), "a design that is over was open");
  std::ranges::copy(ended.mapped().take_dropped(), std::back_inserter(dropped_));
  // A stopped design takes no more commands, so it need not stay in memory.
  if (ended.mapped().state() != DesignState::Finished) return forget(ended.mapped());
  kept_.insert(std::move(ended));
  kept_order_.push_back(id);
  SWARMSMITH_ASSERT(kept_order_.size() == kept_.size(),
                    "every kept design is in the order of removal");
  // The oldest first; `OpenDesigns` has the limits.
  while (keeps_too_many()) {
    forget(kept_.extract(kept_order_.front()).mapped());
    kept_order_.erase(kept_order_.begin());
  }
}

bool CampaignRunner::keeps_too_many() const {
  std::int64_t experiments = 0;
  for (const auto& [id, design] : kept_)
    experiments += design.used();
  return kept_.size() > most_.finished ||
         (kept_.size() > 1 && experiments > most_.finished_experiments);
}

void CampaignRunner::forget(const DesignRunner& ended) {
  ended_.push_back(ended.id());
  for (const auto& [key, bound] : ended.outstanding())
    late_.emplace(key, Late{bound, ended.source()});
}

void CampaignRunner::open(std::map<DesignId, Waiting>::iterator next) {
  auto waiting = waiting_.extract(next);
  auto runner =
      DesignRunner::start(std::move(waiting.mapped().plan), std::move(waiting.mapped().stored));
  if (!runner) {
    error_ = runner.error();
    return;
  }
  // Once open, a design first replays its stored part, within `advance`.
  const auto [placed, fresh] = open_.emplace(waiting.key(), std::move(*runner));
  SWARMSMITH_ASSERT(fresh, "a design is opened once");
  advance(placed->second);
}

void CampaignRunner::open_designs() {
  while (!error_ && open_.size() < most_.at_least && !waiting_.empty())
    open(waiting_.begin());
  // Once: an extension of a design that is kept sets it back.
  if (finished() && !state_recorded_) {
    state_recorded_ = true;
    rows_.emplace_back(CampaignStateRow{.state = "finished"});
  }
}

bool CampaignRunner::finished() const {
  return !error_ && open_.empty() && waiting_.empty();
}

std::vector<DesignId> CampaignRunner::unfinished() const {
  std::vector<DesignId> ids;
  std::ranges::copy_if(all_, std::back_inserter(ids),
                       [&](DesignId id) { return waiting_.contains(id) || open_.contains(id); });
  return ids;
}

Expected<void> CampaignRunner::carry_out(const CommandRow& command) {
  const DesignId id = command.design;
  if (error_) return Unexpected(*error_);
  if (!id)
    return bad_input("name at least one design, such as d1", std::string(word_of(command.kind)));
  if (const auto waiting = waiting_.find(id); waiting != waiting_.end())
    return command_waiting(waiting, command);
  // A finished design that is still in memory goes on from its end.
  if (const auto kept = kept_.find(id); kept != kept_.end()) {
    if (auto taken = kept->second.command(command, rows_); !taken) return taken;
    std::erase(kept_order_, id);
    open_.insert(kept_.extract(kept));
    if (std::exchange(state_recorded_, false))
      rows_.emplace_back(CampaignStateRow{.state = "running"});
  }
  const auto found = open_.find(id);
  if (found == open_.end()) return Unexpected(no_such_design(id));
  if (found->second.state() != DesignState::Finished) {
    if (auto taken = found->second.command(command, rows_); !taken) return taken;
  }
  advance(found->second);
  open_designs();
  if (error_) return Unexpected(*error_);
  return {};
}

/// A cancel opens the design, so that it ends now, as if cancelled before its first step.
Expected<void> CampaignRunner::command_waiting(std::map<DesignId, Waiting>::iterator found,
                                               const CommandRow& command) {
  DesignPlan& plan = found->second.plan;
  if (auto checked = check_command(plan, plan.commands, command); !checked) return checked;
  plan.commands.push_back(command);
  plan.commands.back().step.reset();
  rows_.emplace_back(plan.commands.back());
  // An extension waits with its design.
  if (command.kind == CommandKind::Cancel) open(found);
  open_designs();
  if (error_) return Unexpected(*error_);
  return {};
}

Error CampaignRunner::no_such_design(DesignId id) const {
  const std::string name = to_string(id);
  if (std::ranges::find(all_, id) == all_.end()) {
    return {ErrorKind::NotFound,
            "the campaign has no such design; it has " + to_string(all_.front()) + " to " +
                to_string(all_.back()),
            name};
  }
  return {ErrorKind::BadInput,
          "the design is over and no longer in memory; extend it while no coordinator runs the "
          "campaign, and run the campaign again",
          name};
}

bool waits_for_extension(const std::vector<CommandRow>& commands) {
  const auto is_cancelled = [&](DesignId design) {
    return std::ranges::any_of(commands, [&](const CommandRow& command) {
      return command.kind == CommandKind::Cancel && command.step && command.design == design;
    });
  };
  return std::ranges::any_of(commands, [&](const CommandRow& command) {
    return command.kind == CommandKind::Extend && !command.step && !is_cancelled(command.design);
  });
}

std::vector<DesignId> ended_designs(const std::vector<DesignStateRow>& states,
                                    const std::vector<CommandRow>& commands) {
  std::vector<DesignId> ended;
  for (const DesignStateRow& state : states) {
    const bool goes_on = std::ranges::any_of(commands, [&](const CommandRow& command) {
      return command.kind == CommandKind::Extend && command.design == state.design && !command.step;
    });
    if (state.state == DesignState::Finished && !goes_on) ended.push_back(state.design);
  }
  return ended;
}

std::vector<CommandRow> commands_to(DesignId design, const std::vector<CommandRow>& commands) {
  std::vector<CommandRow> found;
  std::ranges::copy_if(commands, std::back_inserter(found), [&](const CommandRow& command) {
    return command.design == design && (is_of_race(command.kind));
  });
  return found;
}

std::map<DesignId, StoredDesign> by_design(const std::vector<StoredScore>& scores,
                                           const std::vector<StoredStep>& steps,
                                           const std::vector<DesignId>& finished) {
  std::map<DesignId, StoredDesign> designs;
  const auto skipped = [&](DesignId id) {
    return std::ranges::find(finished, id) != finished.end();
  };
  for (const StoredScore& score : scores) {
    const DesignId id = design_of(score.key.candidate);
    // A design that needs nothing more is not replayed, so its scores are not kept in memory.
    if (skipped(id)) continue;
    StoredDesign& design = designs[id];
    if (auto* known = scores_of(design, score.key.purpose))
      known->emplace(packed_key(score.key), score);
  }
  for (const StoredStep& step : steps) {
    if (skipped(step.design)) continue;
    auto& digests = designs[step.design].step_digests;
    SWARMSMITH_ASSERT(step.step == static_cast<std::int64_t>(digests.size()) + 1,
                      "a store gives a design's steps in order, without a gap");
    digests.push_back(step.digest);
  }
  return designs;
}

}  // namespace swarmsmith
