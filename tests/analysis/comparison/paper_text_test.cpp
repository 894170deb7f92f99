#include "analysis/comparison/paper_text.h"

#include <cstdint>
#include <vector>

#include "analysis/comparison/comparison_text.h"
#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Ten designs of each of two methods; the first one is clearly better.
std::vector<Scored> of_two_methods(double lead) {
  std::vector<Scored> designs;
  for (int i = 1; i <= 10; ++i) {
    designs.push_back({.design = i,
                       .mission = "color_selection",
                       .method = "new_one",
                       .repetition = i,
                       .scores = {lead + i}});
    designs.push_back({.design = i + 10,
                       .mission = "color_selection",
                       .method = "old",
                       .repetition = i,
                       .scores = {i + 0.5}});
  }
  return designs;
}

TEST(PaperSentences, SayWhoIsBetterWithTestEffectAndInterval) {
  const Comparison comparison = compare(records_of(of_two_methods(20)), {.by = CompareBy::Method});
  const auto sentences = paper_sentences(comparison);
  ASSERT_EQ(sentences.size(), 1U);
  // p: R 4.2, wilcox.test(21:30, 1:10 + 0.5): 1.083e-05.
  EXPECT_EQ(sentences.front().text,
            "On color selection, new_one scored higher than old in simulation with the profile rvr "
            "(n = 10 and 10 designs; mean scores 25.5 and 6; Wilcoxon rank-sum test, two-sided, W "
            "= 100, p < 0.0001; A12 = 1.00 (large), difference of the means 19.5, " +
                sentences.front().text.substr(sentences.front().text.find("95 % interval")));
  EXPECT_THAT(sentences.front().latex,
              HasSubstr("new\\_one scored higher than old in simulation with the profile rvr "
                        "($n = 10$ and 10 designs"));
  EXPECT_THAT(sentences.front().latex, HasSubstr("$p < 0.0001$; $\\hat{A}_{12} = 1.00$"));
  EXPECT_THAT(sentences.front().latex, HasSubstr("95\\,\\% interval $["));
}

/// The values of two methods, one per design.
std::vector<Scored> of_values(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<Scored> designs;
  std::int64_t id = 0;
  for (const double value : first)
    designs.push_back({.design = ++id, .method = "first", .repetition = id, .scores = {value}});
  for (const double value : second)
    designs.push_back({.design = ++id, .method = "second", .repetition = id, .scores = {value}});
  return designs;
}

/// 19 values near 10 and a single one far below; 20 values near 0.
const std::vector<double> kHighButOne = {10.01, 10.02, 10.03, 10.04, 10.05, 10.06, 10.07,
                                         10.08, 10.09, 10.1,  10.11, 10.12, 10.13, 10.14,
                                         10.15, 10.16, 10.17, 10.18, 10.19, -10000};
const std::vector<double> kNearZero = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1,
                                       0.11, 0.12, 0.13, 0.14, 0.15, 0.16, 0.17, 0.18, 0.19, 0.2};

TEST(PaperSentences, TakeTheDirectionFromTheRanksThatWereTested) {
  const auto first = paper_sentences(
      compare(records_of(of_values(kHighButOne, kNearZero)), {.by = CompareBy::Method}));
  EXPECT_THAT(first.front().text, AllOf(HasSubstr("first scored higher than second"),
                                        HasSubstr("A12 = 0.95"), HasSubstr("means -")));
  const auto second = paper_sentences(
      compare(records_of(of_values(kNearZero, kHighButOne)), {.by = CompareBy::Method}));
  EXPECT_THAT(second.front().text, HasSubstr("first scored lower than second"));
}

TEST(PaperSentences, OfPairsTakeTheDirectionFromTheSignedRanks) {
  // The differences are 1 to 19 and -400: V = 190 of 210, but their mean is negative. One more
  // difference is zero, which the test does not use.
  std::vector<Scored> designs;
  for (int i = 1; i <= 21; ++i) {
    const double lead = i == 20 ? -400 : i == 21 ? 0 : i;
    designs.push_back({.design = i, .repetition = i, .source = "rvr", .scores = {100 + lead}});
    designs.push_back({.design = i, .repetition = i, .source = "real", .scores = {100}});
  }
  const auto sentences = paper_sentences(compare(records_of(designs), {}));
  EXPECT_THAT(sentences.front().text,
              AllOf(HasSubstr("watermelon scored higher in simulation with the profile rvr than"),
                    HasSubstr("V = 190"), HasSubstr("difference of the means -")));
}

TEST(PaperSentences, PrintAPBelowTheLevelAsBelowIt) {
  // R 4.2, wilcox.test(x, y): W = 13, p = 0.04988; of two digits this would be 0.05.
  const auto sentences = paper_sentences(compare(
      records_of(of_values({0.1, 0.2, 0.3, 1.4, 1.5, 2.6, 3.7, 6.8}, {1, 2, 3, 4, 5, 6, 7, 8})),
      {.by = CompareBy::Method}));
  EXPECT_THAT(sentences.front().text,
              AllOf(HasSubstr("first scored lower than second"), HasSubstr("W = 13, p = 0.0499;")));
}

TEST(PaperSentences, CountTheTestsThatHolmCorrects) {
  // "still" and "rest" scored the same everywhere: their test has no p, and is not counted.
  std::vector<Scored> designs = of_values(kHighButOne, {});
  for (int i = 1; i <= 8; ++i) {
    for (const char* method : {"rest", "still"}) {
      designs.push_back({.design = 100 + i + (method[0] == 'r' ? 50 : 0),
                         .method = method,
                         .repetition = i,
                         .scores = {0}});
    }
  }
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  ASSERT_EQ(comparison.pairs.size(), 3U);
  EXPECT_THAT(paper_sentences(comparison).front().text, HasSubstr("by Holm over 2 comparisons"));
  EXPECT_THAT(comparison_text(comparison), HasSubstr("Holm's over 2 tests"));
}

TEST(PaperSentences, NeverCallNoiseADifference) {
  const Comparison comparison = compare(records_of(of_two_methods(0.9)), {.by = CompareBy::Method});
  EXPECT_THAT(paper_sentences(comparison).front().text,
              HasSubstr("no difference was found between new_one and old in "
                        "simulation with the profile rvr"));
}

TEST(PaperSentences, GoByHolmWhereThereAreSeveral) {
  std::vector<Scored> designs = of_two_methods(4.2);
  const Comparison alone = compare(records_of(designs), {.by = CompareBy::Method});
  for (int i = 1; i <= 10; ++i)
    designs.push_back({.design = i + 20,
                       .mission = "color_selection",
                       .method = "third",
                       .repetition = i,
                       .scores = {i + 0.6}});
  const Comparison three = compare(records_of(designs), {.by = CompareBy::Method});
  EXPECT_THAT(paper_sentences(alone).front().text, HasSubstr("new_one scored higher"));
  EXPECT_THAT(
      paper_sentences(three).front().text,
      AllOf(HasSubstr("by Holm over 3 comparisons p = "), HasSubstr("no difference was found")));
}

TEST(PaperSentences, OfTheSameDesignsInTwoSourcesArePaired) {
  std::vector<Scored> designs;
  for (int i = 1; i <= 10; ++i) {
    designs.push_back({.design = i, .repetition = i, .source = "rvr", .scores = {2.0 * i}});
    designs.push_back({.design = i, .repetition = i, .source = "real", .scores = {1.0 * i}});
  }
  const auto sentences = paper_sentences(compare(records_of(designs), {}));
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_THAT(sentences.front().text,
              StartsWith("On aggregation, designs by watermelon scored higher in simulation "
                         "with the profile rvr than on the robots (n = 10 designs; mean scores 11 "
                         "and 5.5; Wilcoxon signed-rank test, two-sided, V = 55, p = 0.002; "));
}

TEST(PaperSentences, WithoutPairsSayHowEachGroupDid) {
  const Comparison comparison =
      compare(records_of({{.design = 1, .repetition = 1, .scores = {1, 2, 3}}}), {});
  const auto sentences = paper_sentences(comparison);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(
      sentences.front().text,
      "On aggregation, watermelon scored 2 on average in simulation with the profile rvr (standard "
      "deviation 1, median 2, from 1 to 3; n = 3 runs).");
}

}  // namespace
}  // namespace swarmsmith
