#include "base/suggestion.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace swarmsmith {
namespace {

const std::vector<std::string> kKeys = {"seed", "store", "repetitions", "max_experiments"};

TEST(Suggestion, FindsAWordWithOneLetterWrongMissingOrSwapped) {
  EXPECT_EQ(closest("sead", kKeys), "seed");
  EXPECT_EQ(closest("stor", kKeys), "store");
  EXPECT_EQ(closest("sotre", kKeys), "store");
}

TEST(Suggestion, LooksAtNeitherCaseNorTheKindOfDash) {
  EXPECT_EQ(closest("Max-Experiments", kKeys), "max_experiments");
}

TEST(Suggestion, PrefersTheWordThatLacksADashAlone) {
  const std::vector<std::string> searches = {"irace", "random", "f-race", "cma-es"};
  EXPECT_EQ(closest("frace", searches), "f-race");
  EXPECT_EQ(closest("F Race", searches), "f-race");
  EXPECT_EQ(closest("cmaes", searches), "cma-es");
  EXPECT_EQ(closest("race", searches), "irace");
}

TEST(Suggestion, ToleratesMoreEditsInLongerWords) {
  EXPECT_EQ(closest("repititons", kKeys), "repetitions");
}

TEST(Suggestion, SaysNothingWhenNoWordIsNear) {
  EXPECT_EQ(closest("wombat", kKeys), std::nullopt);
  EXPECT_EQ(did_you_mean("wombat", kKeys), "");
  EXPECT_EQ(closest("x", std::vector<std::string>{"y"}), std::nullopt);
}

TEST(Suggestion, ReadsAsTheEndOfASentence) {
  EXPECT_EQ(did_you_mean("sead", kKeys), " (did you mean \"seed\"?)");
  EXPECT_EQ(joined(kKeys), "seed, store, repetitions, max_experiments");
  EXPECT_EQ(joined(std::vector<std::string>{"one", "two, three"}), "\"one\", \"two, three\"");
}

}  // namespace
}  // namespace swarmsmith
