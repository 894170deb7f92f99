#include "sim/files/profile_file.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(Profile, TheDefaultHasTheNoiseOfTheThesis) {
  const Expected<Profile> rvr = built_in_profile("rvr");
  ASSERT_TRUE(rvr.has_value());
  EXPECT_EQ(rvr->proximity.range_m, 0.4);
  EXPECT_EQ(rvr->proximity.sd_m, 0.01);
  EXPECT_EQ(rvr->ground_color.sd, 5);
}

TEST(Profile, ThatOfThePublishedFilesHasNone) {
  const Expected<Profile> argos3 = built_in_profile("argos3");
  ASSERT_TRUE(argos3.has_value());
  EXPECT_EQ(argos3->proximity.sd_m, 0);
  EXPECT_EQ(argos3->ground_color.sd, 0);
}

TEST(Profile, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const Expected<Profile> none = built_in_profile("mars");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().kind, ErrorKind::NotFound);
  EXPECT_EQ(
      none.error().message,
      "there is no simulator profile `mars`; built in are: rvr, argos3, pseudo-reality; a file "
      "of your own ends in .toml");
}

}  // namespace
}  // namespace swarmsmith
