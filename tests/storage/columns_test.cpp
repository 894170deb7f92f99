#include "storage/internal/columns.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
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

TEST(InsertOfColumns, NamesEachAndHasAMarkForIt) {
  EXPECT_EQ(kPairColumns.insert(),
            "INSERT INTO pair (design, purpose, number, instance, seed) VALUES (?,?,?,?,?)");
  EXPECT_EQ(kTotalsColumns.insert({"extra"}),
            "INSERT INTO candidate_totals (candidate, runs, score_sum, score_squares, extra)"
            " VALUES (?,?,?,?,?)");
}

}  // namespace
}  // namespace swarmsmith
