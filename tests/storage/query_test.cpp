#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "storage/internal/printed_ids.h"
#include "storage/internal/query.h"
#include "storage/internal/schema.h"
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

/// A store without rows and without a file.
struct QueryInMemory : testing::Test {
  sqlite::Connection memory{":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE};
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  QueryInMemory() { create_schema(memory); }

  Expected<StoreReader::QueryEnd> query(const std::string& sql,
                                        const StoreReader::QueryLimits& limits = {}) {
    rows.clear();
    return run_query(
        memory, sql, limits, [this](const auto& names) { columns = names; },
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

TEST(PrintedIds, BecomeNumbersWhereAColumnOfIdsIsComparedWithThem) {
  const std::pair<const char*, const char*> cases[] = {
      {"candidate = 'c3'", "candidate = 3"},
      {"'c3' = candidate", "3 = candidate"},
      {"'c3' = k.candidate", "3 = k.candidate"},
      {"'c3' = main.k.candidate", "3 = main.k.candidate"},
      {"design = 'd12' OR parent='c1' OR best_candidate='c2' OR best='c4' OR name='c5'",
       "design = 12 OR parent=1 OR best_candidate=2 OR best=4 OR name='c5'"},
      {"\"Design\"='d1' OR [design]='d2' OR `DESIGN`='d3' OR 'design'='d4'",
       "\"Design\"=1 OR [design]=2 OR `DESIGN`=3 OR 'design'='d4'"},
      {"design=='d1' OR design<'d2' OR design>'d3' OR design<='d4' OR design>='d5'",
       "design==1 OR design<2 OR design>3 OR design<=4 OR design>=5"},
      {"design<>'d1' OR 'd2'!=design OR design+'d3'", "design<>1 OR 2!=design OR design+'d3'"},
      {"candidate IN ('c1', 'c2','c3')", "candidate IN (1, 2,3)"},
      {"candidate not in ('c1','c2')", "candidate not in (1,2)"},
      {"candidate BETWEEN 'c1' AND 'c2'", "candidate BETWEEN 1 AND 2"},
      {"candidate NOT BETWEEN 'c1' AND 'c2'", "candidate NOT BETWEEN 1 AND 2"},
      {"candidate IS 'c1' OR candidate IS NOT 'c2'", "candidate IS 1 OR candidate IS NOT 2"},
      {"'c1' OR candidate AND 'c2'", "'c1' OR candidate AND 'c2'"},
      {"candidate + NOT 'c1'", "candidate + NOT 'c1'"},
      {"candidate = f('c1','c2')", "candidate = f('c1','c2')"},
      {"= 'c1'", "= 'c1'"},
      {"'c1' =", "'c1' ="},
      {"'c1' = k.", "'c1' = k."},
      {"candidate = 'd1' OR design = 'c1'", "candidate = 'd1' OR design = 'c1'"},
      {"candidate = 'c' OR candidate = 'c1x'", "candidate = 'c' OR candidate = 'c1x'"},
      {"'it''s c1' = candidate OR candidate = 'c2'", "'it''s c1' = candidate OR candidate = 2"},
      {"candidate --\n= 'c3'", "candidate --\n= 3"},
      {"candidate -- 'c8'\n= 'c3' -- 'c9'", "candidate -- 'c8'\n= 3 -- 'c9'"},
      {"candidate /**/ = /* 'c8' */ 'c3'", "candidate /**/ = /* 'c8' */ 3"},
      {"candidate /*/ = 'c3'", "candidate /*/ = 'c3'"},
      {"my_candidate='c1' OR candidate$='c2' OR candidate1='c3' OR \xc3\xa9"
       "candidate='c4'",
       "my_candidate='c1' OR candidate$='c2' OR candidate1='c3' OR \xc3\xa9"
       "candidate='c4'"},
      {"candidate='c1", "candidate='c1"},
      {"SELECT 1", "SELECT 1"},
      {"", ""}};
  for (const auto& [typed, sql] : cases)
    EXPECT_EQ(with_numbers_of_ids(typed), sql);
}

TEST_F(QueryInMemory, GivesColumnsAndCellsWithTheirTypes) {
  const auto end = query(
      "SELECT 1 AS one, 0.1 AS tenth, 'it''s' AS text, NULL AS none, x'6162' AS blob, x'' AS empty"
      "; ;\n ");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->rows, 1);
  EXPECT_FALSE(end->truncated);
  EXPECT_THAT(columns, ElementsAre("one", "tenth", "text", "none", "blob", "empty"));
  ASSERT_EQ(rows.size(), 1U);
  using Type = Cell::Type;
  using Shown = std::vector<std::pair<Type, std::string>>;
  Shown cells;
  for (const Cell& cell : rows[0])
    cells.emplace_back(cell.type, cell.text);
  EXPECT_EQ(cells, (Shown{{Type::Integer, "1"},
                          {Type::Real, "0.1"},
                          {Type::Text, "it's"},
                          {Type::Null, ""},
                          {Type::Text, "ab"},
                          {Type::Text, ""}}));
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
  for (const char* sql :
       {"PRAGMA table_info(design)", "PRAGMA table_xinfo(design)", "PRAGMA table_list",
        "PRAGMA index_list(source)", "PRAGMA index_info(sqlite_autoindex_source_1)",
        "PRAGMA foreign_key_list(candidate)", "PRAGMA collation_list", "PRAGMA compile_options",
        "PRAGMA user_version", "PRAGMA application_id", "PRAGMA page_size", "PRAGMA page_count",
        "PRAGMA freelist_count", "SELECT name FROM pragma_table_info('design')",
        "EXPLAIN QUERY PLAN SELECT * FROM v_designs"}) {
    EXPECT_TRUE(query(sql)) << sql;
    EXPECT_FALSE(rows.empty()) << sql;
  }
  for (const char* sql : {"PRAGMA user_version = 3", "PRAGMA application_id = 3",
                          "PRAGMA page_size = 512", "PRAGMA cache_size", "PRAGMA page_count = 1"}) {
    const Error refused = why_not(query(sql, {.typed = true}));
    EXPECT_EQ(refused.message,
              "a query may only read: no writing, attaching, transactions or settings");
    EXPECT_EQ(refused.where, sql);
  }
}

/// Each error about a statement that a person typed, and about one of our own.
TEST_F(QueryInMemory, SaysInAWholeSentenceWhatIsWrong) {
  struct Case {
    std::string sql, typed, own;
  };
  const std::string many =
      "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 9000) SELECT "
      "group_concat(printf('%01000d', i)) FROM n";
  const std::vector<Case> cases{
      {"SELECT abs(-9223372036854775807 - 1)", "integer overflow", "integer overflow"},
      {"SELECT json('{')", "malformed JSON", "malformed JSON"},
      {"SELECT missing", "no such column: missing", "no such column: missing"},
      {many,
       "the query needs more memory than 3 MB; ask for fewer rows or columns, or sort and group "
       "less",
       "this takes more memory than 3 MB, the limit for reading a store; ask for one design or "
       "mission"},
      {"SELECT zeroblob(26214401)", "a value in the query is longer than 25 MB, the limit",
       "the store has a value of more than 25 MB"},
      {"DELETE FROM event",
       "a query may only read: no writing, attaching, transactions or settings",
       "its views are not those of its schema; `swarmsmith backup` makes a copy with the right "
       "ones"},
      {"SELECT 1, " + std::string(1 << 20, ' ') + "2", "the query is longer than 1 MB", ""}};
  for (const auto& [sql, typed, own] : cases) {
    const Error of_person = why_not(query(sql, {.seconds = 600, .memory = 3 << 20, .typed = true}));
    EXPECT_EQ(of_person.message, typed);
    EXPECT_EQ(of_person.where, sql.size() > (1 << 20) ? "" : sql);
    if (own.empty()) continue;
    const Error of_ours = why_not(query(sql, {.seconds = 600, .memory = 3 << 20}));
    EXPECT_EQ(of_ours.message, own);
    EXPECT_EQ(of_ours.where, "") << "that of the store";
  }
  EXPECT_EQ(to_string(why_not(query(" -- nothing"))),
            to_string(Error{ErrorKind::BadInput, "the query is empty", " -- nothing"}));
  const Error second = why_not(query("SELECT 1; SELECT 2"));
  EXPECT_EQ(second.message, "one statement at a time, please");
  EXPECT_EQ(second.where, " SELECT 2");
}

TEST_F(QueryTest, OfADamagedTableEndsAsAFailureOfTheStore) {
  reader.reset();
  const std::int64_t root =
      sqlite::integer_of(sqlite::Connection(path.string(), SQLITE_OPEN_READONLY),
                         "SELECT rootpage FROM sqlite_schema WHERE name = 'evaluation'");
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp((root - 1) * 8192)
      << std::string(8192, '\xff');
  reader = open_reader(path);
  EXPECT_THROW(static_cast<void>(query("SELECT count(*) FROM v_evaluations", {.typed = true})),
               StoreFailure);
  EXPECT_THAT(reader->integrity(), Contains("database disk image is malformed"))
      << "what cannot be looked for is a fault, too";
}

/// The rules for a statement of a person hold for it alone.
TEST_F(QueryInMemory, LeavesItsConnectionAsItWas) {
  constexpr int kLimits[] = {SQLITE_LIMIT_SQL_LENGTH, SQLITE_LIMIT_LIKE_PATTERN_LENGTH,
                             SQLITE_LIMIT_ATTACHED, SQLITE_LIMIT_WORKER_THREADS};
  const auto state = [&] {
    std::vector<std::int64_t> numbers;
    for (const int limit : kLimits)
      numbers.push_back(sqlite3_limit(memory.handle(), limit, -1));
    int views = -1;
    sqlite3_db_config(memory.handle(), SQLITE_DBCONFIG_ENABLE_VIEW, -1, &views);
    numbers.push_back(views);
    numbers.push_back(sqlite3_hard_heap_limit64(-1));
    return numbers;
  };
  const std::vector<std::int64_t> before = state();
  for (const StoreReader::QueryLimits& limits :
       {StoreReader::QueryLimits{}, StoreReader::QueryLimits{.seconds = 0},
        StoreReader::QueryLimits{.typed = true, .views_of_file = true}}) {
    std::vector<std::int64_t> within;
    const auto end = run_query(
        memory, "SELECT 1", limits, [&](const auto&) { within = state(); }, [](const auto&) {});
    ASSERT_TRUE(end);
    EXPECT_EQ(end->truncated, limits.seconds == 0);
    EXPECT_EQ(within[0], 1 << 20);
    EXPECT_EQ(within[4], limits.views_of_file ? 1 : 0);
    EXPECT_EQ(state(), before);
  }
  EXPECT_NO_THROW(memory.execute("ATTACH ':memory:' AS other"));
}

TEST_F(QueryInMemory, SharesItsMemoryWithAnotherAtTheSameTime) {
  const std::int64_t before = sqlite3_hard_heap_limit64(-1);
  sqlite::Connection second(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  std::int64_t with_one = 0, with_both = 0;
  const auto nothing = [](const auto&) {};
  EXPECT_TRUE(run_query(memory, "SELECT 1", {.memory = 9 << 20}, nothing, [&](const auto&) {
    with_one = sqlite3_hard_heap_limit64(-1);
    EXPECT_TRUE(run_query(second, "SELECT 2", {.memory = 5 << 20}, nothing,
                          [&](const auto&) { with_both = sqlite3_hard_heap_limit64(-1); }));
    EXPECT_EQ(sqlite3_hard_heap_limit64(-1), with_one);
  }));
  EXPECT_EQ(with_both - with_one, 5 << 20);
  EXPECT_EQ(sqlite3_hard_heap_limit64(-1), before);
  EXPECT_TRUE(query("SELECT 1", {.memory = 1})) << "a megabyte at least";
}

TEST_F(QueryInMemory, MayUseItsMemoryWhateverElseSqliteHas) {
  sqlite::Connection large(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  large.execute("CREATE TABLE t AS SELECT zeroblob(20000000) AS a");
  const auto bytes_of = [&](const std::string& sql) {
    const auto end = query(sql, {.memory = 8 << 20, .typed = true});
    return end ? rows.at(0).at(0).text.size() : 0;
  };
  EXPECT_EQ(bytes_of("SELECT printf('%.*c', 1000000, 'x')"), 1'000'000U);
  EXPECT_EQ(bytes_of("SELECT printf('%.*c', 20000000, 'x')"), 0U);
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

TEST_F(QueryInMemory, StopsAtTheLimitOfRows) {
  for (const std::int64_t most : {0, 2, 3, 4}) {
    const auto end = value_of(query("VALUES (1), (2), (3)", {.rows = most}));
    EXPECT_EQ(end.rows, std::min<std::int64_t>(most, 3));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(end.rows));
    EXPECT_EQ(end.truncated, most < 3);
  }
}

TEST_F(QueryInMemory, StopsAtTheLimitOfTimeAlsoBeforeTheFirstRow) {
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

/// Texts and blobs have their bytes, and each cell has a few of its own.
TEST_F(QueryInMemory, StopsAtTheLimitOfBytes) {
  const std::string sql =
      "SELECT printf('%0100d', a), zeroblob(50), a FROM (SELECT 1 AS a UNION"
      " SELECT 2 UNION SELECT 3)";
  const auto row = static_cast<std::int64_t>(150 + 3 * sizeof(Cell));
  for (const std::int64_t less : {0, 1}) {
    const auto end = value_of(query(sql, {.bytes = 3 * row - less}));
    EXPECT_EQ(end.rows, 3 - less);
    EXPECT_EQ(end.truncated, less == 1);
  }
  EXPECT_EQ(value_of(query(sql, {.bytes = 0})).rows, 0);
}

TEST_F(QueryInMemory, MayHaveARowOfFiftyMegabytes) {
  EXPECT_TRUE(query("SELECT zeroblob(26214400), zeroblob(26214400)"));
  EXPECT_EQ(complaint_of(query("SELECT zeroblob(26214400), zeroblob(26214400), 'x'")),
            "a row of the answer has 50 MB; the limit is 50 MB");
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
