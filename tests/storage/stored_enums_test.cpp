// The one table of purposes, and of the other values that stores keep: each of its users, with each
// value.

#include "storage/stored_enums.h"

#include <set>

#include "storage/answer.h"
#include "storage/internal/sqlite.h"
#include "storage/recover.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// A finished design whose winner has an evaluation of each purpose and each status, each on a pair
/// of its own.
struct StoredEnums : testing::Test {
  TemporaryFolder folder;
  const std::filesystem::path file = folder / "all.db";
  const CandidateId winner = candidate_id({1}, 1);
  std::vector<EvaluationRow> evaluations;

  void SetUp() override {
    const SyntheticCampaign campaign =
        synthetic_campaign({.designs = 1, .iterations = 1, .candidates = 4});
    auto store = open_store(file, campaign);
    store->append(
        {CandidateRow{.id = winner, .iteration = 1, .parameters = "{}", .modules = "{}"}});
    for (const Purpose purpose : all_purposes()) {
      for (const EvaluationStatus status : all_statuses())
        add(*store, purpose, status);
    }
    store->append({DesignStateRow{
        .design = {1}, .state = DesignState::Finished, .used = 4, .iteration = 1, .best = winner}});
    const auto flushed = store->flush();
    ASSERT_TRUE(flushed);
  }

  void add(Store& store, Purpose purpose, EvaluationStatus status) {
    const std::int64_t pair =
        900 + 10 * static_cast<std::int64_t>(purpose) + static_cast<std::int64_t>(status);
    const EvaluationRow row{
        .key = {winner, purpose, pair},
        .iteration = purpose == Purpose::Race ? 1 : 0,
        .status = status,
        .measured = {.score = status == EvaluationStatus::Ok ? 2.5 : 0, .state_digest = 7},
        .source = "rvr"};
    store.append(
        {PairRow{.design = {1}, .purpose = purpose, .number = pair, .instance = 1, .seed = pair},
         row, AttemptRow{.key = row.key}, FailureRow{.key = row.key, .reason = "none"}});
    evaluations.push_back(row);
  }

  static bool is_this(const Row& row, const EvaluationKey& key) {
    const auto* evaluation = std::get_if<EvaluationRow>(&row);
    return evaluation != nullptr && evaluation->key == key;
  }
};

TEST_F(StoredEnums, EveryPurposeHasANumberAWordAndALetterOfItsOwn) {
  std::set<std::string_view> words, letters;
  for (const Purpose purpose : all_purposes()) {
    const PurposeFacts facts = *facts_of(purpose);
    EXPECT_TRUE(words.insert(facts.word).second) << facts.word;
    EXPECT_TRUE(letters.insert(facts.letter).second) << facts.word;
    EXPECT_EQ(purpose_of(static_cast<std::int64_t>(purpose)), purpose);
    EXPECT_EQ(purpose_of_word(facts.word), purpose);
    EXPECT_EQ(purpose_of_letter(facts.letter), purpose);
  }
  EXPECT_FALSE(purpose_of(static_cast<std::int64_t>(all_purposes().size())));
  EXPECT_FALSE(purpose_of(-1));
  EXPECT_FALSE(facts_of(static_cast<Purpose>(7)));
}

TEST_F(StoredEnums, TheViewsShowEveryPurposeByItsWordAndLetter) {
  const auto reader = open_reader(file);
  for (const EvaluationRow& row : not_empty(evaluations)) {
    const std::string id = to_string(row.key);
    const PurposeFacts facts = *facts_of(row.key.purpose);
    const auto shown = cells_of(
        *reader, "SELECT purpose, status, seed FROM v_evaluations WHERE id = '" + id + "'");
    ASSERT_EQ(shown.size(), 1U) << id;
    EXPECT_EQ(shown[0],
              (std::vector<std::string>{std::string(facts.word), std::string(word_of(row.status)),
                                        std::to_string(row.key.pair)}));
    EXPECT_EQ(cells_of(*reader, "SELECT 1 FROM v_attempts WHERE id = '" + id + "'").size(), 1U)
        << id;
    const auto failed = cells_of(*reader, "SELECT purpose FROM v_failures WHERE id = '" + id + "'");
    ASSERT_EQ(failed.size(), 1U) << id;
    EXPECT_EQ(failed[0][0], facts.word);
  }
}

TEST_F(StoredEnums, TheViewOfScoresHasThePurposesThatCountThereAndNoOthers) {
  const auto reader = open_reader(file);
  for (const EvaluationRow& row : not_empty(evaluations)) {
    const PurposeFacts facts = *facts_of(row.key.purpose);
    const auto scores = cells_of(*reader, "SELECT purpose FROM v_design_scores WHERE pair = " +
                                              std::to_string(row.key.pair));
    const bool counts = !facts.counts_as.empty() && row.status == EvaluationStatus::Ok;
    ASSERT_EQ(scores.size(), counts ? 1U : 0U) << facts.word;
    if (!counts) continue;
    EXPECT_EQ(scores[0][0], facts.counts_as);
  }
}

TEST_F(StoredEnums, TheAnswerInAStoreIsThatOfTheRows) {
  const auto reader = open_reader(file);
  const std::vector<Row> answer = reader->answer_rows();
  for (const EvaluationRow& row : not_empty(evaluations)) {
    const bool is_there =
        std::ranges::any_of(answer, [&](const Row& each) { return is_this(each, row.key); });
    EXPECT_EQ(is_there, in_answer(row)) << facts_of(row.key.purpose)->word;
    EXPECT_EQ(is_there, facts_of(row.key.purpose)->replay != PurposeFacts::Replay::None);
  }
}

TEST_F(StoredEnums, RecoveryOfASoundStoreKeepsEveryValue) {
  const std::filesystem::path out = folder / "out.db";
  auto recovery = value_of(Recovery::begin(file, out));
  const auto end = value_of(recovery->finish());
  EXPECT_EQ(end.orphans, 0);
  EXPECT_EQ(end.digest, digest_of(file));
  const auto reader = open_reader(out);
  for (const EvaluationRow& row : evaluations) {
    const auto scores = reader->scores();
    EXPECT_TRUE(std::ranges::any_of(scores, [&](const StoredScore& score) {
      return score.key == row.key && score.status == row.status;
    })) << facts_of(row.key.purpose)->word;
  }
}

TEST_F(StoredEnums, RecoveryKeepsEveryStateOfADesign) {
  for (const DesignState state : not_empty(all_design_states())) {
    EXPECT_EQ(design_state_of(word_of(state)), state);
    {
      sqlite::Connection connection(file.string(), SQLITE_OPEN_READWRITE);
      connection.execute("UPDATE design SET state = " + std::to_string(static_cast<int>(state)));
    }
    const std::filesystem::path out = folder / (std::string(word_of(state)) + ".db");
    auto recovery = value_of(Recovery::begin(file, out));
    const auto end = value_of(recovery->finish());
    EXPECT_EQ(end.orphans, 0) << word_of(state);
    EXPECT_EQ(cells_of(*open_reader(out), "SELECT state FROM v_designs")[0][0], word_of(state));
  }
}

TEST_F(StoredEnums, AValueThatNoVersionKnowsIsNoValueOfOurs) {
  {
    sqlite::Connection connection(file.string(), SQLITE_OPEN_READWRITE);
    connection.execute("UPDATE evaluation SET purpose = 7 WHERE purpose = 6");
  }
  const auto reader = open_reader(file);
  try {
    reader->scores();
    FAIL() << "an unknown purpose was read";
  } catch (const StoreFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("the purpose 7, which this version does not know"));
  }
  EXPECT_EQ(to_string(EvaluationKey{winner, static_cast<Purpose>(7), 1}), "e100001?");
}

}  // namespace
}  // namespace swarmsmith
