#include "analysis/comparison/method_matrix.h"

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

bool share_a_letter(const std::string& a, const std::string& b) {
  return a.find_first_of(b) != std::string::npos;
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
    const auto letters = letters_of(table);
    for (std::size_t a = 0; a < 5; ++a) {
      for (std::size_t b = 0; b < 5; ++b)
        ASSERT_EQ(share_a_letter(letters[a], letters[b]), !table[a][b]) << number;
    }
  }
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

TEST(MethodMatrix, LeavesOpenWhatAMissionLacks) {
  auto scores = of_three_methods();
  std::erase_if(scores, [](const DesignScore& score) {
    return score.mission == "grid" && score.method == "good";
  });
  const Comparison comparison = compare(scores, {.by = CompareBy::Method});
  const auto matrix = method_matrices(comparison).front();
  EXPECT_EQ(matrix.rows.back().method, "good");  // it has no mean rank
  EXPECT_FALSE(matrix.rows.back().mean_rank);
  EXPECT_FALSE(matrix.rows.back().cells[1]);
  EXPECT_THAT(matrices_text(comparison), HasSubstr("good    -"));
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

TEST(MethodMatrix, OfOneMethodHasNoLetters) {
  const auto matrices =
      method_matrices(compare(records_of({{.design = 1, .scores = {1, 2}},
                                          {.design = 2, .repetition = 2, .scores = {3, 4}}}),
                              {.by = CompareBy::Method}));
  EXPECT_THAT(matrices.front().rows.front().cells.front()->letters, IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
