#pragma once

#include <cstdint>

#include "base/assert.h"

namespace swarmsmith {

/// An evaluation's key in one integer, for hash maps: 6 bits for the campaign (its index in the
/// coordinator), 35 for the candidate, 20 for the pair, 3 for the purpose. Zero is not a key, since
/// candidates count from 1.
using PackedKey = std::uint64_t;

inline constexpr std::uint32_t kMaxCampaigns = 64;
inline constexpr std::int64_t kMaxCandidate = (std::int64_t{1} << 35) - 1;
inline constexpr std::int64_t kMaxPair = (std::int64_t{1} << 20) - 1;
inline constexpr std::int32_t kMaxPurpose = 7;

/// Purposes and limits that a worker must know, with the values of the store (storage/rows.h).
inline constexpr std::int32_t kTestPurpose = 2;
inline constexpr std::int32_t kEvaluatorPurpose = 5;
inline constexpr std::int64_t kMostCandidates = 1'000'000;  ///< of a design
/// The last design whose candidates all have keys.
inline constexpr std::int64_t kMostDesigns = kMaxCandidate / kMostCandidates;

constexpr bool is_valid_key(std::int64_t candidate, std::int32_t purpose, std::int64_t pair) {
  return candidate > 0 && candidate <= kMaxCandidate && purpose >= 0 && purpose <= kMaxPurpose &&
         pair >= 0 && pair <= kMaxPair;
}

/// The caller must have checked the key.
constexpr PackedKey pack(std::int64_t candidate, std::int32_t purpose, std::int64_t pair,
                         std::uint32_t campaign = 0) {
  SWARMSMITH_ASSERT(is_valid_key(candidate, purpose, pair) && campaign < kMaxCampaigns,
                    "a key fits into one integer");
  return static_cast<PackedKey>(campaign) << 58U | static_cast<PackedKey>(candidate) << 23U |
         static_cast<PackedKey>(pair) << 3U | static_cast<PackedKey>(purpose);
}

constexpr std::uint32_t campaign_of(PackedKey key) {
  return static_cast<std::uint32_t>(key >> 58U);
}
constexpr std::int64_t candidate_of(PackedKey key) {
  return static_cast<std::int64_t>(key >> 23U) & kMaxCandidate;
}
constexpr std::int32_t purpose_of(PackedKey key) {
  return static_cast<std::int32_t>(key & 7U);
}
/// The candidate's number within its design: irace's id of the configuration, from 1.
constexpr std::int64_t number_of(PackedKey key) {
  return (candidate_of(key) - 1) % kMostCandidates + 1;
}

}  // namespace swarmsmith
