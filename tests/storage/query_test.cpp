#include <fstream>

#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/peak_memory.h"

namespace swarmsmith {
namespace {

using Cell = StoreReader::Cell;

struct QueryTest : FilledStore {
  QueryTest() : FilledStore(synthetic_campaign({.designs = 1, .iterations = 1})) {}

  std::filesystem::path path = folder / "s.db";
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  Expected<StoreReader::QueryEnd> query(const std::string& sql,
                                        const StoreReader::QueryLimits& limits = {}) {
    rows.clear();
    return reader->query(
        sql, limits, [this](const auto& names) { columns = names; },
        [this](const auto& cells) { rows.push_back(cells); });
  }
};

TEST_F(QueryTest, FindsIdsAsTheyArePrinted) {
  const auto count = [&](const std::string& rest) {
    EXPECT_TRUE(query("SELECT count(*) FROM v_candidates AS k WHERE " + rest)) << rest;
    return rows.empty() ? std::string() : rows.front().front().text;
  };
  const std::string one = count("candidate = 3");
  EXPECT_EQ(one, "1");
  for (const char* same :
       {"candidate='c3'", "k.candidate = 'c3'", "'c3' = k.candidate", "\"candidate\" == 'c3'",
        "k.[candidate] IS 'c3'", "candidate IN ('c3')", "candidate IN ('c0', 'c3', 'c999999')",
        "candidate BETWEEN 'c3' AND 'c3'", "candidate >= 'c3' AND candidate < 'c4'",
        "1 = 1 AND 'c3' = candidate", "/* 'c9' */ candidate = 'c3' -- 'c8'"})
    EXPECT_EQ(count(same), one) << same;
  EXPECT_EQ(count("design = 'd1' AND candidate NOT IN ('c3')"), count("candidate <> 3"));
  EXPECT_EQ(count("candidate IS NOT 'c3'"), count("candidate <> 3"));
  // Texts stay texts.
  query("SELECT 'c3', 'it''s c3' FROM v_designs WHERE mission = 'd1' OR name = 'c3' OR 1");
  EXPECT_EQ(rows.front()[0].text, "c3");
  EXPECT_EQ(rows.front()[1].text, "it's c3");
  EXPECT_EQ(count("design = 'c3'"), "0");
}

TEST_F(QueryTest, GivesColumnsAndCellsWithTheirTypes) {
  const auto end = query("SELECT 1 AS one, 0.1 AS tenth, 'it''s' AS text, NULL AS none;");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->rows, 1);
  EXPECT_FALSE(end->truncated);
  EXPECT_THAT(columns, ElementsAre("one", "tenth", "text", "none"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0][0].type, Cell::Type::Integer);
  EXPECT_EQ(rows[0][1].text, "0.1");
  EXPECT_EQ(rows[0][1].type, Cell::Type::Real);
  EXPECT_EQ(rows[0][2].text, "it's");
  EXPECT_EQ(rows[0][3].type, Cell::Type::Null);
}

TEST_F(QueryTest, TellsColumnsOfAnAnswerWithoutRows) {
  ASSERT_TRUE(query("SELECT design, state FROM v_designs WHERE design = 99"));
  EXPECT_THAT(columns, ElementsAre("design", "state"));
  EXPECT_TRUE(rows.empty());
}

TEST_F(QueryTest, RefusesWhateverIsNotReading) {
  for (const std::string sql : {"DELETE FROM evaluation",
                                "INSERT INTO meta VALUES ('a', 'b')",
                                "UPDATE design SET used = 0",
                                "CREATE TABLE t (a)",
                                "CREATE TEMP TABLE t (a)",
                                "DROP VIEW v_designs",
                                "ATTACH 'other.db' AS o",
                                "DETACH main",
                                "PRAGMA journal_mode = DELETE",
                                "PRAGMA query_only = OFF",
                                "PRAGMA user_version = 3",
                                "BEGIN",
                                "SAVEPOINT a",
                                "VACUUM",
                                "VACUUM INTO 'copy.db'",
                                "ANALYZE",
                                "REINDEX",
                                "SELECT load_extension('evil')",
                                "PRAGMA wal_checkpoint",
                                "PRAGMA writable_schema = ON",
                                "UPDATE sqlite_schema SET sql = ''"}) {
    const Error end = why_not(query(sql));
    EXPECT_EQ(end.kind, ErrorKind::BadInput) << sql;
    EXPECT_FALSE(end.message.empty());
  }
}

TEST_F(QueryTest, AllowsToAskForTheShapeOfTables) {
  EXPECT_TRUE(query("PRAGMA table_info(design)"));
  EXPECT_FALSE(rows.empty());
  EXPECT_TRUE(query("PRAGMA user_version"));
  EXPECT_TRUE(query("EXPLAIN QUERY PLAN SELECT * FROM v_designs"));
}

TEST_F(QueryTest, RefusesMistakesWithTheReasonOfSqlite) {
  EXPECT_THAT(query("SELECT missing FROM v_designs").error().message,
              HasSubstr("no such column: missing"));
  EXPECT_THAT(query("SELEC 1").error().message, HasSubstr("syntax error"));
  EXPECT_THAT(query("  ").error().message, HasSubstr("empty"));
  EXPECT_THAT(query("SELECT 1; SELECT 2").error().message, HasSubstr("one statement"));
}

/// An error repeats the statement only to the person who typed it.
TEST_F(QueryTest, RepeatsAStatementOnlyWhereItWasTyped) {
  for (const std::string& sql :
       {std::string("SELECT missing FROM v_designs"), std::string("SELECT zeroblob(900000000)"),
        std::string(
            "SELECT group_concat(printf('%0500000d', 1), '') FROM (SELECT value FROM "
            "json_each('[' || substr(replace(hex(zeroblob(300)), '0', ',1'), 2) || ']'))")}) {
    const Error own = why_not(query(sql, {.seconds = 600}));
    EXPECT_EQ(own.where, path.string()) << sql;
    EXPECT_THAT(to_string(own), Not(HasSubstr("SELECT")));
    EXPECT_THAT(to_string(own), Not(HasSubstr("query")));
    EXPECT_EQ(why_not(query(sql, {.seconds = 600, .typed = true})).where, sql);
  }
}

/// Files that this process has open, also those that have no name any more.
std::vector<std::string> open_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code closed;
    files.push_back(std::filesystem::read_symlink(entry.path(), closed).string());
  }
  return files;
}

TEST_F(QueryTest, SortsOnTheDiskOfTheStore) {
  // Sorted by a key that SQLite must make: more than it keeps in memory.
  bool spilled = false;
  const auto end = reader->query(
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 60000) "
      "SELECT printf('%05000d', i * 7919 % 60000) AS s FROM n ORDER BY s",
      {.seconds = 600, .bytes = 1 << 30, .memory = 1 << 30}, [](const auto&) {},
      [&](const auto&) {
        if (spilled) return;
        for (const std::string& file : open_files())
          spilled |= file.starts_with((folder / ".swarmsmith-spill-").string());
      });
  ASSERT_TRUE(end) << to_string(end.error());
  EXPECT_EQ(end->rows, 60000);
  EXPECT_TRUE(spilled) << "temporary files are elsewhere";
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path()))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("spill")));
}

TEST_F(QueryTest, StopsAtTheLimitOfRows) {
  const auto end = value_of(query("SELECT * FROM v_evaluations", {.rows = 3}));
  EXPECT_EQ(end.rows, 3);
  EXPECT_TRUE(end.truncated);
  EXPECT_FALSE(query("SELECT * FROM v_designs", {.rows = 1})->truncated);
}

TEST_F(QueryTest, StopsAtTheLimitOfTimeAlsoBeforeTheFirstRow) {
  const auto end = value_of(query(
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n",
      {.seconds = 0.02}));
  EXPECT_EQ(end.rows, 0);
  EXPECT_TRUE(end.truncated);
  EXPECT_TRUE(query("SELECT 1")) << "the limit outlived its query";
}

/// Whatever makes much of little: long values, long rows, many rows, what is sorted, grouped, or
/// remembered.
TEST_F(QueryTest, TakesNoMoreMemoryThanItMay) {
  const double before = peak_memory();
  const std::string many =
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 60000) ";
  const std::string few =
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 600) ";
  for (const std::string& sql :
       {std::string("SELECT zeroblob(900000000)"), std::string("SELECT hex(zeroblob(400000000))"),
        std::string("SELECT randomblob(900000000)"),
        std::string("SELECT replace(hex(zeroblob(10000000)), '0', 'xxxxxxxxxxxxxxxx')"),
        few + "SELECT group_concat(printf('%0500000d', i), '') FROM n",
        few + "SELECT json_group_array(printf('%0500000d', i)) FROM n",
        many + "SELECT printf('%05000d', i) AS s FROM n ORDER BY s DESC",
        many + "SELECT count(*) FROM n GROUP BY printf('%05000d', i)",
        many + "SELECT DISTINCT printf('%05000d', i) FROM n LIMIT -1 OFFSET 60000",
        std::string("WITH RECURSIVE n (i, s) AS (SELECT 1, '' UNION SELECT i + 1, "
                    "printf('%05000d', i) FROM n) "
                    "SELECT count(*) FROM n"),
        std::string("SELECT randomblob(30000000), randomblob(30000000), randomblob(30000000), "
                    "randomblob(30000000), randomblob(30000000), randomblob(30000000)"),
        std::string("SELECT zeroblob(30000000), zeroblob(30000000), zeroblob(30000000)")}) {
    const Error end = why_not(query(sql, {.seconds = 600, .typed = true}));
    EXPECT_EQ(end.kind, ErrorKind::BadInput) << sql;
    EXPECT_THAT(end.message, HasSubstr(" MB")) << sql;
    rows.clear();
  }
  EXPECT_LT(peak_memory() - before, 500);
  EXPECT_TRUE(query("SELECT printf('%.*c', 30000000, 'x')")) << "a long value is one";
  EXPECT_TRUE(query("SELECT count(*) FROM v_evaluations")) << "the limits outlived their query";
  EXPECT_EQ(sqlite3_hard_heap_limit64(-1), 0) << "and that of all queries";
}

TEST_F(QueryTest, StopsAtTheLimitOfBytes) {
  const std::string many =
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 1000000) "
      "SELECT printf('%01000d', i) FROM n";
  const auto end = value_of(query(many, {.bytes = 1 << 20}));
  EXPECT_TRUE(end.truncated);
  EXPECT_GT(end.rows, 900);
  EXPECT_LT(end.rows, 1100);
}

TEST_F(QueryTest, FindsNoFaultInASoundStoreAndSaysWhatIsWrongInAnother) {
  EXPECT_THAT(reader->integrity(), IsEmpty());
  sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE)
      .execute("PRAGMA foreign_keys = OFF; DELETE FROM candidate WHERE id = 1");
  EXPECT_THAT(reader->integrity(),
              Contains("rows of evaluation refer to rows of candidate that do not exist: 5"));
}

}  // namespace
}  // namespace swarmsmith
