#pragma once

#include "coordinator/design/task.h"
#include "proto/key.h"
#include "storage/rows.h"

namespace swarmsmith {

static_assert(kTestPurpose == static_cast<std::int32_t>(Purpose::Test) &&
                  kEvaluatorPurpose == static_cast<std::int32_t>(Purpose::Evaluator) &&
                  kMostCandidates == kCandidatesPerDesign && kMostDesigns == kDesignsPerCampaign,
              "workers count as the store does");

/// Packs a store's keys into one word; the key must come from a campaign.
constexpr PackedKey pack(const EvaluationKey& key, std::uint32_t campaign = 0) {
  return pack(key.candidate.value, static_cast<std::int32_t>(key.purpose), key.pair, campaign);
}

inline PackedKey key_of(const Task& task) {
  return pack(task.key, task.campaign);
}
inline PackedKey key_of(const Outcome& outcome) {
  return pack(outcome.key, outcome.campaign);
}

/// The reverse, without the campaign, which is that of the store.
constexpr EvaluationKey unpack(PackedKey packed) {
  return {.candidate = {candidate_of(packed)},
          .purpose = static_cast<Purpose>(packed & 7U),
          .pair = static_cast<std::int64_t>(packed >> 3U & 0xfffffU)};
}

}  // namespace swarmsmith
