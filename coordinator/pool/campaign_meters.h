#pragma once

#include <cstdint>

#include "coordinator/pool/histogram.h"

namespace swarmsmith {

/// Numbers of one campaign for people, counted since the start of this process.
struct CampaignMeters {
  std::uint64_t leased = 0;  ///< tasks, each time that a worker got one
  std::uint64_t done = 0;
  std::uint64_t rejected = 0;
  std::uint64_t no_score = 0;   ///< attempts of which a worker said that there is none
  std::uint64_t timed_out = 0;  ///< attempts that took too long
  Histogram evaluation;         ///< what the worker measured
  Histogram queue_wait;         ///< from wanted to first leased
  Histogram round_trip;         ///< from leased to the result's arrival
};

}  // namespace swarmsmith
