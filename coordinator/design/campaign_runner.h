#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/design_runner.h"
#include "coordinator/work_source.h"

namespace swarmsmith {

/// All designs of a campaign as one source of work: opens them in order, a few at a time, and
/// passes outcomes on to theirs. A pure state machine.
class CampaignRunner final : public WorkSource {
 public:
  /// How many unfinished designs race at the same time: one alone leaves slots idle at each of its
  /// barriers (docs/decisions/0008).
  static constexpr std::size_t kOpenDesigns = 4;

  /// `stored` holds what is known of unfinished designs; `finished` those that need nothing more.
  /// Plans are started when they are opened; the first error stops everything, see `error`.
  CampaignRunner(std::vector<DesignPlan> plans, std::map<DesignId, StoredDesign> stored,
                 std::vector<DesignId> finished);

  std::vector<Task> take_tasks() override;
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override;
  bool finished() const override;

  /// Why the campaign cannot go on: a plan that does not fit, a store that disagrees.
  const std::optional<Error>& error() const { return error_; }

 private:
  void open_designs();
  void advance(DesignRunner& design);

  std::vector<DesignPlan> plans_;
  std::map<DesignId, StoredDesign> stored_;
  std::vector<DesignId> finished_;
  std::size_t next_plan_ = 0;
  std::map<DesignId, DesignRunner> open_;
  std::vector<Task> tasks_;
  std::vector<Row> rows_;
  std::optional<Error> error_;
  bool state_recorded_ = false;
};

/// A store's scores and steps, sorted by design, without the designs in `finished` and without
/// scores that no race asked for (audits, later scorings).
std::map<DesignId, StoredDesign> by_design(const std::vector<StoredScore>& scores,
                                           const std::vector<StoredStep>& steps,
                                           const std::vector<DesignId>& finished);

}  // namespace swarmsmith
