#pragma once

#include "proto/key.h"
#include "storage/rows.h"

namespace swarmsmith {

static_assert(kTestPurpose == static_cast<std::int32_t>(Purpose::Test) &&
                  kEvaluatorPurpose == static_cast<std::int32_t>(Purpose::Evaluator) &&
                  kMostCandidates == kCandidatesPerDesign,
              "workers count as the store does");

/// Keys of the store to one word and back; the caller has a key that came from a campaign.
constexpr PackedKey pack(const EvaluationKey& key) {
  return pack(key.candidate.value, static_cast<std::int32_t>(key.purpose), key.pair);
}

constexpr EvaluationKey unpack(PackedKey packed) {
  return {.candidate = {static_cast<std::int64_t>(packed >> 23U)},
          .purpose = static_cast<Purpose>(packed & 7U),
          .pair = static_cast<std::int64_t>(packed >> 3U & 0xfffffU)};
}

}  // namespace swarmsmith
