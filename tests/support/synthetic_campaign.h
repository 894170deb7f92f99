#pragma once

#include <cstdint>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// The rows of a campaign that looks like a real one and was never raced: candidates, pairs, steps
/// that drop the worst, elites, a tested winner. A function of its arguments.
struct SyntheticCampaign {
  CampaignRow campaign;
  std::vector<DesignRow> designs;
  /// In the order in which a campaign would store them: one batch a race step, or smaller.
  std::vector<std::vector<Row>> batches;
};

struct SyntheticSize {
  std::int64_t designs = 2;
  std::int64_t iterations = 3;
  std::int64_t candidates = 8;  ///< new ones in an iteration
  std::int64_t steps = 7;       ///< of an iteration
  std::int64_t tests = 4;       ///< evaluations of the winner
  std::int64_t first_drop = 5;  ///< step of the first test
  double survive = 0.7;         ///< part that survives a step with a test
};

/// One design, some 100,000 experiments on 16,000 candidates, as many as real races sample.
inline constexpr SyntheticSize kHundredThousand{.designs = 1,
                                                .iterations = 10,
                                                .candidates = 1580,
                                                .steps = 60,
                                                .tests = 100,
                                                .first_drop = 5,
                                                .survive = 0.55};

SyntheticCampaign synthetic_campaign(const SyntheticSize& size = {}, std::uint64_t seed = 1);

/// The same without batches, for stores whose rows do not fit into memory at once; and the batches
/// of one of its designs. The campaign's end is none of them.
SyntheticCampaign synthetic_header(const SyntheticSize& size, std::uint64_t seed = 1);
std::vector<std::vector<Row>> synthetic_design(const SyntheticSize& size, DesignId id,
                                               std::uint64_t seed = 1);

}  // namespace swarmsmith
