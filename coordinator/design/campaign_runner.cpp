#include "coordinator/design/campaign_runner.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {

CampaignRunner::CampaignRunner(std::vector<DesignPlan> plans,
                               std::map<DesignId, StoredDesign> stored,
                               std::vector<DesignId> finished)
    : plans_(std::move(plans)), stored_(std::move(stored)), finished_(std::move(finished)) {
  open_designs();
}

std::vector<Task> CampaignRunner::take_tasks() {
  return std::exchange(tasks_, {});
}

std::vector<Row> CampaignRunner::take_rows() {
  return std::exchange(rows_, {});
}

void CampaignRunner::tell(const Outcome& outcome) {
  const auto found = open_.find(design_of(outcome.key.candidate));
  SWARMSMITH_ASSERT(found != open_.end(), "outcomes belong to designs that are being run");
  found->second.tell(outcome, rows_);
  advance(found->second);
  open_designs();
}

void CampaignRunner::advance(DesignRunner& design) {
  if (error_) return;
  if (auto advanced = design.advance(tasks_, rows_); !advanced) {
    error_ = advanced.error();
    return;
  }
  if (design.state() != DesignState::Finished && design.state() != DesignState::Stopped) return;
  open_.erase(design.id());
}

void CampaignRunner::open_designs() {
  while (!error_ && open_.size() < kOpenDesigns && next_plan_ < plans_.size()) {
    DesignPlan plan = std::move(plans_[next_plan_++]);
    const DesignId id = plan.row.id;
    if (std::ranges::find(finished_, id) != finished_.end()) continue;
    auto stored = stored_.extract(id);
    auto runner =
        DesignRunner::start(std::move(plan), stored ? std::move(stored.mapped()) : StoredDesign{});
    if (!runner) {
      error_ = runner.error();
      return;
    }
    const auto [placed, fresh] = open_.emplace(id, std::move(*runner));
    SWARMSMITH_ASSERT(fresh, "a design is opened once");
    advance(placed->second);
  }
  if (finished() && !state_recorded_) {
    state_recorded_ = true;
    rows_.emplace_back(CampaignStateRow{.state = "finished"});
  }
}

bool CampaignRunner::finished() const {
  return !error_ && open_.empty() && next_plan_ == plans_.size();
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
    if (skipped(id)) continue;
    StoredDesign& design = designs[id];
    auto* known = score.key.purpose == Purpose::Race        ? &design.race_scores
                  : score.key.purpose == Purpose::Test      ? &design.test_scores
                  : score.key.purpose == Purpose::Evaluator ? &design.evaluator_scores
                                                            : nullptr;
    if (known == nullptr) continue;
    known->emplace(DesignRunner::key_of(number_of(score.key.candidate), score.key.pair), score);
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
