#include "console/wrapped.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

TEST(Wrapped, FillsParagraphsAnew) {
  EXPECT_EQ(wrapped("one two three\nfour", 9), "one two\nthree\nfour");
  EXPECT_EQ(wrapped("one\ntwo", 20), "one two");
  EXPECT_EQ(wrapped("one\n\ntwo\n", 20), "one\n\ntwo\n");
  EXPECT_EQ(wrapped("", 20), "");
}

TEST(Wrapped, KeepsIndentedLinesApart) {
  EXPECT_EQ(wrapped("Kinds:\n  a b\n  c d\nEnd.", 20), "Kinds:\n  a b\n  c d\nEnd.");
  EXPECT_EQ(wrapped("  aaa bbb ccc", 9), "  aaa bbb\n    ccc");
}

TEST(Wrapped, GoesOnBelowTheSecondColumn) {
  EXPECT_EQ(wrapped("  box   boxes of all values", 19), "  box   boxes of\n        all values");
}

TEST(Wrapped, LeavesCommandsThatCanBeTyped) {
  EXPECT_EQ(wrapped("  swarmsmith run --store tonight.db", 24),
            "  swarmsmith run \\\n      --store \\\n      tonight.db");
}

TEST(Wrapped, LeavesWordsThatAreTooLongAsTheyAre) {
  EXPECT_EQ(wrapped("a bcdefghijkl m", 5), "a\nbcdefghijkl\nm");
}

TEST(Wrapped, CountsCharactersAndNotBytes) {
  EXPECT_EQ(wrapped("\xc3\xa4\xc3\xa4 \xc3\xb6\xc3\xb6", 5), "\xc3\xa4\xc3\xa4 \xc3\xb6\xc3\xb6");
}

}  // namespace
}  // namespace swarmsmith
