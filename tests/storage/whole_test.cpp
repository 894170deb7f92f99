#include <fmt/format.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/backup.h"
#include "storage/internal/reading.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/row_writer.h"
#include "storage/internal/schema.h"
#include "storage/internal/schema_check.h"
#include "storage/internal/sqlite.h"
#include "storage/merge.h"
#include "storage/recover.h"
#include "storage/store_at_rest.h"
#include "storage/whole.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/synthetic_real_run.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using Cells = std::vector<std::string>;

const auto kUnwatched = [](std::int64_t, std::int64_t) {};

/// A store, and what others do to it with SQLite alone.
struct OfOthers : testing::Test {
  TemporaryFolder folder;
  fs::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.designs = 2, .iterations = 2});

  void make_store() {
    auto store = filled_store(path, campaign);
    CommandRow command{
        .number = 1, .kind = CommandKind::Extend, .design = {1}, .budget = 10, .who = "a@b"};
    store->append({Row(command)});
    command.step = 3;
    store->append({Row(command)});
  }
  /// As an ordinary client does: without our limits.
  static void change(const fs::path& file, const std::string& sql) {
    sqlite3* client = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &client), SQLITE_OK);
    sqlite3_busy_timeout(client, 10'000);
    char* message = nullptr;
    EXPECT_EQ(sqlite3_exec(client, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK)
        << sql << ": " << (message != nullptr ? message : "");
    sqlite3_free(message);
    sqlite3_close(client);
  }
  Expected<std::unique_ptr<Store>> opened(const fs::path& file) {
    return Store::open(file, campaign.campaign, campaign.designs);
  }
  std::string refusal(const fs::path& file) {
    const auto store = opened(file);
    EXPECT_FALSE(store) << "a store of others was opened";
    return store ? "" : to_string(store.error());
  }
};

// --- what a file holds besides our tables and views ---

struct Foreign {
  const char* sql;
  const char* named;
  friend void PrintTo(const Foreign& foreign, std::ostream* out) { *out << foreign.sql; }
};

const Foreign kForeign[] = {
    {"CREATE TRIGGER negate AFTER INSERT ON evaluation BEGIN UPDATE evaluation SET score = -score"
     " WHERE candidate = new.candidate; END",
     "trigger negate"},
    {"CREATE TRIGGER swap INSTEAD OF INSERT ON v_designs BEGIN SELECT 1; END", "trigger swap"},
    {"CREATE TABLE notes (text)", "table notes"},
    {"CREATE TABLE more (id INTEGER PRIMARY KEY AUTOINCREMENT)", "table more"},
    {"CREATE VIRTUAL TABLE found USING fts5(text)", "table found"},
    {"CREATE INDEX by_score ON evaluation (score)", "index by_score"},
    {"CREATE UNIQUE INDEX once ON evaluation (candidate, purpose, pair)", "index once"},
    {"CREATE VIEW v_mine AS SELECT 1 AS one", "view v_mine"},
    {"DROP VIEW v_designs; CREATE VIEW v_designs AS SELECT 1 AS design",
     "view v_designs (another text)"},
    {"DROP VIEW v_modules", "view v_modules (missing)"},
    {"DROP INDEX attempt_of_evaluation", "index attempt_of_evaluation (missing)"},
    {"ALTER TABLE evaluation ADD COLUMN note TEXT", "table evaluation (column note added)"},
    {"ALTER TABLE evaluation ADD COLUMN twice REAL GENERATED ALWAYS AS (2 * score) VIRTUAL",
     "table evaluation (column twice added)"},
    {"ALTER TABLE event RENAME COLUMN text TO words", "column text missing"},
    {"DROP TABLE attempt", "table attempt (missing)"},
};

struct ForeignTest : OfOthers, testing::WithParamInterface<Foreign> {};

TEST_P(ForeignTest, IsNamedAndNothingIsWritten) {
  make_store();
  change(path, GetParam().sql);
  const std::string said = refusal(path);
  EXPECT_THAT(said, HasSubstr("not as Swarmsmith made it"));
  EXPECT_THAT(said, HasSubstr(GetParam().named));
  EXPECT_EQ(why_not(StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse)).kind,
            ErrorKind::Corrupt);
}

TEST_P(ForeignTest, IsLeftOutOfACopyThatGoesOn) {
  make_store();
  const std::string digest = digest_of(path);
  change(path, GetParam().sql);
  const auto made = back_up(path, folder / "copy.db", kUnwatched);
  if (std::string_view(GetParam().named).ends_with("missing)") ||
      std::string_view(GetParam().named).ends_with("text missing")) {
    if (!made) {  // a table or a column of ours is gone
      EXPECT_THAT(made.error().message, HasSubstr("swarmsmith recover"));
      return;
    }
  }
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_EQ(made->digest, digest);
  EXPECT_TRUE(opened(folder / "copy.db")) << to_string(opened(folder / "copy.db").error());
  EXPECT_THAT(open_reader(folder / "copy.db")->integrity(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Objects, ForeignTest, testing::ValuesIn(kForeign));

TEST_F(OfOthers, StatisticsOfSqliteAreNoFault) {
  make_store();
  change(path, "ANALYZE");
  const auto store = opened(path);
  EXPECT_TRUE(store) << to_string(store.error());
}

TEST_F(OfOthers, OldStoresAreComparedWithTheTablesOfTheirSchema) {
  for (const int schema : {1, 3, 4, 9}) {
    SCOPED_TRACE(schema);
    const fs::path old = folder / fmt::format("old-{}.db", schema);
    fs::copy_file(fmt::format("{}/stores/schema-{}.sqlite", SWARMSMITH_TEST_DATA, schema), old);
    campaign.campaign = open_reader(old)->campaign();
    campaign.designs.clear();
    change(old, "CREATE TRIGGER t AFTER INSERT ON evaluation BEGIN SELECT 1; END");
    EXPECT_THAT(refusal(old), HasSubstr("trigger t"));
    const auto made = value_of(back_up(old, folder / fmt::format("new-{}.db", schema), kUnwatched));
    EXPECT_EQ(made.digest, digest_of(old));
    change(old, "DROP TRIGGER t");
    const auto store = opened(old);
    EXPECT_TRUE(store) << to_string(store.error());
  }
}

TEST_F(OfOthers, ReadersUseOurViewsWhateverTextTheFileHas) {
  make_store();
  const auto designs = cells_of(*open_reader(path), "SELECT * FROM v_designs");
  change(path,
         "DROP VIEW v_designs; CREATE VIEW v_designs AS WITH RECURSIVE n(design) AS (SELECT 1 UNION"
         " ALL SELECT design + 1 FROM n) SELECT count(*) AS design FROM n;"
         "DROP VIEW v_leaderboard; CREATE VIEW v_laboratory AS SELECT count(*) AS n FROM design;"
         "CREATE INDEX by_score ON evaluation (score); CREATE TABLE notes (text)");
  const auto reader = open_reader(path);
  EXPECT_EQ(cells_of(*reader, "SELECT * FROM v_designs"), designs);
  EXPECT_THAT(cells_of(*reader, "SELECT * FROM v_leaderboard"), Not(IsEmpty()));
  const auto nothing = [](const auto&) {};
  EXPECT_THAT(complaint_of(reader->query("SELECT * FROM v_laboratory", {}, nothing, nothing)),
              HasSubstr("prohibited"));
  std::string count;
  EXPECT_TRUE(reader->query("SELECT * FROM v_laboratory", {.views_of_file = true}, nothing,
                            [&](const auto& cells) { count = cells[0].text; }));
  EXPECT_EQ(count, "2");
  EXPECT_EQ(reader->real_runs().size(), 0U);
}

TEST_F(OfOthers, AViewInPlaceOfATableIsRefusedToReaders) {
  make_store();
  change(
      path,
      "PRAGMA foreign_keys = OFF; ALTER TABLE event RENAME TO events; CREATE VIEW event AS WITH"
      " RECURSIVE n(seq) AS (SELECT 1 UNION ALL SELECT seq + 1 FROM n) SELECT seq, '' AS time, ''"
      " AS severity, '' AS kind, '' AS text FROM n");
  EXPECT_THAT(complaint_of(StoreReader::open(path)),
              HasSubstr("table event is not as Swarmsmith made it"));
}

TEST_F(OfOthers, TablesMayHaveMoreColumnsAndNotFewer) {
  make_store();
  const fs::path whole = folder / "whole.db";
  fs::copy_file(path, whole);
  const std::pair<const char*, const char*> changes[] = {
      {"ALTER TABLE evaluation ADD COLUMN note TEXT", ""},
      {"CREATE TABLE notes (text)", ""},
      {"ALTER TABLE worker DROP COLUMN cpu",
       "worker is not as Swarmsmith made it (column cpu"
       " missing)"},
      {"ALTER TABLE event RENAME COLUMN text TO words",
       "event is not as Swarmsmith made it (column words added, column text missing)"},
      {"DROP TABLE attempt", "attempt is not as Swarmsmith made it (it is missing, or no table)"}};
  for (const auto& [sql, fault] : changes) {
    fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
    change(path, std::string("PRAGMA foreign_keys = OFF; DROP VIEW v_workers; DROP VIEW v_failures;"
                             "DROP VIEW v_attempts; ") +
                     sql);
    const std::string complaint = complaint_of(StoreReader::open(path));
    if (*fault == '\0') {
      EXPECT_EQ(complaint, "");
      continue;
    }
    EXPECT_EQ(complaint, path.string() + ": the store's table " + fault +
                             "; restore the store from a backup, or let `swarmsmith recover` make "
                             "a new one from what can be read");
  }
}

TEST(ListedObjects, AreTenAndTheNumberOfTheOthers) {
  EXPECT_EQ(listed_objects({}), "");
  EXPECT_EQ(listed_objects({"trigger a", "table b"}), "trigger a, table b");
  const std::vector<std::string> ten(10, "view v");
  std::string text = "view v";
  for (int i = 1; i < 10; ++i)
    text += ", view v";
  EXPECT_EQ(listed_objects(ten), text);
  std::vector<std::string> more = ten;
  more.insert(more.end(), {"view w", "view x"});
  EXPECT_EQ(listed_objects(more), text + " and 2 more");
}

TEST_F(OfOthers, NamesOfAnyLengthAreRefused) {
  make_store();
  change(path, "UPDATE design SET mission = printf('%.100000c', 'm')");
  EXPECT_THAT(complaint_of(StoreReader::open(path)), HasSubstr("100000 bytes"));
}

// --- rows that are those of a commit ---

TEST_F(OfOthers, EachCommitSaysWhatRowsThereAre) {
  const auto expect_said = [&](const std::string& when) {
    const Connection connection(path.string(), SQLITE_OPEN_READONLY);
    const auto stored = RowSums::stored(connection);
    ASSERT_TRUE(stored) << when;
    EXPECT_EQ(stored->differences(RowSums::found(connection)), "") << when;
  };
  {
    auto store = open_store(path, campaign);
    expect_said("at birth");
    for (const auto& batch : campaign.batches) {
      store->append(batch);
      store->append(batch);  // twice does no harm
      ASSERT_TRUE(store->flush());
      expect_said("after a batch");
    }
    // Computed ahead, used, unused, used again.
    EvaluationRow ahead{.key = {candidate_id({1}, 2), Purpose::Race, 9000},
                        .measured = {.score = -0.0}};
    ahead.source = "another";
    for (const std::int64_t iteration : {0, 2, 2}) {
      ahead.iteration = iteration;
      store->append({Row(ahead)});
      store->append({Row(UnusedRow{ahead.key})});
      store->append({Row(ahead)});
      ASSERT_TRUE(store->flush());
      expect_said("after an evaluation");
    }
    CommandRow command{
        .number = 1, .kind = CommandKind::Extend, .design = {1}, .budget = 10, .who = "a@b"};
    store->append({Row(command)});
    command.step = 3;
    store->append({Row(command), Row(CampaignStateRow{.state = "finished"})});
    ASSERT_TRUE(store->flush());
    expect_said("after a command");
  }
  expect_said("after the end");
  {
    auto store = StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse);
    const EvaluationKey key{candidate_id({1}, 1), Purpose::Score, 1};
    Addition scored{
        .rows = {EvaluationRow{.key = key, .measured = {.score = 2}, .source = "real"}}};
    ASSERT_TRUE((*store)->add(scored));
    expect_said("after a score");
    Addition again{.removed = {key},
                   .rows = {EvaluationRow{.key = key, .measured = {.score = 3}, .source = "real"}}};
    ASSERT_TRUE((*store)->add(again));
    expect_said("after another score in its place");
    ASSERT_TRUE((*store)->add({.removed = {{candidate_id({1}, 1), Purpose::Race, 1}}}));
    EXPECT_EQ(cells_of(*open_reader(path),
                       "SELECT count(*) FROM evaluation WHERE candidate = 1 AND purpose = 0 AND"
                       " pair = 1")[0][0],
              "0");
    expect_said("without a score of the race");
    Addition imported{
        .campaign =
            CampaignRow{.name = "x", .digest = "x", .deciding = "{}", .file = "", .seed = 0},
        .designs = {{.row = {.id = {3}, .mission = "m", .method = "by hand"}, .name = "a"}}};
    ASSERT_TRUE((*store)->add(imported));
    expect_said("after an import");
  }
  ASSERT_TRUE(back_up(path, folder / "copy.db", kUnwatched));
  ASSERT_TRUE(merge_stores({path}, folder / "merged.db", [](auto, auto) {}));
  for (const char* name : {"copy.db", "merged.db"}) {
    path = folder / name;
    expect_said(name);
  }
}

TEST_F(OfOthers, ASumIsReadFromWholeTextsOfAllTablesOrOfTheFirstOnes) {
  make_store();
  Connection connection(path.string(), SQLITE_OPEN_READWRITE);
  const RowSums found = RowSums::found(connection);
  const std::string whole =
      sqlite::text_of(connection, "SELECT value FROM meta WHERE key = 'row_sums'");
  const auto stored = [&](const std::string& text) {
    sqlite::Statement(connection, "UPDATE meta SET value = ? WHERE key = 'row_sums'").run(text);
    return RowSums::stored(connection);
  };
  EXPECT_EQ(stored(whole), found);
  // "ROWS SUM" for each table: after fourteen tables the others may be missing.
  std::vector<std::size_t> ends;
  for (std::size_t at = whole.find(' '); at != std::string::npos; at = whole.find(' ', at + 1))
    ends.push_back(at);
  ASSERT_EQ(ends.size(), 2 * RowSums::kTables - 1);
  using Table = RowSums::Table;
  for (std::size_t tables = 1; tables < RowSums::kTables; ++tables) {
    const auto part = stored(whole.substr(0, ends[2 * tables - 1]));
    ASSERT_TRUE(part);
    if (tables < 14) {
      EXPECT_EQ(*part, RowSums()) << tables << " tables are no store's";
      continue;
    }
    EXPECT_EQ(part->differences(found), "") << tables;
    RowSums other = found;
    other.replace(Table::RealOverride, 0, 1);
    EXPECT_EQ(part->differences(other), "") << tables;
    EXPECT_FALSE(part->has_other_values(Table::RealOverride, other));
    other.replace(Table::Command, 0, 1);
    EXPECT_EQ(part->differences(other), "command (other values)") << tables;
    EXPECT_TRUE(part->has_other_values(Table::Command, other));
    EXPECT_EQ(stored(whole.substr(0, ends[2 * tables])), RowSums()) << "rows without a sum";
  }
  for (const std::string& text : {std::string(), std::string("x"), "x" + whole,
                                  "1" + whole.substr(ends[0], 1) + "y" + whole.substr(ends[1])})
    EXPECT_EQ(stored(text), RowSums()) << text;
  connection.execute("DELETE FROM meta WHERE key = 'row_sums'");
  EXPECT_EQ(RowSums::stored(connection), std::nullopt);
  EXPECT_EQ(changed_rows(connection), "");
}

TEST(RowSums, SayInWhichTablesTheyDiffer) {
  using Table = RowSums::Table;
  const RowSums none;
  RowSums found;
  EXPECT_EQ(none.differences(found), "");
  found.add(Table::Elite, 7);
  EXPECT_EQ(none.differences(found), "elite (1 row for 0)");
  EXPECT_EQ(found.differences(none), "elite (0 rows for 1)");
  EXPECT_FALSE(none.has_other_values(Table::Elite, found));
  RowSums other = found;
  other.replace(Table::Elite, 7, 8);
  EXPECT_TRUE(found.has_other_values(Table::Elite, other));
  EXPECT_FALSE(found.has_other_values(Table::Elite, found));
  other.replace(Table::Elite, 8, 7);
  EXPECT_EQ(other, found);
  // An evaluation and its use are one thing to people.
  other.add(Table::Used, 1);
  EXPECT_EQ(found.differences(other), "evaluation (1 row for 0)");
  other.add(Table::Evaluation, 5);
  other.add(Table::Evaluation, 5);
  other.remove(Table::Elite, 7);
  EXPECT_EQ(found.differences(other), "evaluation (2 rows for 0), elite (0 rows for 1)");
}

TEST_F(OfOthers, RowsAreWrittenToAStoreWithoutSumsToo) {
  open_store(path, campaign).reset();
  Connection connection(path.string(), SQLITE_OPEN_READWRITE);
  connection.execute("DELETE FROM meta WHERE key = 'row_sums'");
  {
    RowWriter writer(connection);
    for (const auto& batch : campaign.batches) {
      for (const Row& row : batch)
        writer.write(row);
    }
    writer.write(CommandRow{
        .number = 1, .kind = CommandKind::Pause, .design = {1}, .budget = 10, .who = "a@b"});
    writer.write_sums();
  }
  EXPECT_FALSE(RowSums::stored(connection));
  EXPECT_EQ(digest_of_store(connection), digest_after(campaign, campaign.batches));
}

TEST(RowHash, DependsOnEachLetter) {
  for (std::size_t size = 1; size <= 17; ++size) {
    const std::string text(size, 'a');
    for (std::size_t i = 0; i < size; ++i) {
      std::string other = text;
      other[i] = 'b';
      EXPECT_NE(RowHash::of(text), RowHash::of(other)) << size << " " << i;
    }
  }
}

TEST_F(OfOthers, RowsThatOthersChangedAreFoundAndNamed) {
  make_store();
  const fs::path whole = folder / "whole.db";
  fs::copy_file(path, whole);
  const std::pair<const char*, const char*> changes[] = {
      {"DELETE FROM elite WHERE rank = 1", "elite ("},
      {"UPDATE evaluation SET score = -score WHERE pair = 2", "evaluation (other values)"},
      {"UPDATE evaluation SET iteration = NULL WHERE pair = 2", "evaluation ("},
      {"DELETE FROM evaluation WHERE pair = 2", "evaluation ("},
      {"DELETE FROM candidate_totals WHERE candidate = 1", "candidate_totals ("},
      {"UPDATE design SET used = used + 1", "design (other values)"},
      {"UPDATE race_step SET digest = 0 WHERE step = 1", "race_step (other values)"},
      {"DELETE FROM elimination", "elimination (0 rows"},
      {"UPDATE command SET step = 4", "command (other values)"},
      {"UPDATE campaign SET state = 'running'", "campaign (other values)"},
      {"UPDATE source SET name = 'x' WHERE id = 1", "source (other values)"},
      {"DELETE FROM phrase WHERE id = 1", "phrase ("},
      {"DELETE FROM meta WHERE key = 'row_sums'; INSERT INTO meta VALUES ('row_sums', '1 2 x')",
       "candidate ("},
  };
  for (const auto& [sql, named] : changes) {
    SCOPED_TRACE(sql);
    fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
    change(path, std::string("PRAGMA foreign_keys = OFF; ") + sql);
    const std::string said = refusal(path);
    EXPECT_THAT(said, HasSubstr("rows are not those that were committed"));
    EXPECT_THAT(said, HasSubstr(named));
    EXPECT_THAT(open_reader(path)->integrity(), Not(IsEmpty()));
    const auto made = back_up(path, folder / "copy.db", kUnwatched);
    EXPECT_FALSE(made);
  }
}

TEST_F(OfOthers, ChangedRealRunsAreFoundAndNamed) {
  make_store();
  {
    const auto store = StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse);
    ASSERT_TRUE((*store)->add_real_run(synthetic_real_run(1, {}, 40)));
    ASSERT_TRUE((*store)->add_override({{1}, "DEGRADED", "ada", "x"}));
  }
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  const fs::path whole = folder / "whole.db";
  fs::copy_file(path, whole);
  const std::pair<const char*, const char*> changes[] = {
      {"UPDATE real_score SET score = score + 1", "real_score (other values)"},
      {"UPDATE real_override SET verdict = 'VALID'", "real_override (other values)"},
      {"DELETE FROM real_override", "real_override (0 rows for 1)"},
      {"UPDATE real_run SET mission = 'other'", "real_run (other values)"}};
  for (const auto& [sql, named] : changes) {
    SCOPED_TRACE(sql);
    fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
    change(path, sql);
    EXPECT_THAT(complaint_of(check_rows(path)), HasSubstr(named));
    EXPECT_THAT(refusal(path), HasSubstr(named));
  }
}

TEST_F(OfOthers, SumsOfAnEarlierProgramSayNothingOfLaterTables) {
  make_store();
  change(
      path,
      "UPDATE meta SET value = substr(value, 1, length(value) - 3 * length(' 0 0123456789abcdef'))"
      " WHERE key = 'row_sums'");
  EXPECT_TRUE(check_rows(path));
  change(path, "DELETE FROM elite WHERE rank = 1");
  EXPECT_FALSE(check_rows(path));
}

TEST_F(OfOthers, RowsThatAreNoPartOfTheAnswerMayBeChanged) {
  make_store();
  change(path, "INSERT INTO event (severity, kind, text) VALUES ('info', 'note', '{}'); VACUUM");
  EXPECT_TRUE(opened(path));
}

TEST_F(OfOthers, ACopyIsCheckedAndNotAccused) {
  make_store();
  fs::copy_file(path, folder / "copy.db");
  EXPECT_TRUE(opened(folder / "copy.db"));
}

TEST_F(OfOthers, TheFileThatWasClosedIsKnownAgain) {
  make_store();
  const auto modified = fs::last_write_time(path);
  // A page in the middle, in a way that nothing but a check of the whole would find.
  const auto spoil = [&](const fs::path& file) {
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(8192 * 5)
        << std::string(200, '\0');
  };
  fs::copy_file(path, folder / "copy.db");
  fs::last_write_time(folder / "copy.db", modified);  // as `cp -p` does
  spoil(folder / "copy.db");
  fs::last_write_time(folder / "copy.db", modified);
  EXPECT_THAT(refusal(folder / "copy.db"), HasSubstr("not the file that was closed"));
  spoil(path);
  EXPECT_THAT(refusal(path), HasSubstr("not the file that was closed"));
  fs::last_write_time(path, modified);
  EXPECT_TRUE(opened(path)) << "a file that is as it was closed was looked through";
}

/// Copies the file with a log of another moment, as a slow copy of a running store does.
TEST_F(OfOthers, ACopyInPartsIsRefusedOrAStateThatTheCampaignHad) {
  const auto& batches = campaign.batches;
  std::vector<std::string> digests;  // of each state
  {
    TemporaryFolder other;
    auto store = open_store(other / "s.db", campaign);
    digests.push_back(digest_of(other / "s.db"));
    for (const auto& batch : batches) {
      store->append(batch);
      ASSERT_TRUE(store->flush());
      digests.push_back(digest_of(other / "s.db"));
    }
  }
  const std::string log = path.string() + "-wal";
  int refused = 0, gone_on = 0;
  for (std::size_t at = 1; at + 2 < batches.size(); at += 3) {
    for (const bool folded_again : {false, true}) {
      SCOPED_TRACE(fmt::format("after {} batches, {}", at, folded_again));
      for (const char* ending : {"", "-wal", "-shm", ".lock"})
        fs::remove(path.string() + ending);
      const fs::path copy = folder / fmt::format("copy-{}-{}.db", at, folded_again);
      {
        auto store = open_store(path, campaign);
        for (std::size_t i = 0; i < batches.size(); ++i) {
          store->append(batches[i]);
          ASSERT_TRUE(store->flush());
          if (i != at) continue;
          fs::copy_file(path, copy);
          change(path, "PRAGMA wal_checkpoint(TRUNCATE)");
          if (!folded_again) continue;
          // The first half of the file of now, and the second half of the one before.
          std::fstream from(path, std::ios::in | std::ios::binary);
          std::string half(fs::file_size(path) / 2 + 1001, '\0');
          from.read(half.data(), static_cast<std::streamsize>(half.size()));
          std::fstream(copy, std::ios::in | std::ios::out | std::ios::binary) << half;
        }
        fs::copy_file(log, copy.string() + "-wal");
      }
      const auto store = opened(copy);
      if (!store) {
        ++refused;
        EXPECT_EQ(store.error().kind, ErrorKind::Corrupt) << to_string(store.error());
      } else {
        ++gone_on;
        EXPECT_THAT(digests, Contains(digest_of(copy)));
      }
    }
  }
  EXPECT_GT(refused, 3) << "no copy was torn: the test shows nothing";
  fmt::print("  {} copies refused, {} gone on with\n", refused, gone_on);
}

// --- while a campaign runs ---

struct WhileItRuns : OfOthers {
  std::unique_ptr<Store> store = open_store(path, campaign);

  void append(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, campaign.batches.size()); ++i)
      store->append(campaign.batches[i]);
  }
  std::string end_after(const std::string& sql) {
    append(0, campaign.batches.size() / 2);
    EXPECT_TRUE(store->flush());
    const std::string digest = digest_of(path);
    change(path, sql);
    const auto rows = cells_of(*open_reader(path), "SELECT count(*) FROM evaluation");
    append(campaign.batches.size() / 2, campaign.batches.size());
    const auto flushed = store->flush();
    EXPECT_FALSE(flushed);
    store.reset();
    EXPECT_EQ(cells_of(*open_reader(path), "SELECT count(*) FROM evaluation"), rows);
    EXPECT_FALSE(opened(path)) << "it was gone on with";
    return flushed ? "" : to_string(flushed.error());
  }
};

TEST_F(WhileItRuns, AColumnThatAClientAddsStopsItWithASentence) {
  const std::string said = end_after("ALTER TABLE evaluation ADD COLUMN note TEXT");
  EXPECT_THAT(said, HasSubstr("schema was changed by another program while the campaign ran"));
  EXPECT_THAT(said, HasSubstr("table evaluation (column note added)"));
}

TEST_F(WhileItRuns, ATriggerOfAClientStopsItBeforeItActs) {
  const std::string said = end_after(
      "CREATE TRIGGER negate AFTER INSERT ON evaluation BEGIN UPDATE evaluation SET score = 0;"
      " END");
  EXPECT_THAT(said, HasSubstr("trigger negate"));
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT count(*) FROM evaluation WHERE score = 0"),
            (std::vector<Cells>{{"0"}}));
}

TEST_F(WhileItRuns, RowsThatAClientDeletesStopIt) {
  const std::string said = end_after("DELETE FROM evaluation WHERE pair = 1");
  EXPECT_THAT(said, HasSubstr("was changed by another program while the campaign ran: evaluation"));
}

TEST_F(WhileItRuns, ItNoticesWithoutAnythingToWrite) {
  append(0, 4);
  ASSERT_TRUE(store->flush());
  std::mutex mutex;
  std::condition_variable told;
  std::string trouble;
  store->set_listener([&](const WriterNews& news) {
    const std::scoped_lock lock(mutex);
    if (news.is_lost) trouble = news.trouble;
    told.notify_all();
  });
  change(path, "UPDATE evaluation SET score = score + 1");
  std::unique_lock lock(mutex);
  EXPECT_TRUE(told.wait_for(lock, std::chrono::seconds(60), [&] { return !trouble.empty(); }));
  EXPECT_THAT(trouble, HasSubstr("evaluation (other values)"));
}

TEST_F(WhileItRuns, AClientMayFoldTheLogInAndWriteWhatIsNoAnswer) {
  append(0, campaign.batches.size() / 2);
  ASSERT_TRUE(store->flush());
  change(path, "PRAGMA wal_checkpoint(TRUNCATE)");
  append(campaign.batches.size() / 2, campaign.batches.size() - 1);
  ASSERT_TRUE(store->flush());
  change(path, "INSERT INTO event (severity, kind, text) VALUES ('info', 'note', '{}')");
  append(campaign.batches.size() - 1, campaign.batches.size());
  EXPECT_TRUE(store->flush());
  store.reset();
  EXPECT_EQ(digest_of(path), digest_after(campaign, campaign.batches));
  EXPECT_TRUE(opened(path));
}

}  // namespace
}  // namespace swarmsmith
