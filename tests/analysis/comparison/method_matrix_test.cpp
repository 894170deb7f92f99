#include "analysis/comparison/method_matrix.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Table = std::vector<std::vector<bool>>;

/// A table in which these pairs differ.
Table different(std::size_t count, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
  Table table(count, std::vector<bool>(count));
  for (const auto& [a, b] : pairs)
    table[a][b] = table[b][a] = true;
  return table;
}

/// The letters by definition. A set of items has a letter if no two of them differ, and if each
/// further item would differ from one of them. The sets are sorted by their items.
std::vector<std::string> letters_by_definition(const Table& table) {
  using Items = std::vector<std::size_t>;
  const auto fits = [&](const Items& items, std::size_t more) {
    return std::ranges::none_of(items, [&](std::size_t item) { return table[item][more]; });
  };
  std::vector<Items> sets;
  for (std::size_t number = 1; number < std::size_t{1} << table.size(); ++number) {
    Items items;
    bool is_whole = true;
    for (std::size_t i = 0; i < table.size(); ++i) {
      if ((number >> i & 1U) == 0) continue;
      is_whole = is_whole && fits(items, i);
      items.push_back(i);
    }
    for (std::size_t i = 0; i < table.size(); ++i)
      is_whole = is_whole && ((number >> i & 1U) != 0 || !fits(items, i));
    if (is_whole) sets.push_back(items);
  }
  std::ranges::sort(sets);
  std::vector<std::string> letters(table.size());
  char letter = 'a';
  for (const Items& items : sets) {
    for (const std::size_t item : items)
      letters[item] += letter;
    ++letter;
  }
  return letters;
}

TEST(Letters, AreSharedExactlyByThoseThatDoNotDiffer) {
  EXPECT_THAT(letters_of(different(3, {})), ElementsAre("a", "a", "a"));
  EXPECT_THAT(letters_of(different(3, {{0, 2}})), ElementsAre("a", "ab", "b"));
  EXPECT_THAT(letters_of(different(3, {{0, 1}, {0, 2}, {1, 2}})), ElementsAre("a", "b", "c"));
  // Every table of five.
  for (std::size_t number = 0; number < 1024; ++number) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::size_t bit = 0;
    for (std::size_t a = 0; a < 5; ++a) {
      for (std::size_t b = a + 1; b < 5; ++b, ++bit)
        if ((number >> bit & 1U) != 0) pairs.emplace_back(a, b);
    }
    const Table table = different(5, pairs);
    ASSERT_EQ(letters_of(table), letters_by_definition(table)) << number;
  }
}

TEST(Letters, HaveANumberAfterTheAlphabet) {
  std::vector<std::pair<std::size_t, std::size_t>> all_pairs;
  for (std::size_t b = 1; b < 28; ++b) {
    for (std::size_t a = 0; a < b; ++a)
      all_pairs.emplace_back(a, b);
  }
  const auto letters = letters_of(different(28, all_pairs));
  EXPECT_EQ(letters.front(), "a");
  EXPECT_EQ(letters[25], "z");
  EXPECT_EQ(letters[26], "a2");
  EXPECT_EQ(letters[27], "b2");
}

/// Three methods in two missions: `good` is far ahead of `fair` and `poor`, which are alike.
std::vector<DesignScore> of_three_methods() {
  std::vector<Scored> designs;
  std::int64_t number = 0;
  for (const char* mission : {"aggregation", "grid"}) {
    for (int i = 1; i <= 8; ++i) {
      const auto add = [&](const char* method, double score) {
        designs.push_back({.design = ++number,
                           .mission = mission,
                           .method = method,
                           .repetition = i,
                           .scores = {score, score + 1}});
      };
      add("good", 20.0 + i);
      add("fair", 1.0 * i);
      add("poor", 1.0 * i - 0.25);
    }
  }
  return records_of(designs);
}

TEST(MethodMatrix, SaysWhoWinsWhereByHowMuchAndHowSure) {
  const auto matrices = method_matrices(compare(of_three_methods(), {.by = CompareBy::Method}));
  ASSERT_EQ(matrices.size(), 1U);
  const MethodMatrix& matrix = matrices.front();
  EXPECT_EQ(matrix.source, "rvr");
  EXPECT_THAT(matrix.missions, ElementsAre("aggregation", "grid"));
  ASSERT_EQ(matrix.rows.size(), 3U);
  EXPECT_EQ(matrix.rows[0].method, "good");
  EXPECT_EQ(*matrix.rows[0].mean_rank, 1);
  EXPECT_EQ(matrix.rows[2].method, "poor");
  const MethodMatrix::Cell& best = *matrix.rows[0].cells[1];
  EXPECT_EQ(best.n, 8U);
  EXPECT_EQ(best.runs, 16U);
  EXPECT_DOUBLE_EQ(best.mean, 25);
  EXPECT_NEAR(*best.half_width, 2.0478, 1e-4);  // R: t.test(20.5 + 1:8)
  EXPECT_EQ(best.letters, "a");
  EXPECT_FALSE(best.p_behind);
  const MethodMatrix::Cell& last = *matrix.rows[2].cells[1];
  EXPECT_EQ(last.rank, 3);
  EXPECT_EQ(last.letters, "b");
  EXPECT_DOUBLE_EQ(last.behind, 20.25);
  // R: 3 * wilcox.test(20 + 1:8, 1:8 - 0.25)$p.value; Holm's is over the mission's three pairs.
  EXPECT_NEAR(*last.p_behind, 3 * 2.0 / 12870, 1e-12);
  EXPECT_EQ(matrix.rows[1].cells[0]->letters, "b");
}

// R: 2 / choose(8, 4) = 0.0286 is the least p of four against four.
TEST(MethodMatrix, SaysWhereValuesAreTooFewForOtherLetters) {
  auto scores = of_three_methods();
  EXPECT_THAT(matrix_notes(compare(scores, {.by = CompareBy::Method})), IsEmpty());
  std::erase_if(scores, [](const DesignScore& score) { return score.repetition > 4; });
  const Comparison comparison = compare(scores, {.by = CompareBy::Method});
  EXPECT_THAT(
      matrix_notes(comparison),
      ElementsAre("aggregation, grid: too few values for 3 tests together: after the "
                  "correction even the clearest difference would have a p of 0.0857; a shared "
                  "letter means nothing there"));
  // All six pairs are corrected together there.
  EXPECT_THAT(comparison.pairs.front().notes, Contains(HasSubstr("a p of 0.171")));
}

TEST(MethodMatrix, NotesAreThoseThatConcernTheLetters) {
  const Comparison comparison =
      compare(of_three_methods(), {.by = CompareBy::Method,
                                   .missions = {"grid"},
                                   .choice = {.purpose = "", .unit = ScoreUnit::Run}});
  const std::string of_runs =
      "runs of one design are not independent of each other: these tests overstate the certainty";
  EXPECT_THAT(comparison.notes, ElementsAre(StartsWith("rvr: no ranks"), of_runs));
  EXPECT_THAT(matrix_notes(comparison), ElementsAre(of_runs));
}

TEST(MethodMatrix, CountsTheTestsOfAMissionThatHaveAP) {
  const auto notes_of = [](std::vector<Scored> designs, const std::vector<Scored>& more = {}) {
    designs.insert(designs.end(), more.begin(), more.end());
    return matrix_notes(
        compare(records_of(designs),
                {.by = CompareBy::Method, .choice = {.purpose = "", .unit = ScoreUnit::Design}}));
  };
  EXPECT_THAT(notes_of(two_methods({1, 2, 3, 4}, {5, 6, 7, 8})), IsEmpty());
  EXPECT_THAT(
      notes_of(two_methods({1, 2}, {3, 4})),
      ElementsAre("aggregation: too few values: even the clearest difference would have a p "
                  "of 0.333; a shared letter means nothing there"));
  EXPECT_THAT(notes_of(two_methods({5, 5}, {5, 5})), IsEmpty()) << "no p, so no test";
  // R: 2 / choose(21, 1) = 0.0952; the test of the two methods with equal scores has no p.
  const std::vector<double> same(20, 5);
  EXPECT_THAT(notes_of(two_methods(same, same), designs_of("third", {6}, 2001)),
              ElementsAre("aggregation: too few values for 2 tests together: after the correction "
                          "even the clearest difference would have a p of 0.19; a shared letter "
                          "means nothing there"));
}

TEST(MethodMatrix, OfOneMissionHasRanksAndAPOfTheLevelIsNoDifference) {
  // All 39 values are above the single one: R: wilcox.test(2:40, 1)$p.value is 0.05.
  std::vector<double> many(39);
  std::iota(many.begin(), many.end(), 2.0);
  const Comparison comparison =
      compare(records_of(two_methods({1}, many)), {.by = CompareBy::Method});
  EXPECT_THAT(matrix_notes(comparison),
              Contains(HasSubstr("too few values: even the clearest difference would have a p of "
                                 "0.05; a shared letter means nothing there")));
  const MethodMatrix matrix = method_matrices(comparison).front();
  ASSERT_EQ(matrix.rows.size(), 2U);
  EXPECT_EQ(matrix.rows[0].method, "second");
  EXPECT_EQ(matrix.rows[0].mean_rank, 1);
  EXPECT_EQ(matrix.rows[1].mean_rank, 2);
  EXPECT_EQ(matrix.rows[0].cells[0]->letters, "a");
  EXPECT_EQ(matrix.rows[1].cells[0]->letters, "a");
  EXPECT_EQ(matrix.rows[1].cells[0]->p_behind, 0.05);
}

/// Three methods in two missions; `good` is ahead of two that are alike, and has no scores of the
/// grid. `fair` was also evaluated under another profile.
Comparison of_two_profiles() {
  std::vector<Scored> designs;
  const auto add = [&](const std::string& mission, const std::string& method,
                       const std::vector<double>& values) {
    for (Scored design : designs_of(method, values, std::ssize(designs) + 1)) {
      design.mission = mission;
      design.scores = {design.scores[0] - 1, design.scores[0] + 1};
      designs.push_back(design);
    }
  };
  add("aggregation", "good", {980, 990, 1000, 1010, 1020});
  add("aggregation", "fair", {1, 2, 3, 4, 5});
  add("aggregation", "poor", {5, 4, 3, 2, 1});
  add("grid", "fair", {6, 8});
  add("grid", "poor", {7});
  designs.push_back({.method = "fair", .source = "alpha", .scores = {3}, .purpose = "score"});
  return compare(records_of(designs), {.by = CompareBy::Method});
}

// R 4.2: t.test(c(980, 990, 1000, 1010, 1020)), t.test(1:5) and t.test(c(6, 8)) give these
// intervals, and 3 * wilcox.test(1:5, 980:984)$p.value is 0.0238.
TEST(MethodMatrix, IsATextForEachSourceThatOfTheTestsFirst) {
  EXPECT_EQ(matrices_text(of_two_profiles()),
            "Scores of the designs' winners, larger is better; a value is a design: the mean of "
            "its tests or later runs.\n"
            "\n"
            "rvr\n"
            "method  mean rank  aggregation         grid\n"
            "fair    2.00          3 +- 1.96 2.5 b  7 +- 12.7 1.5 a\n"
            "poor    2.00          3 +- 1.96 2.5 b  7         1.5 a\n"
            "good    -          1000 +- 19.6   1 a  -\n"
            "\n"
            "alpha\n"
            "method  mean rank  aggregation\n"
            "fair    1.00       3  1\n"
            "\n"
            "A cell: mean +- half its 95 % interval, rank, letters. Methods of a mission that "
            "share a letter do\n"
            "not differ at 5 %: Wilcoxon rank-sum tests of its pairs, with Holm's correction. Each "
            "design is a value.\n"
            "grid: too few values: even the clearest difference would have a p of 0.667; a shared "
            "letter means nothing there\n");
}

TEST(MethodMatrix, ShowsAtLeastThreeDigitsOfALargeMean) {
  for (const auto& [mean, shown] :
       std::vector<std::pair<double, std::string>>{{99.96, "100"},
                                                   {999.4, "999"},
                                                   {999.6, "1000"},
                                                   {-999.6, "-1000"},
                                                   {12345.6, "12346"}}) {
    EXPECT_THAT(
        matrices_text(compare(records_of(two_methods({mean}, {0})), {.by = CompareBy::Method})),
        HasSubstr(" " + shown + "  "));
  }
}

TEST(MethodMatrix, IsATableOfCells) {
  EXPECT_EQ(matrices_csv(of_two_profiles()),
            "source,mission,method,n,runs,mean,low,high,"
            "rank,mean_rank,letters,behind,p_behind\n"
            "rvr,aggregation,fair,5,10,3,1.0367568385224415,4.963243161477559,"
            "2.5,2,b,997,0.023809523809523808\n"
            "rvr,aggregation,poor,5,10,3,1.0367568385224415,4.963243161477559,"
            "2.5,2,b,997,0.023809523809523808\n"
            "rvr,aggregation,good,5,10,1000,980.3675683852244,1019.6324316147756,"
            "1,,a,0,\n"
            "rvr,grid,fair,2,4,7,-5.706204736174632,19.706204736174634,"
            "1.5,2,a,0,\n"
            "rvr,grid,poor,1,2,7,,,"
            "1.5,2,a,0,1\n"
            "alpha,aggregation,fair,1,1,3,,,"
            "1,1,,0,\n");
}

TEST(MethodMatrix, IsJsonOfAllCells) {
  EXPECT_EQ(matrices_json(of_two_profiles()).text,
            R"([{"source":"rvr","missions":["aggregation","grid"],"methods":[)"
            R"({"method":"fair","mean_rank":2,"cells":[)"
            R"({"n":5,"runs":10,"mean":3,"low":1.0367568385224415,"high":4.963243161477559,)"
            R"("rank":2.5,"letters":"b","behind":997,"p_behind":0.023809523809523808},)"
            R"({"n":2,"runs":4,"mean":7,"low":-5.706204736174632,"high":19.706204736174634,)"
            R"("rank":1.5,"letters":"a","behind":0,"p_behind":null}]},)"
            R"({"method":"poor","mean_rank":2,"cells":[)"
            R"({"n":5,"runs":10,"mean":3,"low":1.0367568385224415,"high":4.963243161477559,)"
            R"("rank":2.5,"letters":"b","behind":997,"p_behind":0.023809523809523808},)"
            R"({"n":1,"runs":2,"mean":7,"low":null,"high":null,)"
            R"("rank":1.5,"letters":"a","behind":0,"p_behind":1}]},)"
            R"({"method":"good","mean_rank":null,"cells":[)"
            R"({"n":5,"runs":10,"mean":1000,"low":980.3675683852244,"high":1019.6324316147756,)"
            R"("rank":1,"letters":"a","behind":0,"p_behind":null},null]}]},)"
            R"({"source":"alpha","missions":["aggregation"],"methods":[)"
            R"({"method":"fair","mean_rank":1,"cells":[)"
            R"({"n":1,"runs":1,"mean":3,"low":null,"high":null,)"
            R"("rank":1,"letters":"","behind":0,"p_behind":null}]}]}])");
}

}  // namespace
}  // namespace swarmsmith
