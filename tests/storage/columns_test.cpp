#include "storage/internal/columns.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

// The lists of columns against the tables that the scripts make, schema by schema.

namespace swarmsmith {
namespace {

class Columns : public ::testing::TestWithParam<std::int64_t> {
 protected:
  Columns() : memory_(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) {
    create_tables(memory_, GetParam());
  }

  std::vector<std::string> columns_in(std::string_view table) {
    std::vector<std::string> names;
    sqlite::Statement column(memory_, "SELECT name FROM pragma_table_xinfo(?)");
    column.bind(table);
    while (column.step())
      names.push_back(column.text(0));
    return names;
  }

  /// Those of the list that a store of the schema has, and columns of the table that are not in it.
  template <std::size_t N>
  void expect(const TableColumns<N>& listed, std::vector<std::string> others = {}) {
    std::vector<std::string> left = columns_in(listed.table);
    for (const StoredColumn& column : listed.columns) {
      const bool is_there = std::erase(left, column.name) > 0;
      EXPECT_EQ(is_there, column.since <= GetParam()) << listed.table << "." << column.name;
    }
    for (const std::string& other : others)
      std::erase(left, other);
    EXPECT_THAT(left, IsEmpty()) << listed.table;
    if (!columns_in(listed.table).empty()) {
      EXPECT_NO_THROW(sqlite::Statement(
          memory_, "SELECT " + listed.names(GetParam()) + " FROM " + std::string(listed.table)));
    }
  }

  sqlite::Connection memory_;
};

INSTANTIATE_TEST_SUITE_P(Schemas, Columns, ::testing::Range(std::int64_t{1}, kSchemaVersion + 1));

TEST_P(Columns, AreThoseOfTheTables) {
  expect(kCandidateColumns);
  expect(kPairColumns);
  expect(kEvaluationColumns, {"iteration", "row_check"});
  expect(kIterationColumns);
  expect(kRaceStepColumns);
  expect(kEliminationColumns);
  expect(kEliteColumns);
  expect(kTotalsColumns);
  expect(kDesignStateColumns,
         {"campaign", "mission", "method", "flavour", "name", "repetition", "seed", "budget"});
  expect(kCommandColumns, {"time"});
}

/// A view whose table is newer than the store cannot be used; others can.
TEST_P(Columns, AreThoseThatTheLentViewsNeed) {
  finish_schema(memory_, GetParam());
  configure_reader(memory_);
  lend_views(memory_);
  std::vector<std::string> views;
  sqlite::Statement view(memory_, "SELECT name FROM temp.sqlite_schema");
  while (view.step())
    views.push_back(view.text(0));
  EXPECT_EQ(views.empty(), GetParam() < kTablesVersion);
  for (const std::string& name : views) {
    try {
      sqlite::Statement(memory_, "SELECT * FROM temp." + name);
    } catch (const sqlite::SqliteError& error) {
      EXPECT_THAT(std::string(error.what()), StartsWith("no such table"))
          << name << ": raise kTablesVersion";
    }
  }
}

/// Whatever is measured arrives: in the view, and where rows are read again.
TEST(MeasuredNumbers, AreInTheViewOfEvaluationsAndAreReadAgain) {
  Measured measured;
  const auto fields = measured_fields(measured);
  int number = 0;
  const auto count = [&]<class Field>(Field& field) { field = static_cast<Field>(++number); };
  std::apply([&](auto&... each) { (count(each), ...); }, fields);
  const TemporaryFolder folder;
  const SyntheticCampaign campaign =
      synthetic_campaign({.designs = 1, .iterations = 1, .candidates = 4});
  const CandidateId candidate = candidate_id({1}, 1);
  {
    auto store = open_store(folder / "s.db", campaign);
    store->append(
        {CandidateRow{.id = candidate, .iteration = 1, .parameters = "{}", .modules = "{}"},
         PairRow{.design = {1}, .purpose = Purpose::Test, .number = 1, .instance = 1, .seed = 1},
         EvaluationRow{
             .key = {candidate, Purpose::Test, 1}, .measured = measured, .source = "rvr"}});
    ASSERT_TRUE(store->flush());
  }
  const auto reader = open_reader(folder / "s.db");
  constexpr auto kShown =
      std::to_array<std::string_view>({"score", "state_digest", "1000 * wall_ms", "time"});
  static_assert(kShown.size() == kMeasuredFields);
  for (std::size_t i = 0; i < kShown.size(); ++i) {
    EXPECT_THAT(cells_of(*reader, "SELECT CAST(" + std::string(kShown[i]) +
                                      " AS INTEGER) FROM v_evaluations"),
                ElementsAre(ElementsAre(std::to_string(i + 1))))
        << kShown[i];
  }
  const std::vector<StoredScore> scores = reader->scores();
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_EQ(measured_fields(scores.front().measured), fields);
}

TEST(RowsOfAStore, HaveTheFieldsThatTheyAreMadeOf) {
  sqlite::Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  create_schema(memory);
  EXPECT_FALSE(is_blank(memory));
  write_campaign(memory, {.name = "n", .digest = "d", .deciding = "{}", .file = "f", .seed = 3});
  DesignRow design{.id = {2},
                   .mission = "m",
                   .method = "w",
                   .flavour = "watermelon",
                   .repetition = 4,
                   .seed = 5,
                   .budget = 6};
  write_designs(memory, {design}, 1, 10);
  design.mission = "another";
  write_designs(memory, {design}, 1, 10);
  write_maker(memory);
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  EXPECT_EQ(sqlite::text_of(memory,
                            "SELECT id || ' ' || name || ' ' || digest ||"
                            " ' ' || deciding || ' ' || file || ' ' || seed || ' ' || state"
                            " FROM campaign"),
            "1 n d {} f 3 running");
  EXPECT_EQ(sqlite::text_of(memory,
                            "SELECT group_concat(id || ' ' || campaign || ' ' || mission || ' ' ||"
                            " method || ' ' || flavour || ' ' || repetition || ' ' || seed || ' '"
                            " || budget) FROM design"),
            "12 1 m w watermelon 4 5 6");
  EXPECT_EQ(sqlite::text_of(memory, "SELECT group_concat(key || '=' || value) FROM meta"),
            std::string("host=") + host.data() + ",sqlite=" + sqlite3_libversion());
}

TEST(InsertOfColumns, NamesEachAndHasAMarkForIt) {
  EXPECT_EQ(kPairColumns.insert(),
            "INSERT INTO pair (design, purpose, number, instance, seed) VALUES (?,?,?,?,?)");
  EXPECT_EQ(kTotalsColumns.insert({"extra"}),
            "INSERT INTO candidate_totals (candidate, runs, score_sum, score_squares, extra)"
            " VALUES (?,?,?,?,?)");
}

}  // namespace
}  // namespace swarmsmith
