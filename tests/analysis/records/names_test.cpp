#include "analysis/records/names.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(NameOrder, RealIsLast) {
  EXPECT_TRUE(NameOrder()("rvr", "real"));
  EXPECT_FALSE(NameOrder()("real", "zebra"));
  EXPECT_TRUE(NameOrder()("argos3", "rvr"));
  EXPECT_FALSE(NameOrder()("real", "real"));
}

TEST(AsWords, HasBlanks) {
  EXPECT_EQ(as_words("color_selection"), "color selection");
}

}  // namespace
}  // namespace swarmsmith
