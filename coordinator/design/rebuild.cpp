#include "coordinator/design/rebuild.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/design_runner.h"

namespace swarmsmith {
namespace {

using Digests = std::map<std::pair<DesignId, std::int64_t>, std::uint64_t>;

using Scores = std::unordered_map<std::uint64_t, StoredScore>;

/// Resets the iterations of all scores, so that the replay determines again which ones the race
/// uses. Returns how many had been used.
std::int64_t forget_iterations(Scores& scores) {
  std::int64_t used = 0;
  for (auto& [packed, score] : scores)
    used += std::exchange(score.iteration, 0) != 0 ? 1 : 0;
  return used;
}

bool is_use(const Row& row) {
  const auto* evaluation = std::get_if<EvaluationRow>(&row);
  return evaluation != nullptr && evaluation->iteration != 0;
}

/// Reports the first step that differs from the recovered one.
void compare_steps(const std::vector<Row>& rows, const Digests& found,
                   std::vector<std::string>& complaints) {
  for (const Row& row : rows) {
    const auto* step = std::get_if<RaceStepRow>(&row);
    if (step == nullptr) continue;
    const auto known = found.find({step->design, step->step});
    // Recovered steps have gaps; a step that was lost cannot contradict.
    if (known == found.end() || known->second == step->digest) continue;
    complaints.push_back(
        fmt::format("{}: the scores give another step {} than the stored one: a score in it, or "
                    "before it, was changed",
                    to_string(step->design), step->step));
    return;
  }
}

void rebuild_design(DesignPlan plan, StoredDesign stored, const Digests& steps, Rebuilt& result) {
  const DesignId id = plan.row.id;
  Rebuilt::Design design{.id = id};
  const auto complain = [&](const Error& error) {
    result.complaints.push_back(fmt::format("{}: {}", to_string(id), to_string(error)));
    result.designs.push_back(design);
  };
  // After a loss, which scores a race used cannot be trusted: a score before them may be missing,
  // and then the race has not reached them yet.
  const std::int64_t used_before = forget_iterations(stored.race_scores);
  // The recovered digests are not among the stored data: they have gaps.
  auto runner = DesignRunner::start(std::move(plan), std::move(stored));
  if (!runner) return complain(runner.error());
  std::vector<Task> tasks;
  std::vector<Row> rows;
  if (auto advanced = runner->advance(tasks, rows); !advanced) return complain(advanced.error());
  compare_steps(rows, steps, result.complaints);
  const StoredDesign& left = runner->unasked();
  for (const Scores* scores : {&left.test_scores, &left.evaluator_scores}) {
    for (const auto& [packed, score] : *scores)
      result.derived.unasked.push_back(score.key);
    design.unasked += static_cast<std::int64_t>(scores->size());
  }
  design.state = runner->state();
  design.used = runner->used();
  design.ahead = std::max<std::int64_t>(0, used_before - std::ranges::count_if(rows, is_use));
  // The replay stops where scores are missing; the campaign continues from here.
  design.missing = tasks.size();
  result.designs.push_back(design);
  std::ranges::move(rows, std::back_inserter(result.derived.rows));
}

}  // namespace

Rebuilt rebuild(std::vector<DesignPlan> plans, const std::vector<StoredScore>& scores,
                const std::vector<StoredStep>& steps, const std::vector<CommandRow>& commands) {
  Digests found;
  for (const StoredStep& step : steps)
    found[{step.design, step.step}] = step.digest;
  std::vector<CommandRow> acted = commands;
  // A command that waits has changed nothing yet.
  std::erase_if(acted, [](const CommandRow& command) { return !command.step; });
  auto stored = by_design(scores, {}, {});
  Rebuilt result;
  for (DesignPlan& plan : plans) {
    const DesignId id = plan.row.id;
    plan.commands = commands_to(id, acted);
    rebuild_design(std::move(plan), std::move(stored[id]), found, result);
  }
  return result;
}

}  // namespace swarmsmith
