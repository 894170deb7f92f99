#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/campaign/campaign.h"

namespace swarmsmith::cli {

/// The estimated cost of a campaign.
struct CampaignPlan {
  std::int64_t designs = 0;
  std::int64_t experiments = 0;     ///< of all races, at most
  std::int64_t largest_budget = 0;  ///< of a design
  std::int64_t tests = 0;           ///< evaluations of winners, outside the budgets, at least
  std::int64_t slots = 1;
  /// Mean over machines and missions, measured here on one core; nothing where programs evaluate.
  std::optional<double> evaluation_s;
  double time_s = 0;                  ///< only with evaluation_s
  double disk_bytes = 0;              ///< of the store in the end
  double log_bytes = 0;               ///< at most beside it while the campaign runs
  std::vector<std::string> warnings;  ///< what runs, but hardly as wanted
};

/// Times some simulations of random machines (for about half a second) and sums up. Runs no
/// programs.
CampaignPlan plan_of(const Campaign& campaign);

}  // namespace swarmsmith::cli
