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
  std::int64_t experiments = 0;     ///< upper limit for all races
  std::int64_t largest_budget = 0;  ///< of one design
  std::int64_t tests = 0;           ///< evaluations of winners, outside the budgets, lower limit
  std::int64_t slots = 1;
  /// Mean over machines and missions, measured here on one core; empty if programs evaluate.
  std::optional<double> evaluation_s;
  double time_s = 0;                  ///< only with evaluation_s
  double disk_bytes = 0;              ///< of the store at the end
  double log_bytes = 0;               ///< upper limit for the log beside it while the campaign runs
  std::vector<std::string> warnings;  ///< problems that do not prevent the campaign from running
};

/// Times simulations of random machines for about half a second and estimates the totals. Does not
/// run programs.
CampaignPlan plan_of(const Campaign& campaign);

}  // namespace swarmsmith::cli
