#include <filesystem>
#include <string>
#include <vector>

#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/synthetic_real_run.h"

namespace swarmsmith {
namespace {

using Cells = std::vector<std::string>;

/// A store that the program of an earlier schema wrote (tests/golden/stores/README.md).
struct OldStore {
  std::int64_t schema;
  const char* digest;
  std::size_t evaluations;

  friend void PrintTo(const OldStore& old, std::ostream* out) { *out << "schema " << old.schema; }
};

constexpr OldStore kOldStores[] = {
    {1, "c1ab46cfade6d60d3caa2324616eca67", 251}, {2, "5edcb3cb406469e4e5ce487520d2afe4", 253},
    {3, "8541a7690103a070b99e928c2d645e00", 315}, {4, "2dadc34b67eb86042a33ff0d797d04c4", 259},
    {6, "2dadc34b67eb86042a33ff0d797d04c4", 256}, {9, "2dadc34b67eb86042a33ff0d797d04c4", 256}};

/// Real runs that it holds.
std::size_t real_runs_of(const OldStore& old) {
  return old.schema == 9 ? 1 : 0;
}

struct MigrationTest : testing::TestWithParam<OldStore> {
  const OldStore& old = GetParam();
  TemporaryFolder folder;
  std::filesystem::path path = folder / "old.db";

  MigrationTest() {
    const std::string name = "/stores/schema-" + std::to_string(old.schema) + ".sqlite";
    std::filesystem::copy_file(SWARMSMITH_TEST_DATA + name, path);
  }
  /// As the campaign that made it would: its row is compared by its digest alone.
  std::unique_ptr<Store> opened_for_writing() {
    SyntheticCampaign campaign;
    campaign.campaign = open_reader(path)->campaign();
    return open_store(path, campaign);
  }
  std::string schema_of(const std::filesystem::path& file) {
    sqlite::Connection connection(file.string(), SQLITE_OPEN_READONLY);
    connection.allow_views(true);
    return sqlite::text_of(connection,
                           "SELECT group_concat(name || ' ' || columns, '; ') FROM (SELECT s.name,"
                           " (SELECT group_concat(i.name || ' ' || i.type || ' ' || i.\"notnull\""
                           " || ' ' || i.pk) FROM pragma_table_info(s.name) AS i) AS columns"
                           " FROM sqlite_schema AS s WHERE s.type IN ('table', 'view')"
                           " ORDER BY s.name)");
  }
};

TEST_P(MigrationTest, AnOldStoreIsReadAsItIs) {
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->digest(), old.digest);
  EXPECT_EQ(reader->scores().size(), old.evaluations);
  EXPECT_EQ(reader->real_runs().size(), real_runs_of(old));
  EXPECT_TRUE(reader->integrity().empty());
  EXPECT_EQ(cells_of(*reader, "PRAGMA user_version").front(), Cells{std::to_string(old.schema)});
}

TEST_P(MigrationTest, WhatWasAnswerIsTheSameAnswerAfterwards) {
  std::size_t rows = open_reader(path)->answer_rows().size();
  opened_for_writing().reset();
  const auto reader = open_reader(path);
  EXPECT_EQ(cells_of(*reader, "PRAGMA user_version").front(),
            Cells{std::to_string(kSchemaVersion)});
  EXPECT_EQ(reader->digest(), old.digest);
  EXPECT_EQ(reader->answer_rows().size(), rows);
  EXPECT_EQ(reader->scores().size(), old.evaluations);
  EXPECT_TRUE(reader->integrity().empty());
  const auto before = open_reader(path.string() + ".before-v" + std::to_string(kSchemaVersion));
  EXPECT_EQ(before->digest(), old.digest);
}

TEST_P(MigrationTest, GivesTheTablesAndViewsOfANewStore) {
  opened_for_writing().reset();
  open_store(folder / "new.db", synthetic_campaign({.designs = 1, .iterations = 1})).reset();
  const std::string migrated = schema_of(path);
  EXPECT_THAT(migrated, HasSubstr("postselection INTEGER"));
  EXPECT_EQ(migrated, schema_of(folder / "new.db"));
}

TEST_P(MigrationTest, AMigratedStoreTakesTheRowsOfTargets) {
  const auto store = opened_for_writing();
  EvaluationRow row;
  row.key = {candidate_id({1}, 1), Purpose::Evaluator, 1};
  row.source = "command";
  row.measured.time = 2;
  EliminationRow again{.candidate = candidate_id({1}, 1), .iteration = 99, .reason = "test"};
  FailureRow failure{.key = row.key, .reason = "no output"};
  store->append({Row(row), Row(again), Row(failure)});
  store->flush();
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT time FROM v_evaluations WHERE id LIKE '%v'"),
            (std::vector<Cells>{{"2"}}));
}

TEST_P(MigrationTest, AMigratedStoreTakesCommandsAndAttempts) {
  {
    const auto store = opened_for_writing();
    const EvaluationKey key{candidate_id({1}, 1), Purpose::Race, 1};
    CommandRow command{
        .number = 1, .kind = CommandKind::Extend, .design = {1}, .budget = 200, .who = "a@b"};
    store->append({Row(AttemptRow{.key = key, .held_ms = 12, .outcome = AttemptOutcome::Lost}),
                   Row(command)});
    command.step = 7;
    store->append({Row(command)});
    store->flush();
    ASSERT_EQ(store->commands().size(), 1U);
    EXPECT_EQ(store->commands()[0].step, 7);
  }
  const auto reader = open_reader(path);
  EXPECT_EQ(cells_of(*reader, "SELECT outcome, held_ms FROM v_attempts WHERE outcome = 'lost'"),
            (std::vector<Cells>{{"lost", "12"}}));
  EXPECT_NE(reader->digest(), old.digest) << "an extension that acted is part of the answer";
}

TEST_P(MigrationTest, AMigratedStoreTakesRealRuns) {
  opened_for_writing().reset();
  const std::size_t before = real_runs_of(old);
  ASSERT_EQ(open_reader(path)->real_runs().size(), before);
  const RealRunRows rows = synthetic_real_run(1, candidate_id({1}, 1));
  ASSERT_TRUE((*StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse))->add_real_run(rows));
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->digest(), old.digest);
  const RealRunId id{static_cast<std::int64_t>(before) + 1};
  EXPECT_EQ(reader->real_run(id)->cycles, rows.cycles);
  EXPECT_EQ(reader->real_run(id)->log_cycles, rows.log_cycles);
  EXPECT_EQ(reader->real_run(id)->checks, rows.checks);
  EXPECT_EQ(cells_of(*reader, "SELECT score FROM v_evaluations WHERE id = '" + to_string(id) + "'"),
            (std::vector<Cells>{{"1.25"}}));
}

TEST(OldRealRuns, OfBeforeRobotsHadLogsStayAsTheyWere) {
  const TemporaryFolder folder;
  const auto path = folder / "old.db";
  std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-9.sqlite", path);
  const auto before = value_of(open_reader(path)->real_run({1}));
  EXPECT_FALSE(before.samples.empty());
  EXPECT_TRUE(before.logs.empty());
  EXPECT_TRUE(before.checks.empty());
  (*StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse)).reset();
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->schema(), kSchemaVersion);
  EXPECT_EQ(*reader->real_run({1}), before);
  EXPECT_TRUE(reader->integrity().empty());
}

TEST(OldRealRuns, SayHowTheirLogsCouldBeAskedFor) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-9.sqlite", folder / "old.db");
  const auto end = open_reader(folder / "old.db")
                       ->query(
                           "SELECT * FROM v_real_logs", {}, [](const auto&) {}, [](const auto&) {});
  ASSERT_FALSE(end);
  EXPECT_THAT(end.error().message,
              HasSubstr("this store has schema 9; `swarmsmith backup old.db new.db`"));
}

TEST(OldViews, AStoreThatLacksViewsAloneIsReadThroughTheNewOnes) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-6.sqlite", folder / "old.db");
  const auto reader = open_reader(folder / "old.db");
  EXPECT_EQ(cells_of(*reader, "SELECT count(*) > 0 FROM v_transitions"),
            (std::vector<Cells>{{"1"}}));
  EXPECT_EQ(cells_of(*reader, "SELECT count(*) FROM v_module_frequency WHERE avg_reachable > 0"),
            cells_of(*reader, "SELECT count(*) FROM v_module_frequency"));
  EXPECT_EQ(cells_of(*reader, "PRAGMA user_version"), (std::vector<Cells>{{"6"}}));
}

TEST(OldViews, StayAsTheyAreWithoutAStepToALaterSchema) {
  const TemporaryFolder folder;
  const auto path = folder / "old.db";
  std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-6.sqlite", path);
  const std::string before = whole_file(path);
  {
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
    migrate(connection, path, {});
    migrate(connection, path, migrations().first(5));  // to schema 6
  }
  EXPECT_EQ(whole_file(path), before);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".before-v6"));
}

TEST(OldStores, HaveCommandsFromTheThirdSchemaOn) {
  for (const int schema : {2, 3}) {
    const auto reader = open_reader(std::string(SWARMSMITH_TEST_DATA) + "/stores/schema-" +
                                    std::to_string(schema) + ".sqlite");
    const auto tables = cells_of(*reader, "PRAGMA table_info(command)");
    EXPECT_EQ(tables.empty(), schema == 2);
    EXPECT_EQ(reader->commands().empty(),
              schema == 2 || cells_of(*reader, "SELECT count(*) FROM command")[0][0] == "0");
  }
}

TEST(OldStores, HaveShortTextsInTheColumnsOfTheirSchema) {
  const TemporaryFolder folder;
  for (const char* column : {"flavour", "name", "mission"}) {
    const auto path = folder / (std::string(column) + ".db");
    std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-4.sqlite", path);
    const auto set = [&](int bytes) {
      sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE)
          .execute("UPDATE design SET " + std::string(column) + " = printf('%." +
                   std::to_string(bytes) + "c', 'x')");
    };
    set(1000);
    EXPECT_TRUE(StoreReader::open(path));
    set(1001);
    EXPECT_EQ(why_not(StoreReader::open(path)).message,
              "a " + std::string(column) +
                  " in the store's table design has 1001 bytes; the limit is 1000");
  }
}

INSTANTIATE_TEST_SUITE_P(Schema, MigrationTest, testing::ValuesIn(kOldStores),
                         [](const auto& store) { return std::to_string(store.param.schema); });

}  // namespace
}  // namespace swarmsmith
