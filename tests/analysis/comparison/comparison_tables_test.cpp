#include "analysis/comparison/comparison_tables.h"

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "analysis/comparison/comparison_text.h"
#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

// Statistics and p are those of R 4.2's wilcox.test and friedman.test, to 13 digits at least, and
// the intervals of ranks those of tests/golden/statistics/make.R. All intervals of differences are
// known: a resample of two values is at either end in one of 16 cases, more than 2.5 %, and
// resamples of equal values, or of equal differences, are all alike.

/// Two methods in two missions. In the grid all scores of a method are equal.
Comparison by_method() {
  std::vector<Scored> designs;
  const auto add = [&](const std::string& mission, const std::string& method,
                       const std::vector<double>& values) {
    for (Scored design : designs_of(method, values, std::ssize(designs) + 1)) {
      design.mission = mission;
      designs.push_back(design);
    }
  };
  add("color", "a, b", {3, 4});
  add("color", "c", {1, 2});
  add("grid", "a, b", std::vector<double>(10, 5));
  add("grid", "c", {2, 2});
  return compare(records_of(designs), {.by = CompareBy::Method});
}

/// Seven designs in simulation, and six of them on robots, where each scored 2 less.
Comparison by_source() {
  return compare(records_of(on_robots_too({3, 4, 5, 6, 7, 8, 9}, {1, 2, 3, 4, 5, 6})), {});
}

/// Designs in three sources; one was not tried in all of them.
Comparison of_three_sources() {
  std::vector<Scored> designs = on_robots_too({9, 8, 7, 9, 5, 4, 3}, {1, 2, 3, 1, 1, 2});
  for (Scored design : designs_of("watermelon", {5, 6, 4, 8, 6, 3})) {
    design.source = "slippery";
    designs.push_back(design);
  }
  return compare(records_of(designs), {});
}

TEST(ComparisonTables, AreRfc4180) {
  EXPECT_EQ(
      groups_csv(by_method()),
      "mission,method,source,n,designs,runs,mean,sd,min,lower_quartile,median,upper_quartile,max\n"
      "color,\"a, b\",rvr,2,2,2,3.5,0.7071067811865476,3,3.25,3.5,3.75,4\n"
      "color,c,rvr,2,2,2,1.5,0.7071067811865476,1,1.25,1.5,1.75,2\n"
      "grid,\"a, b\",rvr,10,10,10,5,0,5,5,5,5,5\n"
      "grid,c,rvr,2,2,2,2,0,2,2,2,2,2\n");
  EXPECT_EQ(
      pairs_csv(by_method()),
      "mission,method,source,first,second,n_first,n_second,test,"
      "statistic,p,p_holm,"
      "p_method,zeros,least_p,a12,magnitude,mean_difference,difference_low,difference_high,"
      "notes\n"
      "color,,rvr,\"a, b\",c,2,2,rank-sum,"
      "4,0.3333333333333333,0.3333333333333333,"
      "exact,0,0.3333333333333333,1,large,2,1,3,"
      "n is too small: even the clearest difference would have an exact p of 0.333\n"
      "grid,,rvr,\"a, b\",c,10,2,rank-sum,"
      "20,0.0016282753920619237,0.0032565507841238474,"
      "\"normal approximation, continuity correction\",0,0.030303030303030304,1,large,3,3,3,"
      "n is small: an interval of fewer than 10 values is too narrow; too few values for 2 tests "
      "together: after the correction even the clearest difference would have a p of 0.0606\n");
  EXPECT_EQ(ranks_csv(by_method().ranks),
            "source,name,mean_rank,low,high,blocks,incomplete,chi_squared,degrees,p,missions\n"
            "rvr,\"a, b\",1,1,1,2,0,2,1,0.15729920705028677,color grid\n"
            "rvr,c,2,2,2,2,0,2,1,0.15729920705028677,color grid\n");
  EXPECT_EQ(
      pairs_csv(by_source()),
      "mission,method,source,first,second,n_first,n_second,test,"
      "statistic,p,p_holm,"
      "p_method,zeros,least_p,a12,magnitude,mean_difference,difference_low,difference_high,"
      "notes\n"
      "aggregation,watermelon,,rvr,real,6,6,signed-rank,"
      "21,0.01965615725016967,0.01965615725016967,"
      "\"normal approximation, continuity correction\",0,0.03125,0.7777777777777778,large,2,2,2,"
      "\"n is small: an interval of fewer than 10 values is too narrow; designs left out, since "
      "only one of the two sources has them: 1\"\n");
  EXPECT_EQ(
      ranks_csv(of_three_sources().ranks),
      "source,name,mean_rank,low,high,blocks,incomplete,chi_squared,degrees,p,missions\n"
      ",rvr,1.1666666666666667,1,1.4292553486107842,6,1,10.333333333333334,2,0.005703548998007409,"
      "aggregation\n"
      ",slippery,1.8333333333333333,1.5707446513892158,2.0959220152774507,6,1,10.333333333333334,2,"
      "0.005703548998007409,aggregation\n"
      ",real,3,2.7374113180558823,3,6,1,10.333333333333334,2,0.005703548998007409,aggregation\n");
}

TEST(ComparisonTables, RankTheMethodsOfEachSourceByThemselves) {
  std::vector<Scored> designs;
  for (const char* mission : {"aggregation", "grid"}) {
    for (Scored design : on_robots_too({2, 1}, {3, 4})) {
      design.mission = mission;
      design.method = design.design == 1 ? "first" : "second";
      design.design += 10 * std::ssize(designs);
      designs.push_back(design);
    }
  }
  EXPECT_EQ(ranks_csv(compare(records_of(designs), {.by = CompareBy::Method}).ranks),
            "source,name,mean_rank,low,high,blocks,incomplete,chi_squared,degrees,p,missions\n"
            "rvr,first,1,1,1,2,0,2,1,0.15729920705028677,aggregation grid\n"
            "rvr,second,2,2,2,2,0,2,1,0.15729920705028677,aggregation grid\n"
            "real,first,2,2,2,2,0,2,1,0.15729920705028677,aggregation grid\n"
            "real,second,1,1,1,2,0,2,1,0.15729920705028677,aggregation grid\n");
}

TEST(ComparisonTables, LeaveEmptyWhatIsNotThere) {
  const Comparison comparison =
      compare(records_of(two_methods({3}, {3})), {.by = CompareBy::Method});
  EXPECT_THAT(groups_csv(comparison), EndsWith("second,rvr,1,1,1,3,,3,3,3,3,3\n"));
  EXPECT_THAT(pairs_csv(comparison),
              EndsWith("\naggregation,,rvr,first,second,1,1,rank-sum,0.5,,,\"normal approximation, "
                       "continuity correction\",0,1,0.5,negligible,0,0,0,all values are the same: "
                       "no p; an interval of one value has no width\n"));
}

TEST(ComparisonTables, HaveTheNamesOfTheCommandLine) {
  EXPECT_EQ(name_of(CompareBy::Source), "source");
  EXPECT_EQ(name_of(CompareBy::Method), "method");
  EXPECT_EQ(name_of(CompareBy::Mission), "mission");
  EXPECT_EQ(name_of(ScoreUnit::Design), "design");
  EXPECT_EQ(name_of(ScoreUnit::Run), "run");
}

TEST(ComparisonText, OfMethodsHasGroupsPairsRanksAndHow) {
  EXPECT_EQ(
      comparison_text(by_method()),
      "Scores of the designs' winners, larger is better; a value is a design: the mean of its "
      "tests.\n"
      "\n"
      "mission  method  source   n  designs  runs  mean        sd  min    q1  median    q3  max\n"
      "color    a, b    rvr      2        2     2   3.5  0.707107    3  3.25     3.5  3.75    4\n"
      "color    c       rvr      2        2     2   1.5  0.707107    1  1.25     1.5  1.75    2\n"
      "grid     a, b    rvr     10       10    10     5         0    5     5       5     5    5\n"
      "grid     c       rvr      2        2     2     2         0    2     2       2     2    2\n"
      "\n"
      "mission  source  first  second     n   W         p  Holm's p    p is"
      "    A12  effect  difference  95 % interval  notes\n"
      "color    rvr     a, b   c        2+2   4    0.3333    0.3333   exact"
      "  1.000   large           2         [1, 3]      1\n"
      "grid     rvr     a, b   c       10+2  20  0.001628  0.003257  normal"
      "  1.000   large           3         [3, 3]    2 3\n"
      "  1) n is too small: even the clearest difference would have an exact p of 0.333\n"
      "  2) n is small: an interval of fewer than 10 values is too narrow\n"
      "  3) too few values for 2 tests together: after the correction even the clearest difference "
      "would have a p of 0.0606\n"
      "\n"
      "Ranks of mean scores in rvr over color, grid (2 blocks): Friedman chi-squared 2, 1 degree "
      "of freedom, p 0.1573\n"
      "      mean rank  95 % interval\n"
      "a, b      1.000              -\n"
      "c         2.000              -\n"
      "No difference is found at 5 %, so there are no intervals: the order may be chance.\n"
      "\n"
      "p: Wilcoxon rank-sum test, two-sided; exact without ties; normal approximation with "
      "correction for ties and continuity; Holm's over 2 tests.\n"
      "A12: chance that the first is larger. Difference: of means, first - second; 10000 bootstrap "
      "resamples, seed 1.\n");
}

TEST(ComparisonText, OfSourcesHasThePairsOfTheSameDesigns) {
  EXPECT_EQ(comparison_text(by_source()),
            "Scores of the designs' winners, larger is better; a value is a design: the mean of "
            "its tests.\n"
            "\n"
            "mission      method      source  n  designs  runs"
            "  mean       sd  min    q1  median    q3  max\n"
            "aggregation  watermelon  rvr     7        7     7"
            "     6  2.16025    3   4.5       6   7.5    9\n"
            "aggregation  watermelon  real    6        6     6"
            "   3.5  1.87083    1  2.25     3.5  4.75    6\n"
            "\n"
            "mission      method      first  second  n   V        p  Holm's p    p is"
            "    A12  effect  difference  95 % interval  notes\n"
            "aggregation  watermelon  rvr    real    6  21  0.01966   0.01966  normal"
            "  0.778   large           2         [2, 2]    1 2\n"
            "  1) n is small: an interval of fewer than 10 values is too narrow\n"
            "  2) designs left out, since only one of the two sources has them: 1\n"
            "\n"
            "Ranks of mean scores over aggregation (6 blocks, incomplete and left out: 1): "
            "Friedman chi-squared 6, 1 degree of freedom, p 0.01431\n"
            "      mean rank  95 % interval\n"
            "rvr       1.000              -\n"
            "real      2.000              -\n"
            "They differ at 5 %. All blocks have the same order, so there are no intervals to tell "
            "which.\n"
            "\n"
            "p: Wilcoxon signed-rank test, two-sided; normal approximation with correction for "
            "ties and continuity; Holm's over 1 test.\n"
            "A12: chance that the first is larger. Difference: of means, first - second; 10000 "
            "bootstrap resamples, seed 1.\n");
}

TEST(ComparisonText, OfThreeSourcesHasEachNoteOnceAndIntervalsOfRanks) {
  const std::string text = comparison_text(of_three_sources());
  const std::size_t begin = text.find("  1) ");
  EXPECT_EQ(text.substr(begin, text.find("\np: ", begin) - begin),
            "  1) n is small: an interval of fewer than 10 values is too narrow\n"
            "  2) designs left out, since only one of the two sources has them: 1\n"
            "  3) too few values for 3 tests together: after the correction even the clearest "
            "difference would have a p of 0.0938\n"
            "\n"
            "Ranks of mean scores over aggregation (6 blocks, incomplete and left out: 1): "
            "Friedman chi-squared 10.3333, 2 degrees of freedom, p 0.005704\n"
            "          mean rank   95 % interval\n"
            "rvr           1.167  [1.000, 1.429]\n"
            "slippery      1.833  [1.571, 2.096]\n"
            "real          3.000  [2.737, 3.000]\n"
            "Intervals of 95 %: two that do not overlap differ at 5 %.\n");
}

TEST(ComparisonText, ByMissionHasATableAndNotesAndNoTest) {
  std::vector<Scored> designs = designs_of("a", std::vector<double>(10, 1));
  designs.push_back({.design = 20, .method = "b", .scores = {2}});
  EXPECT_EQ(
      comparison_text(compare(records_of(designs), {.by = CompareBy::Mission})),
      "Scores of the designs' winners, larger is better; a value is a design: the mean of its "
      "tests.\n\n"
      "mission      method  source   n  designs  runs  mean  sd  min  q1  median  q3  max\n"
      "aggregation  a       rvr     10       10    10     1   0    1   1       1   1    1\n"
      "aggregation  b       rvr      1        1     1     2   -    2   2       2   2    2\n\n"
      "scores of different missions have different units: they are not compared\n");
}

}  // namespace
}  // namespace swarmsmith
