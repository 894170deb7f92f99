#pragma once

#include <stdexcept>

#include "coordinator/campaign/campaign_file.h"

namespace swarmsmith {

/// A campaign of one design: aggregation, watermelon, 2,000 experiments.
inline Campaign one_design_campaign() {
  auto campaign = parse_campaign(R"(format = 1
[campaign]
name = "demo"
store = "demo.db"
[[mission]]
name = "aggregation"
[[method]]
name = "watermelon"
[race]
max_experiments = 2_000
)",
                                 "demo.toml");
  if (!campaign) throw std::logic_error(campaign.error().front().message);
  return std::move(*campaign);
}

}  // namespace swarmsmith
