#include "analysis/comparison/paper_text.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/comparison/comparison_text.h"
#include "analysis/statistics/bootstrap.h"
#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

PaperSentence sentence_on(const std::vector<Scored>& designs, const ComparisonOptions& options) {
  const auto sentences = paper_sentences(compare(records_of(designs), options));
  EXPECT_EQ(sentences.size(), 1U);
  return sentences.front();
}

/// "[1, 2]", with four significant digits.
std::string printed_interval(const MeanDifference& difference) {
  return fmt::format("[{:.4g}, {:.4g}]", difference.low, difference.high);
}

/// Ten designs of each of two methods.
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
  const std::string interval =
      printed_interval(mean_difference(comparison.groups[0].values, comparison.groups[1].values));
  const auto sentences = paper_sentences(comparison);
  ASSERT_EQ(sentences.size(), 1U);
  // p: R 4.2, wilcox.test(21:30, 1:10 + 0.5): 1.083e-05.
  EXPECT_EQ(sentences.front().text,
            "On color selection, new_one scored higher than old in simulation with the profile rvr "
            "(n = 10 and 10 designs; mean scores 25.5 and 6; Wilcoxon rank-sum test, two-sided, W "
            "= 100, p < 0.0001; A12 = 1.00 (large), difference of the means 19.5, 95 % interval " +
                interval + ").");
  EXPECT_EQ(sentences.front().latex,
            "On color selection, new\\_one scored higher than old in simulation with the profile "
            "rvr ($n = 10$ and 10 designs; mean scores $25.5$ and $6$; Wilcoxon rank-sum test, "
            "two-sided, $W = 100$, $p < 0.0001$; $\\hat{A}_{12} = 1.00$ (large), difference of the "
            "means $19.5$, 95\\,\\% interval $" +
                interval + "$).");
}

/// 19 values near 10 and a single one far below; 20 values near 0.
const std::vector<double> kHighButOne = {10.01, 10.02, 10.03, 10.04, 10.05, 10.06, 10.07,
                                         10.08, 10.09, 10.1,  10.11, 10.12, 10.13, 10.14,
                                         10.15, 10.16, 10.17, 10.18, 10.19, -10000};
const std::vector<double> kNearZero = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1,
                                       0.11, 0.12, 0.13, 0.14, 0.15, 0.16, 0.17, 0.18, 0.19, 0.2};

/// 1, 2, ..., `last`, and these.
std::vector<double> counted_to(std::size_t last, const std::vector<double>& more) {
  std::vector<double> values(last);
  std::iota(values.begin(), values.end(), 1.0);
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

TEST(PaperSentences, TakeTheDirectionFromTheRanksThatWereTested) {
  struct Case {
    std::vector<double> first;
    std::vector<double> second;
    std::string direction;
    std::string test;
  };
  for (const auto& [first, second, direction, test] : std::vector<Case>{
           {kHighButOne, kNearZero, "higher", "W = 380, p < 0.0001; A12 = 0.95"},
           {kNearZero, kHighButOne, "lower", "W = 20, p < 0.0001; A12 = 0.05"},
           // R: wilcox.test(c(0.5, 2.5, 3.5), 1:20)$p.value is 0.01807.
           {{0.5, 2.5, 3.5}, counted_to(20, {}), "lower", "W = 5, p = 0.018; A12 = 0.08"},
       }) {
    const std::string text =
        sentence_on(two_methods(first, second), {.by = CompareBy::Method}).text;
    EXPECT_THAT(text, StartsWith("On aggregation, first scored " + direction +
                                 " than second in simulation with the profile rvr ("));
    EXPECT_THAT(text, HasSubstr(", two-sided, " + test));
  }
}

TEST(PaperSentences, OfPairsTakeTheDirectionFromTheSignedRanks) {
  struct Case {
    std::string what;
    std::vector<double> differences;
    double step;  ///< between the real scores of one design and the next
    std::string direction;
    std::string test;
  };
  std::vector<double> down_to_150 = counted_to(150, {});
  for (double& value : down_to_150)
    value *= value > 95 ? -1 : 1;
  for (const auto& [what, differences, step, direction, test] : std::vector<Case>{
           {"the mean difference is negative, but V is 190 of 210; one zero is not used",
            counted_to(19, {-400, 0}), 0, "higher", "V = 190"},
           {"two designs fell below all others, which A12 counts once for each of these",
            counted_to(18, {-19'000, -20'000}), 1000, "higher", "V = 171"},
           {"half of the differences are zero",
            counted_to(19, {-20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 0,
            "higher", "V = 190"},
           // R: wilcox.test(c(1:95, -(96:150)))$p.value is 0.03868.
           {"V is 4560, where half of all ranks is 5662.5", down_to_150, 0, "lower",
            "V = 4560, p = 0.039"},
       }) {
    std::vector<double> simulated;
    std::vector<double> real;
    for (const double difference : differences) {
      real.push_back(step * static_cast<double>(real.size()));
      simulated.push_back(real.back() + difference);
    }
    const std::string text = sentence_on(on_robots_too(simulated, real), {}).text;
    EXPECT_THAT(text, StartsWith("On aggregation, designs by watermelon scored " + direction +
                                 " in simulation with the profile rvr than on the robots ("))
        << what;
    EXPECT_THAT(text, HasSubstr(", two-sided, " + test)) << what;
  }
}

/// A comparison of one pair with this p, and nothing else.
Comparison of_p(double p) {
  ComparedPair pair{.mission = "grid", .source = "rvr", .first = "a", .second = "b", .p_holm = p};
  pair.test.p_value = p;
  return {.pairs = {pair}};
}

TEST(PaperSentences, PrintAPBelowALevelAsBelowIt) {
  for (const auto& [p, printed, direction] :
       std::vector<std::tuple<double, std::string, std::string>>{
           {0.00009999, "p < 0.0001", "a scored lower than b"},
           {0.0001, "p = 0.0001", "a scored lower than b"},
           {0.0244, "p = 0.024", "a scored lower than b"},
           {0.04988, "p = 0.0499", "a scored lower than b"},
           {0.04999, "p = 0.04999", "a scored lower than b"},
           {0.05, "p = 0.05", "no difference was found between a and b"},
           {0.0501, "p = 0.05", "no difference was found between a and b"},
       }) {
    const auto sentences = paper_sentences(of_p(p));
    EXPECT_EQ(sentences.front().text,
              "On grid, " + direction +
                  " in simulation with the profile rvr (n = 0 and 0 designs; Wilcoxon rank-sum "
                  "test, two-sided, W = 0, " +
                  printed +
                  "; A12 = 0.50 (negligible), difference of the means 0, 95 % interval [0, 0]).");
  }
}

TEST(PaperSentences, CountTheTestsThatHolmCorrects) {
  // "still" and "rest" scored the same everywhere: their test has no p, and is not counted.
  std::vector<Scored> designs = designs_of("first", kHighButOne);
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
  // Each scored 2 less on the robots, so each resample has this difference. R 4.2:
  // wilcox.test(3:12, 1:10, paired = TRUE)$p.value is 0.001904.
  const std::vector<double> more = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<double> less = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(sentence_on(on_robots_too(more, less), {}).text,
            "On aggregation, designs by watermelon scored higher in simulation with the profile "
            "rvr than on the robots (n = 10 designs; mean scores 7.5 and 5.5; Wilcoxon signed-rank "
            "test, two-sided, V = 55, p = 0.0019; A12 = 0.68 (medium), difference of the means 2, "
            "95 % interval [2, 2]).");
  EXPECT_EQ(sentence_on(on_robots_too({2, 2}, {3, 3}), {}).text,
            "On aggregation, no difference was found between designs by watermelon in simulation "
            "with the profile rvr and the same designs on the robots (n = 2 designs; mean scores 2 "
            "and 3; Wilcoxon signed-rank test, two-sided, V = 0, p = 0.35; A12 = 0.00 (large), "
            "difference of the means -1, 95 % interval [-1, -1]). Note: n is too small: even the "
            "clearest difference would have an exact p of 0.5.");
}

TEST(PaperSentences, OfEqualScoresHaveNoP) {
  EXPECT_EQ(sentence_on(two_methods({4, 4}, {4, 4}), {.by = CompareBy::Method}).text,
            "On aggregation, no difference was found between first and second in simulation with "
            "the profile rvr (n = 2 and 2 designs; mean scores 4 and 4; Wilcoxon rank-sum test, "
            "two-sided, W = 2, no p; A12 = 0.50 (negligible), difference of the means 0, 95 % "
            "interval [0, 0]). Note: all values are the same: no p.");
}

TEST(PaperSentences, OfRunsOfOneMachineEachSayThatMethodsWereNotCompared) {
  const std::string machines =
      " Each group is one machine: the test tells machines apart, and says nothing about the "
      "methods.";
  const auto text_of = [](const std::vector<Scored>& designs, CompareBy by, ScoreUnit unit) {
    return sentence_on(designs, {.by = by, .choice = {.purpose = "", .unit = unit}}).text;
  };
  const std::vector<Scored> one_each = {{.design = 1, .method = "a", .scores = {5, 5, 5}},
                                        {.design = 2, .method = "b", .scores = {5, 5, 5}}};
  EXPECT_EQ(text_of(one_each, CompareBy::Method, ScoreUnit::Run),
            "On aggregation, no difference was found between a and b in simulation with the "
            "profile rvr (n = 3 and 3 runs; mean scores 5 and 5; Wilcoxon rank-sum test, "
            "two-sided, W = 4.5, no p; A12 = 0.50 (negligible), difference of the means 0, 95 % "
            "interval [0, 0])." +
                machines + " Note: all values are the same: no p.");
  EXPECT_THAT(text_of(one_each, CompareBy::Method, ScoreUnit::Design), Not(HasSubstr(machines)));
  EXPECT_THAT(text_of(on_robots_too({1}, {2}), CompareBy::Source, ScoreUnit::Run),
              Not(HasSubstr(machines)));
  EXPECT_THAT(text_of(two_methods({1, 2}, {3}), CompareBy::Method, ScoreUnit::Run),
              Not(HasSubstr(machines)));
  EXPECT_THAT(text_of(two_methods({1, 2}, {3, 4}), CompareBy::Method, ScoreUnit::Run),
              Not(HasSubstr(machines)));
}

TEST(PaperSentences, WithoutPairsSayHowEachGroupDid) {
  const auto text_of = [](const Scored& design) { return sentence_on({design}, {}).text; };
  EXPECT_EQ(text_of({.scores = {1, 2, 3}}),
            "On aggregation, watermelon scored 2 on average in simulation with the profile rvr "
            "(standard deviation 1, median 2, from 1 to 3; n = 3 runs).");
  EXPECT_EQ(text_of({.source = "real", .scores = {1, 2}}),
            "On aggregation, watermelon scored 1.5 on average on the robots (standard deviation "
            "0.7071, median 1.5, from 1 to 2; n = 2 runs).");
  EXPECT_EQ(text_of({.source = "command", .scores = {4}}),
            "On aggregation, watermelon scored 4 on average (median 4, from 4 to 4; n = 1 run).");
  EXPECT_EQ(
      sentence_on({{.design = 1, .scores = {1, 3}}, {.design = 2, .scores = {4, 4, 4}}}, {}).text,
      "On aggregation, watermelon scored 3 on average in simulation with the profile rvr "
      "(standard deviation 1.414, median 3, from 2 to 4; n = 2 designs, each the mean of its "
      "runs, 5 in all).");
}

TEST(PaperSentences, PrintNumbersAsPapersDo) {
  for (const auto& [score, printed] : std::vector<std::pair<double, std::string>>{
           {-0.00012346, "-0.0001235"},
           {999.96, "1000"},
           {1234.6, "1235"},
           {-9999999, "-9999999"},
           {1e7, "1e+07"},
       }) {
    const PaperSentence sentence = sentence_on({{.scores = {score}}}, {});
    EXPECT_THAT(sentence.text, HasSubstr("watermelon scored " + printed + " on average"));
    EXPECT_THAT(sentence.latex, HasSubstr("watermelon scored $" + printed + "$ on average"));
  }
}

TEST(PaperSentences, EscapeNamesForLatex) {
  const PaperSentence sentence = sentence_on({{.method = R"(a\b~c^d#$%&_{}e)", .scores = {1}}}, {});
  EXPECT_THAT(sentence.text, StartsWith(R"(On aggregation, a\b~c^d#$%&_{}e scored 1 )"));
  EXPECT_THAT(
      sentence.latex,
      StartsWith(R"(On aggregation, a\textbackslash{}b\~{}c\^{}d\#\$\%\&\_\{\}e scored $1$ )"));
}

}  // namespace
}  // namespace swarmsmith
