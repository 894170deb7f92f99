#pragma once

#include "coordinator/campaign/campaign_file.h"
#include "tests/support/checks.h"

namespace swarmsmith {

/// A campaign of one design: aggregation, watermelon, 2,000 experiments.
inline Campaign one_design_campaign() {
  return value_of(parse_campaign(R"(format = 1
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
                                 "demo.toml"));
}

}  // namespace swarmsmith
