#include <gmock/gmock.h>

#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"

namespace swarmsmith {
namespace {

using Cells = std::vector<std::string>;

/// A store that the program of schema 1 wrote (tests/golden/stores/README.md).
struct MigrationTest : testing::Test {
  static constexpr const char* kDigest = "c1ab46cfade6d60d3caa2324616eca67";
  static constexpr std::size_t kEvaluations = 251;
  TemporaryFolder folder;
  std::filesystem::path path = folder / "old.db";

  MigrationTest() {
    std::filesystem::copy_file(SWARMSMITH_TEST_DATA "/stores/schema-1.sqlite", path);
  }
  /// As the campaign that made it would: its row is compared by its digest alone.
  std::unique_ptr<Store> opened_for_writing() {
    SyntheticCampaign campaign;
    campaign.campaign = open_reader(path)->campaign();
    return open_store(path, campaign);
  }
  std::string schema_of(const std::filesystem::path& file) {
    const sqlite::Connection connection(file.string(), SQLITE_OPEN_READONLY);
    return sqlite::text_of(connection,
                           "SELECT group_concat(name || ' ' || columns, '; ') FROM (SELECT s.name,"
                           " (SELECT group_concat(i.name || ' ' || i.type || ' ' || i.\"notnull\""
                           " || ' ' || i.pk) FROM pragma_table_info(s.name) AS i) AS columns"
                           " FROM sqlite_schema AS s WHERE s.type IN ('table', 'view')"
                           " ORDER BY s.name)");
  }
};

TEST_F(MigrationTest, AnOldStoreIsReadAsItIs) {
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->digest(), kDigest);
  EXPECT_EQ(reader->scores().size(), kEvaluations);
  EXPECT_TRUE(reader->integrity().empty());
  EXPECT_EQ(cells_of(*reader, "PRAGMA user_version").front(), Cells{"1"});
}

TEST_F(MigrationTest, WhatWasAnswerIsTheSameAnswerAfterwards) {
  std::size_t rows = open_reader(path)->answer_rows().size();
  opened_for_writing().reset();
  const auto reader = open_reader(path);
  EXPECT_EQ(cells_of(*reader, "PRAGMA user_version").front(), Cells{"2"});
  EXPECT_EQ(reader->digest(), kDigest);
  EXPECT_EQ(reader->answer_rows().size(), rows);
  EXPECT_EQ(reader->scores().size(), kEvaluations);
  EXPECT_TRUE(reader->integrity().empty());
  const auto before = open_reader(path.string() + ".before-v2");
  EXPECT_EQ(before->digest(), kDigest);
}

TEST_F(MigrationTest, GivesTheTablesAndViewsOfANewStore) {
  opened_for_writing().reset();
  open_store(folder / "new.db", synthetic_campaign({.designs = 1, .iterations = 1})).reset();
  const std::string migrated = schema_of(path);
  EXPECT_THAT(migrated, testing::HasSubstr("postselection INTEGER"));
  EXPECT_EQ(migrated, schema_of(folder / "new.db"));
}

TEST_F(MigrationTest, AMigratedStoreTakesTheRowsOfTargets) {
  const auto store = opened_for_writing();
  EvaluationRow row;
  row.key = {candidate_id({1}, 1), Purpose::Evaluator, 1};
  row.source = "command";
  row.time = 2;
  EliminationRow again{.candidate = candidate_id({1}, 1), .iteration = 99, .reason = "test"};
  FailureRow failure{.key = row.key, .reason = "no output"};
  store->append({Row(row), Row(again), Row(failure)});
  store->flush();
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT time FROM v_evaluations WHERE id LIKE '%v'"),
            (std::vector<Cells>{{"2"}}));
}

}  // namespace
}  // namespace swarmsmith
