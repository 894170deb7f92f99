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

std::vector<EvaluationKey> keys_of(const std::unordered_map<std::uint64_t, StoredScore>& scores,
                                   bool only_used) {
  std::vector<EvaluationKey> keys;
  for (const auto& [packed, score] : scores) {
    if (!only_used || score.iteration != 0) keys.push_back(score.key);
  }
  std::ranges::sort(keys);
  return keys;
}

void append(std::vector<EvaluationKey>& to, const std::vector<EvaluationKey>& keys) {
  to.insert(to.end(), keys.begin(), keys.end());
}

/// The first step that the scores give otherwise than it was found.
void compare_steps(const std::vector<Row>& rows, const Digests& found,
                   std::vector<std::string>& complaints) {
  for (const Row& row : rows) {
    const auto* step = std::get_if<RaceStepRow>(&row);
    if (step == nullptr) continue;
    const auto known = found.find({step->design, step->step});
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
  auto runner = DesignRunner::start(std::move(plan), std::move(stored));
  if (!runner) return complain(runner.error());
  std::vector<Task> tasks;
  std::vector<Row> rows;
  if (auto advanced = runner->advance(tasks, rows); !advanced) return complain(advanced.error());
  compare_steps(rows, steps, result.complaints);
  const StoredDesign& left = runner->unasked();
  const auto ahead = keys_of(left.race_scores, true);
  auto unasked = keys_of(left.test_scores, false);
  append(unasked, keys_of(left.evaluator_scores, false));
  design.state = runner->state();
  design.used = runner->used();
  design.ahead = static_cast<std::int64_t>(ahead.size());
  design.unasked = static_cast<std::int64_t>(unasked.size());
  design.missing = tasks.size();
  result.designs.push_back(design);
  std::ranges::move(rows, std::back_inserter(result.derived.rows));
  append(result.derived.ahead, ahead);
  append(result.derived.unasked, unasked);
}

}  // namespace

Rebuilt rebuild(std::vector<DesignPlan> plans, const std::vector<StoredScore>& scores,
                const std::vector<StoredStep>& steps, const std::vector<CommandRow>& commands) {
  Digests found;
  for (const StoredStep& step : steps)
    found[{step.design, step.step}] = step.digest;
  std::vector<CommandRow> acted = commands;
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
