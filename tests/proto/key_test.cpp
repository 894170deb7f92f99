#include "proto/task_messages.h"
#include "proto/wire.pb.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

pb::Key key_of(std::int64_t candidate, int purpose, std::int64_t pair) {
  pb::Key key;
  key.set_candidate(candidate);
  key.set_purpose(purpose);
  key.set_pair(pair);
  return key;
}

TEST(PackedKey, ComesBackAsItWas) {
  for (const std::int64_t candidate : {std::int64_t{1}, std::int64_t{999'999'999}, kMaxCandidate}) {
    for (const int purpose : {0, 1, 4, kMaxPurpose}) {
      for (const std::int64_t pair : {std::int64_t{0}, std::int64_t{99'999}, kMaxPair}) {
        pb::Key back;
        unpack(*pack(key_of(candidate, purpose, pair)), back);
        EXPECT_EQ(back.candidate(), candidate);
        EXPECT_EQ(back.purpose(), purpose);
        EXPECT_EQ(back.pair(), pair);
      }
    }
  }
}

TEST(PackedKey, RefusesWhatCannotBeAKey) {
  EXPECT_FALSE(pack(key_of(0, 0, 1)));
  EXPECT_FALSE(pack(key_of(-1, 0, 1)));
  EXPECT_FALSE(pack(key_of(kMaxCandidate + 1, 0, 1)));
  EXPECT_FALSE(pack(key_of(1, -1, 1)));
  EXPECT_FALSE(pack(key_of(1, 8, 1)));
  EXPECT_FALSE(pack(key_of(1, 0, -1)));
  EXPECT_FALSE(pack(key_of(1, 0, kMaxPair + 1)));
  pb::Key key = key_of(1, 0, 1);
  key.set_campaign(kMaxCampaigns - 1);
  EXPECT_EQ(campaign_of(pack(key).value()), kMaxCampaigns - 1);
  key.set_campaign(kMaxCampaigns);
  EXPECT_FALSE(pack(key));
}

}  // namespace
}  // namespace swarmsmith
