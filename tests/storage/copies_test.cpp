#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "storage/backup.h"
#include "storage/internal/sqlite.h"
#include "storage/merge.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/synthetic_real_run.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using Cells = std::vector<std::string>;

const auto kUnwatched = [](std::int64_t, std::int64_t) {};

std::string old_store(int schema) {
  return std::string(SWARMSMITH_TEST_DATA) + "/stores/schema-" + std::to_string(schema) + ".sqlite";
}

/// A campaign with a row in every table.
SyntheticCampaign campaign_of_all_kinds(std::uint64_t seed, std::int64_t designs) {
  SyntheticCampaign made = synthetic_campaign({.designs = designs, .iterations = 2}, seed);
  made.campaign.name = "campaign " + std::to_string(seed);
  made.campaign.digest = "digest " + std::to_string(seed);
  const EvaluationKey key{candidate_id({designs}, 2), Purpose::Race, 1};
  std::vector<Row> rows;
  for (std::int64_t worker = 1; worker <= 2; ++worker) {
    WorkerRow row;
    row.id = worker;
    row.host = "host of " + std::to_string(seed);
    row.state = WorkerState::Left;
    rows.emplace_back(row);
  }
  EvaluationRow scored;
  scored.key = {candidate_id({designs}, 1), Purpose::Score, 1};
  scored.source = "source of " + std::to_string(seed);
  scored.worker = 2;
  rows.emplace_back(PairRow{.design = {designs}, .purpose = Purpose::Score, .number = 1});
  rows.emplace_back(scored);
  rows.emplace_back(ConflictRow{.key = key, .other_score = 3, .other_worker = 2});
  rows.emplace_back(FailureRow{.key = key, .worker = 1, .reason = "no output"});
  rows.emplace_back(AttemptRow{.key = key, .worker = 2, .outcome = AttemptOutcome::Lost});
  rows.emplace_back(EventRow{.severity = "info", .kind = "look-ahead", .text = "{}"});
  rows.emplace_back(CommandRow{
      .number = 1, .kind = CommandKind::Extend, .design = {designs}, .step = 3, .budget = 10});
  made.batches.push_back(std::move(rows));
  return made;
}

void write_store(const fs::path& path, const SyntheticCampaign& campaign) {
  fill_store(path, campaign);
  const auto designs = static_cast<std::int64_t>(campaign.designs.size());
  const auto store = value_of(StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse));
  for (std::int64_t run = 1; run <= designs; ++run) {
    const auto number = static_cast<std::uint64_t>(campaign.campaign.seed * 100 + run);
    ASSERT_TRUE(store->add_real_run(synthetic_real_run(number, candidate_id({run}, 1), 5)));
    ASSERT_TRUE(store->add_override({{run}, "DEGRADED", "ada", "x"}));
  }
}

struct CopiesTest : testing::Test {
  TemporaryFolder folder;
  fs::path a = folder / "a.db", b = folder / "b.db", out = folder / "out.db";

  std::vector<std::string> files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "."))
      names.push_back(entry.path().filename().string());
    return names;
  }
};

TEST_F(CopiesTest, ABackupIsTheWholeStoreAlsoWhileItIsWritten) {
  const SyntheticCampaign campaign = campaign_of_all_kinds(1, 2);
  const auto store = open_store(a, campaign);
  store->append(campaign.batches[0]);
  store->flush();  // in the log, and not in the file
  std::int64_t told = 0;
  const auto made = back_up(a, out, [&](std::int64_t done, std::int64_t of) {
    // What comes while pages are copied is not in the copy.
    if (told++ == 0) {
      store->append(campaign.batches[1]);
      store->flush();
    }
    EXPECT_LE(done, of);
  });
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_GT(told, 0);
  EXPECT_EQ(digest_of(out), made->digest);
  EXPECT_EQ(made->digest, digest_after(campaign, {campaign.batches[0]}));
  EXPECT_NE(made->digest, digest_of(a));
  EXPECT_TRUE(open_reader(out)->integrity().empty());
  EXPECT_FALSE(fs::exists(out.string() + "-wal") && fs::file_size(out.string() + "-wal") > 0);
}

TEST_F(CopiesTest, ABackupHasNoSecretOfACampaignThatGoesOn) {
  const SyntheticCampaign campaign = campaign_of_all_kinds(1, 1);
  const std::string secret = "the quick brown fox jumps over it";
  const auto store = open_store(a, campaign);
  store->append(campaign.batches[0]);
  store->flush();
  EXPECT_EQ(store->keep_secret(secret), secret);
  const auto made = back_up(a, out, kUnwatched);
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_THAT(whole_file(out), Not(HasSubstr(secret)));
  EXPECT_EQ(store->keep_secret("another"), secret) << "the campaign keeps its own";
}

TEST_F(CopiesTest, ABackupOverwritesNothingAndLeavesNothingBehind) {
  write_store(a, campaign_of_all_kinds(1, 1));
  std::ofstream(out) << "mine";
  EXPECT_THAT(complaint_of(back_up(a, out, kUnwatched)), HasSubstr("nothing is overwritten"));
  EXPECT_EQ(fs::file_size(out), 4U);
  EXPECT_FALSE(back_up(folder / "none.db", folder / "copy.db", kUnwatched));
  EXPECT_THAT(files(), Not(Contains(HasSubstr(".part"))));
}

TEST_F(CopiesTest, ABackupOfADamagedStoreIsRefusedWithAWayOut) {
  write_store(a, campaign_of_all_kinds(1, 2));
  const auto size = fs::file_size(a);
  {
    std::fstream file(a, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(size / 8192 / 2 * 8192));
    file << std::string(8192, 'x');
  }
  const Error refused = why_not(back_up(a, out, kUnwatched));
  EXPECT_EQ(refused.kind, ErrorKind::Corrupt);
  EXPECT_THAT(refused.message, HasSubstr("swarmsmith recover"));
  EXPECT_FALSE(fs::exists(out));
}

struct OldStores : CopiesTest, testing::WithParamInterface<int> {};

TEST_P(OldStores, ABackupMigratesTheCopyAndNotTheOriginal) {
  const std::string digest = open_reader(old_store(GetParam()))->digest();
  const auto made = value_of(back_up(old_store(GetParam()), out, kUnwatched));
  EXPECT_EQ(made.migrated, GetParam());
  EXPECT_EQ(made.digest, digest);
  const auto copy = open_reader(out);
  EXPECT_EQ(copy->digest(), digest);
  EXPECT_EQ(copy->schema(), made.schema);
  EXPECT_TRUE(copy->integrity().empty());
  EXPECT_EQ(cells_of(*copy, "SELECT campaign FROM v_designs").front(), Cells{"1"});
  EXPECT_EQ(open_reader(old_store(GetParam()))->schema(), GetParam());
}

TEST_P(OldStores, AQueryThatAnOldStoreCannotAnswerSaysHowItCould) {
  fs::copy_file(old_store(GetParam()), a);
  const auto reader = open_reader(a);
  const auto end = reader->query(
      "SELECT id FROM v_real_runs", {}, [](const auto&) {}, [](const auto&) {});
  ASSERT_FALSE(end);
  EXPECT_THAT(end.error().message,
              HasSubstr("this store has schema " + std::to_string(GetParam()) +
                        "; `swarmsmith backup a.db new.db` makes a copy with schema"));
}

TEST_P(OldStores, AreMergedAsTheyAre) {
  write_store(b, campaign_of_all_kinds(2, 2));
  const auto merged = merge_stores({b, old_store(GetParam())}, out, kUnwatched);
  ASSERT_TRUE(merged) << to_string(merged.error());
  const auto reader = open_reader(out);
  EXPECT_EQ(reader->alone(1)->digest(), digest_of(b));
  EXPECT_EQ(reader->alone(2)->digest(), open_reader(old_store(GetParam()))->digest());
}

INSTANTIATE_TEST_SUITE_P(Schema, OldStores, testing::Values(1, 2, 3, 4));

struct MergeTest : CopiesTest {
  void SetUp() override {
    write_store(a, campaign_of_all_kinds(1, 2));
    write_store(b, campaign_of_all_kinds(2, 3));
  }
  std::int64_t count(const fs::path& store, const std::string& table) {
    return std::stoll(cells_of(*open_reader(store), "SELECT count(*) FROM " + table)[0][0]);
  }
};

TEST_F(MergeTest, KeepsEachCampaignsAnswerAndEveryRow) {
  const auto merged = value_of(merge_stores({a, b}, out, kUnwatched));
  const auto reader = open_reader(out);
  ASSERT_EQ(reader->campaigns().size(), 2U);
  EXPECT_EQ(reader->alone(1)->digest(), digest_of(a));
  EXPECT_EQ(reader->alone(2)->digest(), digest_of(b));
  EXPECT_EQ(reader->digest(), merged.digest);
  EXPECT_TRUE(reader->integrity().empty());
  EXPECT_EQ(reader->designs().size(), 5U);
  EXPECT_EQ(reader->commands().size(), 2U);
  EXPECT_EQ(reader->scores().size(),
            open_reader(a)->scores().size() + open_reader(b)->scores().size());
  EXPECT_EQ(reader->alone(2)->scores().size(), open_reader(b)->scores().size());
  EXPECT_THROW(reader->alone(3), std::invalid_argument);
  // A table that is new in the schema must be merged, too.
  for (const Cells& table :
       cells_of(*reader, "SELECT name FROM sqlite_schema WHERE type = 'table'")) {
    // What rows are written with, and no rows themselves.
    if (table[0] == "meta" || table[0] == "source" || table[0] == "phrase") continue;
    EXPECT_GT(count(a, table[0]), 0) << table[0];
    // Both stores' runs name the same ones of these, but for the places.
    if (table[0] == "calibration") continue;
    EXPECT_EQ(count(out, table[0]), count(a, table[0]) + count(b, table[0])) << table[0];
  }
}

TEST_F(MergeTest, EventsNameTheSameThings) {
  {
    const auto reader = open_reader(b);
    const auto store = Store::open(b, reader->campaign(), reader->designs()).value();
    store->append({event_row("warning", "evaluation rejected",
                             {{"evaluation", std::string("c2000007 on pair 6")},
                              {"worker", std::int64_t{1}}}),
                   event_row("warning", "race",
                             {{"design", std::string("d3")}, {"text", std::string("t")}})});
    store->flush();
  }
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  EXPECT_EQ(cells_of(*open_reader(out), "SELECT text FROM event ORDER BY seq DESC LIMIT 2"),
            (std::vector<Cells>{{R"({"design":"d5","text":"t"})"},
                                {R"({"evaluation":"c4000007 on pair 6","worker":3})"}}));
}

TEST_F(MergeTest, NotesOfScoresNameTheSameScores) {
  for (const fs::path& path : {a, b}) {
    const auto reader = open_reader(path);
    const auto store = Store::open(path, reader->campaign(), reader->designs()).value();
    for (const char* id : {"e100000700007s", "e100000700008"}) {
      store->append({event_row("info", "note",
                               {{"evaluation", std::string(id)}, {"note", std::string("e1 c1")}})});
    }
    store->flush();
  }
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  EXPECT_EQ(cells_of(*open_reader(out), "SELECT text FROM event WHERE kind = 'note' ORDER BY seq"),
            (std::vector<Cells>{{R"({"evaluation":"e100000700007s","note":"e1 c1"})"},
                                {R"({"evaluation":"e100000700008","note":"e1 c1"})"},
                                {R"({"evaluation":"e300000700007s","note":"e1 c1"})"},
                                {R"({"evaluation":"e300000700008","note":"e1 c1"})"}}));
}

TEST_F(MergeTest, RenumbersWhatTheRowsName) {
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  const auto reader = open_reader(out);
  EXPECT_EQ(cells_of(*reader, "SELECT campaign, name, designs FROM v_campaign_status"),
            (std::vector<Cells>{{"1", "campaign 1", "2"}, {"2", "campaign 2", "3"}}));
  EXPECT_EQ(cells_of(*reader, "SELECT design, campaign FROM v_designs"),
            (std::vector<Cells>{{"1", "1"}, {"2", "1"}, {"3", "2"}, {"4", "2"}, {"5", "2"}}));
  EXPECT_EQ(cells_of(*reader,
                     "SELECT candidate, source, worker FROM v_evaluations"
                     " WHERE purpose = 'score' AND source <> 'real'"),
            (std::vector<Cells>{{"1000001", "source of 1", "2"}, {"4000001", "source of 2", "4"}}));
  EXPECT_EQ(cells_of(*reader, "SELECT candidate, host FROM v_attempts"),
            (std::vector<Cells>{{"1000002", "host of 1"}, {"4000002", "host of 2"}}));
  EXPECT_EQ(cells_of(*reader, "SELECT number, design FROM v_commands"),
            (std::vector<Cells>{{"1", "2"}, {"2", "5"}}));
  EXPECT_EQ(cells_of(*reader,
                     "SELECT count(*) FROM v_candidates AS c JOIN v_candidates AS p"
                     " ON p.candidate = c.parent WHERE p.design <> c.design")[0][0],
            "0");
  const auto campaign = value_of(reader->campaign_of({4}));
  EXPECT_EQ(campaign.row.name, "campaign 2");
  EXPECT_FALSE(reader->campaign_of({6}));
  EXPECT_EQ(reader->alone(2)->designs().front().id, DesignId{1});
  EXPECT_EQ(reader->alone(2)->commands().front().design, DesignId{3});
}

TEST_F(MergeTest, RealRunsAndTheirCandidatesMoveAndNoneComesTwice) {
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  const auto reader = open_reader(out);
  const auto heads = reader->real_runs();
  ASSERT_EQ(heads.size(), 5U);
  EXPECT_EQ(heads[2].id, RealRunId{3});
  EXPECT_EQ(heads[2].candidate, candidate_id({3}, 1));
  EXPECT_EQ(heads[2].verdict, "DEGRADED");
  RealRunRows moved = *reader->real_run({4});
  moved.candidate = candidate_id({2}, 1);
  EXPECT_EQ(moved, *open_reader(b)->real_run({2}));
  EXPECT_EQ(reader->alone(2)->real_runs().size(), 3U);
  EXPECT_EQ(reader->alone(2)->real_runs().front().candidate, candidate_id({1}, 1));
  // Of another campaign, with a run that is in b already.
  const fs::path c = folder / "c.db";
  write_store(c, campaign_of_all_kinds(3, 2));
  ASSERT_TRUE((*StoreAtRest::open(c, StoreAtRest::IfMissing::Refuse))
                  ->add_real_run(*open_reader(b)->real_run({2})));
  EXPECT_THAT(complaint_of(merge_stores({b, c}, folder / "all.db", kUnwatched)),
              HasSubstr("its real run r3 is the same as r2 of the stores before it"));
  EXPECT_FALSE(fs::exists(folder / "all.db"));
}

/// It may show several runs, so that only a person can tell.
TEST_F(MergeTest, WarnsOfAFilmWithSeveralStarts) {
  EXPECT_THAT(value_of(merge_stores({a, b}, out, kUnwatched)).warnings, IsEmpty());
  const fs::path c = folder / "c.db";
  write_store(c, campaign_of_all_kinds(3, 2));
  RealRunRows twin = *open_reader(b)->real_run({2});
  twin.key = "another start";
  const auto written = (*StoreAtRest::open(c, StoreAtRest::IfMissing::Refuse))->add_real_run(twin);
  ASSERT_TRUE(written) << to_string(written.error());
  const auto merged = value_of(merge_stores({b, c}, folder / "all.db", kUnwatched));
  EXPECT_THAT(merged.warnings,
              ElementsAre(AllOf(
                  HasSubstr("c.db: its real run r3 (now r6) is of the film of r2, "),
                  HasSubstr("with another start"),
                  HasSubstr("track override r6 --verdict invalid --who NAME --reason TEXT"))));
}

TEST_F(MergeTest, MergedStoresCanBeMergedAndTheOrderDoesNotChangeTheDigest) {
  const fs::path c = folder / "c.db";
  const fs::path all = folder / "all.db";
  const fs::path other = folder / "other.db";
  write_store(c, campaign_of_all_kinds(3, 1));
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  const auto one = value_of(merge_stores({c, out}, all, kUnwatched));
  const auto two = value_of(merge_stores({b, a, c}, other, kUnwatched));
  EXPECT_EQ(one.digest, two.digest);
  EXPECT_EQ(open_reader(all)->alone(3)->digest(), digest_of(b));
  EXPECT_NE(one.digest, digest_of(out));
}

TEST_F(MergeTest, ClearsWhatKilledCopiesHaveLeftAndNothingElse) {
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  ::waitpid(dead, nullptr, 0);
  const std::string part = fmt::format("out.db.part-{}", dead);
  const std::vector<std::string> left{part, part + "-wal", part + ".store-2.part-1"};
  const std::vector<std::string> kept{fmt::format("out.db.part-{}", ::getppid()),
                                      "out.db.part-of-mine", "out.db-part-1",
                                      fmt::format("other.db.part-{}", dead)};
  for (const auto& names : {left, kept}) {
    for (const std::string& name : names)
      std::ofstream(folder / name) << "x";
  }
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  for (const std::string& name : left)
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const std::string& name : kept)
    EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST_F(MergeTest, RefusesTheSameCampaignTwice) {
  const auto merged = merge_stores({a, b, a}, out, kUnwatched);
  ASSERT_FALSE(merged);
  EXPECT_EQ(merged.error().kind, ErrorKind::Conflict);
  EXPECT_THAT(merged.error().message, HasSubstr("a campaign is merged once"));
  EXPECT_THAT(files(), Not(Contains(HasSubstr("out.db"))));
}

TEST_F(MergeTest, KeepsOneFlavourOfEachName) {
  const auto write = [&](const fs::path& path, std::uint64_t seed, int number) {
    SyntheticCampaign made = campaign_of_all_kinds(seed, 1);
    made.campaign.file = fmt::format(
        "format = 1\n[[method]]\nname = \"m\"\n[method.flavour]\nname = \"mine\"\n"
        "base = \"watermelon\"\n[method.flavour.behaviours]\nstop = {{ number = {} }}\n",
        number);
    write_store(path, made);
  };
  write(folder / "c.db", 11, 7);
  write(folder / "d.db", 12, 7);
  write(folder / "e.db", 13, 8);
  ASSERT_TRUE(merge_stores({folder / "c.db", folder / "d.db"}, out, kUnwatched));
  const std::string stops =
      "SELECT number FROM flavour_name WHERE flavour = 'mine' AND name = 'stop'";
  EXPECT_EQ(cells_of(*open_reader(out), stops), (std::vector<Cells>{{"7"}}));
  EXPECT_EQ(cells_of(*open_reader(folder / "e.db"), stops), (std::vector<Cells>{{"8"}}));
  EXPECT_EQ(
      why_not(merge_stores({folder / "c.db", folder / "e.db"}, folder / "all.db", kUnwatched))
          .message,
      "two campaigns have different flavours of the name mine, and a store identifies modules "
      "by it; give one of them another name, or keep them in stores of their own");
}

TEST_F(MergeTest, TakesUnfinishedCampaignsWithAWarning) {
  SyntheticCampaign unfinished = campaign_of_all_kinds(4, 1);
  unfinished.batches.resize(2);
  write_store(folder / "c.db", unfinished);
  const auto merged = value_of(merge_stores({a, folder / "c.db"}, out, kUnwatched));
  EXPECT_THAT(merged.warnings, Contains(HasSubstr("campaign 4 is not finished")));
}

TEST_F(MergeTest, AMergedStoreIsNotWrittenByACampaign) {
  ASSERT_TRUE(merge_stores({a, b}, out, kUnwatched));
  const SyntheticCampaign campaign = campaign_of_all_kinds(1, 2);
  const auto store = Store::open(out, campaign.campaign, campaign.designs);
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().kind, ErrorKind::Conflict);
  EXPECT_THAT(store.error().message, HasSubstr("the store holds 2 campaigns"));
}

}  // namespace
}  // namespace swarmsmith
