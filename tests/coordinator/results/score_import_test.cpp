#include "coordinator/results/score_import.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "storage/answer.h"
#include "storage/store.h"
#include "storage/store_at_rest.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// Two finished designs of one mission, and one that races; d1's candidate c5 won nothing.
ScoreImport known_store() {
  ScoreImport known;
  known.source = "real";
  for (std::int64_t id = 1; id <= 3; ++id) {
    known.designs.push_back({.id = {id},
                             .mission = id == 3 ? "grid_exploration" : "aggregation",
                             .method = "thesis",
                             .repetition = id == 3 ? 1 : id,
                             .name = "tA" + std::to_string(id),
                             .finished = id != 3,
                             .best = id == 3 ? CandidateId{} : candidate_id({id}, 2)});
  }
  known.has_candidate = [](CandidateId candidate) { return candidate == CandidateId{5}; };
  return known;
}

OrErrors<ImportedScores> import(const std::string& csv, const ScoreImport& known = known_store(),
                                const ScoreLedger& ledger = {}) {
  return import_scores(*parse_csv(csv, "r.csv"), known, ledger);
}

std::vector<EvaluationRow> evaluations(const ImportedScores& scores) {
  std::vector<EvaluationRow> rows;
  for (const Row& row : scores.addition.rows)
    if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) rows.push_back(*evaluation);
  return rows;
}

std::vector<std::string> complaints(const std::string& csv,
                                    const ScoreImport& known = known_store(),
                                    const ScoreLedger& ledger = {}) {
  const auto read = import(csv, known, ledger);
  EXPECT_FALSE(read);
  return complaints_of(read);
}

TEST(ScoreImport, SaysWhatADesignIsInsteadOfWhatTheRowSays) {
  EXPECT_THAT(
      complaints("design,mission,method,repetition,score\n"
                 "d1,gather,,,1\n"
                 "d3,aggregation,thesis,2,1\n"
                 "d9,gather,,,1\n"),
      ElementsAre("r.csv:2: the store has no such design: design d1, mission gather; its d1 "
                  "has mission aggregation",
                  "r.csv:3: the store has no such design: design d3, mission aggregation, "
                  "method thesis, repetition 2; its d3 has mission grid_exploration, "
                  "repetition 1",
                  "r.csv:4: the store has no such design: design d9, mission gather"));
}

TEST(ScoreImport, FindsWhoByAnyNameThatIsUnique) {
  const auto scores =
      value_of(import("candidate,design,fsm_id,mission,method,repetition,score\n"
                      "c2,,,,,,1\n"   // a winner
                      "5,d1,,,,,2\n"  // another candidate, without its letter
                      ",d2,,,,,3\n"   // a design's winner
                      ",,tA2,aggregation,,,4\n"
                      ",,,aggregation,thesis,2,5\n"));
  std::vector<std::string> who;
  for (const EvaluationRow& row : evaluations(scores)) {
    EXPECT_EQ(row.source, "real");
    EXPECT_EQ(row.measured.state_digest, 0U);
    who.push_back(to_string(row.key.candidate) + "=" + std::to_string(int(row.measured.score)));
  }
  EXPECT_THAT(who, ElementsAre("c2=1", "c5=2", "c1000002=3", "c1000002=4", "c1000002=5"));
  EXPECT_EQ(scores.added, 5);
}

TEST(ScoreImport, GivesRunsWithoutASeedTheNumbersOfTheirRows) {
  const auto scores = value_of(import("design,score\n1,1\n1,1\n2,4\n"));
  std::vector<std::int64_t> instances;
  for (const Row& row : scores.addition.rows) {
    const auto* pair = std::get_if<PairRow>(&row);
    if (pair == nullptr) continue;
    EXPECT_EQ(pair->seed, 0);
    EXPECT_EQ(pair->purpose, Purpose::Score);
    instances.push_back(pair->instance);
  }
  EXPECT_THAT(instances, ElementsAre(1, 2, 1));
}

TEST(ScoreImport, NumbersAPairForEachSourceInstanceAndSeed) {
  const auto scores = value_of(
      import("candidate,source,seed,score\nc2,real,7,1\nc2,rvr,7,1\nc5,real,7,1\nc2,real,8,1\n"));
  std::vector<std::string> ids;
  for (const EvaluationRow& row : evaluations(scores))
    ids.push_back(to_string(row.key));
  // c5 meets c2 on the same pair.
  EXPECT_THAT(ids, ElementsAre("e200001s", "e200002s", "e500001s", "e200003s"));
}

TEST(ScoreImport, TurnsCostsIntoScores) {
  ScoreImport known = known_store();
  known.missions.renamed["agg"] = "aggregation";
  known.costs_of = {"aggregation"};
  const auto scores =
      value_of(import("mission,repetition,score,cost\nagg,1,3,\nagg,2,,4\n", known));
  EXPECT_EQ(evaluations(scores)[0].measured.score, -3);
  EXPECT_EQ(evaluations(scores)[1].measured.score, -4);
}

TEST(ScoreImport, NamesEveryBadRowByItsLine) {
  EXPECT_THAT(
      complaints("design,candidate,mission,seed,time,score\n"
                 "9,,,1,,1\n"
                 ",,aggregation,1,,1\n"
                 "d3,,,1,,1\n"
                 ",c6,,1,,1\n"
                 "2,c2,,1,,1\n"
                 "1,,,0,,1\n"
                 "1,,,1,,inf\n"
                 "1,,,1,-1,1\n"
                 "1,,,1,,\n"
                 ",,,1,,1\n"
                 "x,,,1,,1\n"
                 "1,,,1,,1e305\n"),
      ElementsAre("r.csv:2: the store has no such design: design d9",
                  "r.csv:3: the row could be of d1 as well as of d2; name the design",
                  "r.csv:4: d3 is not finished and has no winner; name the candidate",
                  "r.csv:5: the store has no candidate c6", "r.csv:6: c2 is of design d1, not d2",
                  "r.csv:7: column seed must be an integer from 1 on, not `0`",
                  "r.csv:8: column score must be a finite number, not `inf`",
                  "r.csv:9: column time must be a number from 0 on, not `-1`",
                  "r.csv:10: the row has no score", HasSubstr("r.csv:11: the row names no design"),
                  "r.csv:12: column design must be d3 or 3, not `x`",
                  "r.csv:13: the score 1e305 is beyond 1e300, where sums of scores are infinite"));
  ScoreImport without_source = known_store();
  without_source.source.clear();
  EXPECT_THAT(complaints("design,score\n1,1\n", without_source),
              ElementsAre(HasSubstr("does not say who made the score")));
  EXPECT_THAT(complaints("design\n1\n"), ElementsAre("r.csv: there is no column score (or cost)"));
}

TEST(ScoreImport, NamesTheLineOfASourceThatIsTooLong) {
  const std::string longest(kLongestName, 'x');
  EXPECT_EQ(value_of(import("design,source,score\n1," + longest + ",1\n")).added, 1);
  EXPECT_THAT(complaints("design,source,score\n1," + longest + "x,1\n"),
              ElementsAre("r.csv:2: the source has 1001 bytes; the limit is 1000"));
  ScoreImport known = known_store();
  known.source = longest + "x";
  EXPECT_THAT(complaints("design,score\n1,1\n", known),
              ElementsAre("r.csv:2: the source has 1001 bytes; the limit is 1000"));
}

TEST(ScoreImport, RefusesMorePairsThanADesignCanHave) {
  ScoreLedger ledger;
  std::vector<Row> ignored;
  for (std::int64_t seed = 1; seed < kPairsPerCandidate; ++seed) {
    ledger.add({.candidate = {2}, .source = "real", .instance = 1, .seed = seed}, {.score = 3},
               ignored);
  }
  EXPECT_THAT(complaints("design,seed,score\n1,99999,3\n1,100000,3\n", known_store(), ledger),
              ElementsAre("r.csv:3: d1 would have scores on 100000 pairs (of source, instance and "
                          "seed); a design can have at most 99999: leave out some of its rows"));
  // Other candidates share the pairs of their design, and other designs have pairs of their own.
  const auto scores = value_of(
      import("candidate,seed,score\nc5,99999,1\nc1000002,100000,1\n", known_store(), ledger));
  std::vector<std::string> ids;
  for (const EvaluationRow& row : evaluations(scores))
    ids.push_back(to_string(row.key));
  EXPECT_THAT(ids, ElementsAre("e599999s", "e100000200001s"));
}

TEST(ScoreLedger, ReadsMoreScoresThanAUsersQueryWouldGet) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "s.db";
  // Long names make the answer longer than 128 MiB with fewer rows.
  const std::string source(kLongestName, 'x');
  const std::vector<CandidateId> candidates{{1}, {2}};
  constexpr std::int64_t kPairs = 60'000;
  Addition addition{
      .campaign = CampaignRow{.name = "c", .digest = "x", .deciding = "{}", .file = "", .seed = 0},
      .designs = {{.row = {.id = {1}, .mission = "m", .method = "by hand", .repetition = 1},
                   .name = ""}},
      .removed = {},
      .rows = {},
      .profiles = {}};
  for (const CandidateId candidate : candidates)
    addition.rows.emplace_back(
        CandidateRow{.id = candidate, .parameters = "{}", .machine = "x", .modules = "{}"});
  ScoreLedger made;
  for (std::int64_t seed = 1; seed <= kPairs; ++seed) {
    for (const CandidateId candidate : candidates) {
      const EvaluationKey key =
          made.add({.candidate = candidate, .source = source, .instance = 1, .seed = seed},
                   {.score = 1}, addition.rows);
      addition.rows.emplace_back(
          EvaluationRow{.key = key, .measured = {.score = 1}, .source = source});
    }
  }
  ASSERT_TRUE(value_of(StoreAtRest::open(file, StoreAtRest::IfMissing::Make))->add(addition));
  const auto reader = value_of(StoreReader::open(file));
  const auto read = ScoreLedger::read(*reader);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_NE(read->find({.candidate = {2}, .source = source, .instance = 1, .seed = kPairs}),
            nullptr);
}

TEST(ScoreImport, KnowsAScoreAgainAndRefusesAnother) {
  ScoreLedger ledger;
  std::vector<Row> ignored;
  const EvaluationKey key = ledger.add(
      {.candidate = {2}, .source = "real", .instance = 1, .seed = 7}, {.score = 3}, ignored);
  const auto same = value_of(import("design,seed,score\n1,7,3\n", known_store(), ledger));
  EXPECT_EQ(same.known, 1);
  EXPECT_THAT(same.addition.rows, IsEmpty());
  EXPECT_THAT(complaints("design,seed,score\n1,7,4\n", known_store(), ledger),
              ElementsAre("r.csv:2: the score 4 of c2 (real, seed 7) is 3 in the store, e200001s; "
                          "--replace takes the new one"));
  ScoreImport replacing = known_store();
  replacing.replace = true;
  const auto other = value_of(import("design,seed,score\n1,7,4\n", replacing, ledger));
  EXPECT_EQ(other.replaced, 1);
  EXPECT_THAT(other.addition.removed, ElementsAre(key));
  EXPECT_EQ(evaluations(other).front().key, key);
}

TEST(ScoreImport, TakesTwoRowsOfOnePlaceOnlyWhenTheyAgree) {
  const auto scores = value_of(import("design,seed,score\n1,7,3\n1,7,3\n"));
  EXPECT_EQ(scores.added, 1);
  ScoreImport replacing = known_store();
  replacing.replace = true;
  EXPECT_THAT(complaints("design,seed,score\n1,7,3\n1,7,4\n", replacing),
              ElementsAre("r.csv:3: the score 4 of c2 (real, seed 7) is 3 in r.csv:2"));
}

TEST(ScoreImport, KeepsNotesAndSaysWhatItDoesNotRead) {
  const auto scores =
      value_of(import("design,score,note,weather\n1,3,\"robot \"\"2\"\" fell\",fine\n"));
  EXPECT_THAT(scores.not_read, ElementsAre("weather"));
  const auto& note = std::get<EventRow>(scores.addition.rows.back());
  EXPECT_EQ(note.text, R"({"evaluation":"e200001s","note":"robot \"2\" fell"})");
}

TEST(ScoreImport, ANoteThatIsNotUtf8IsStoredAsJson) {
  const auto scores = value_of(import("design,score,note\n1,3,caf\xe9\n"));
  EXPECT_EQ(std::get<EventRow>(scores.addition.rows.back()).text,
            "{\"evaluation\":\"e200001s\",\"note\":\"caf\xef\xbf\xbd\"}");
}

TEST(MissionWords, NameOneForAllAndRenameOthers) {
  const auto words = value_of(read_mission_words({"grid=grid_exploration", "aggregation"}));
  EXPECT_EQ(words.name_of("grid"), "grid_exploration");
  EXPECT_EQ(words.name_of("color"), "color");
  EXPECT_EQ(words.name_of(""), "aggregation");
  for (const auto& wrong :
       std::vector<std::vector<std::string>>{{"a", "b"}, {"a=b", "a=c"}, {"=b"}, {"a="}})
    EXPECT_FALSE(read_mission_words(wrong)) << wrong.front();
}

TEST(MissionWords, NameFilesOfMissions) {
  const TemporaryFolder folder;
  const std::string file = (folder / "cave.toml").string();
  std::ofstream(file) << "format = 1\nname = \"cave\"\npreset = \"aggregation\"\nrobots = 5\n";
  const auto one = value_of(read_mission_words({"hole=" + file}));
  EXPECT_EQ(one.name_of("hole"), "cave");
  EXPECT_EQ(one.name_of("shelter"), "shelter");
  ASSERT_EQ(one.of_files.size(), 1U);
  EXPECT_EQ(one.of_files[0].mission.robots, 5);
  const auto all = value_of(read_mission_words({file}));
  EXPECT_EQ(all.name_of(""), "cave");
  EXPECT_EQ(all.name_of("hole"), "cave");
  EXPECT_THAT(complaint_of(read_mission_words({(folder / "none.toml").string()})),
              HasSubstr("none.toml"));
}

}  // namespace
}  // namespace swarmsmith
