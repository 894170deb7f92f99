#include "analysis/comparison/comparison_tables.h"

#include "analysis/comparison/comparison_text.h"
#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::vector<DesignScore> scores() {
  return records_of({{.design = 1, .method = "a, b", .scores = {3}},
                     {.design = 2, .method = "a, b", .repetition = 2, .scores = {4}},
                     {.design = 3, .method = "c", .scores = {1}},
                     {.design = 4, .method = "c", .repetition = 2, .scores = {2}}});
}

/// Of two missions, in which the same one is better.
std::vector<DesignScore> of_two_missions() {
  std::vector<DesignScore> both = scores();
  for (DesignScore score : scores()) {
    score.mission = "grid";
    score.design.value += 10;
    both.push_back(score);
  }
  return both;
}

TEST(ComparisonTables, AreRfc4180) {
  const Comparison comparison = compare(scores(), {.by = CompareBy::Method});
  EXPECT_EQ(groups_csv(comparison),
            "mission,method,source,n,designs,runs,mean,sd,min,lower_quartile,median,upper_quartile,"
            "max\n"
            "aggregation,\"a, b\",rvr,2,2,2,3.5,0.7071067811865476,3,3.25,3.5,3.75,4\n"
            "aggregation,c,rvr,2,2,2,1.5,0.7071067811865476,1,1.25,1.5,1.75,2\n");
  EXPECT_THAT(pairs_csv(comparison),
              HasSubstr("\naggregation,,rvr,\"a, b\",c,2,2,rank-sum,4,0.3333333333333333,"
                        "0.3333333333333333,exact,0,0.3333333333333333,1,large,2,"));
  EXPECT_THAT(ranks_csv(compare(of_two_missions(), {.by = CompareBy::Method}).ranks),
              HasSubstr("\nrvr,\"a, b\",1,1,1,2,0,2,1,0.15729920705028"));
}

TEST(ComparisonTables, LeaveEmptyWhatIsNotThere) {
  const Comparison comparison = compare(
      records_of({{.method = "a", .scores = {3}}, {.design = 2, .method = "b", .scores = {3}}}),
      {.by = CompareBy::Method});
  EXPECT_THAT(groups_csv(comparison), HasSubstr("a,rvr,1,1,1,3,,3,3,3,3,3\n"));
  EXPECT_THAT(pairs_csv(comparison), HasSubstr(",rank-sum,0.5,,,\"normal approximation, "));
}

TEST(ComparisonText, HasGroupsPairsRanksAndHow) {
  const std::string text = comparison_text(compare(scores(), {.by = CompareBy::Method}));
  EXPECT_THAT(text, HasSubstr("aggregation  a, b    rvr     2        2     2   3.5  0.707107"));
  EXPECT_THAT(text, HasSubstr("2+2  4  0.3333    0.3333  exact  1.000   large"));
  EXPECT_THAT(text, HasSubstr("  1) n is too small: even the clearest difference would have an "
                              "exact p of 0.333\n"));
  const std::string ranks = comparison_text(compare(of_two_missions(), {.by = CompareBy::Method}));
  EXPECT_THAT(ranks, HasSubstr("Ranks of mean scores in rvr over aggregation, grid (2 blocks): "));
  EXPECT_THAT(ranks, testing::ContainsRegex("mean rank +95 % interval\n *a, b +1.000 .*\n"
                                            " *c +2.000 .*\n"))
      << "a headline, and a row for each name";
  EXPECT_THAT(ranks, AllOf(HasSubstr("  1) n is too small"), Not(HasSubstr("  2) "))))
      << "a note of two pairs once";
  EXPECT_THAT(text, HasSubstr("Wilcoxon rank-sum test, two-sided; exact without ties; Holm's over "
                              "1 test."));
  EXPECT_THAT(text, HasSubstr("seed 1"));
}

TEST(ComparisonText, ByMissionHasATableAndNotesAndNoTest) {
  std::vector<Scored> designs = {{.design = 20, .method = "b", .scores = {2}}};
  for (int i = 1; i <= 10; ++i)
    designs.push_back({.design = i, .method = "a", .repetition = i, .scores = {1}});
  const std::string text =
      comparison_text(compare(records_of(designs), {.by = CompareBy::Mission}));
  EXPECT_THAT(text, Not(HasSubstr("Wilcoxon")));
  EXPECT_THAT(text, HasSubstr("source   n  designs  runs  mean  sd  min  q1  median  q3  max\n"
                              "aggregation  a       rvr     10       10    10     1   0    1   1"
                              "       1   1    1\n"
                              "aggregation  b       rvr      1        1     1     2   -    2   2"
                              "       2   2    2\n\n"
                              "scores of different missions have different units"));
}

}  // namespace
}  // namespace swarmsmith
