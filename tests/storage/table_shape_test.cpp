#include "storage/internal/table_shape.h"

#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

using Type = StoredValue::Type;

/// The shape of a table with a column of each type.
TableShape shape() {
  sqlite::Connection connection(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  connection.execute(
      "CREATE TABLE t (id INTEGER PRIMARY KEY, note TEXT NOT NULL, score REAL, digest BLOB) "
      "STRICT");
  return table_shapes(connection).front();
}

StoredRecord record(StoredValue note, StoredValue score = {}, StoredValue digest = {}) {
  return {.rowid = 7, .values = {{}, std::move(note), std::move(score), std::move(digest)}};
}

StoredValue text(const std::string& bytes) {
  return {.type = Type::Text, .bytes = bytes};
}

TEST(TableShape, TakesTextsAsTheyAreWritten) {
  const TableShape table = shape();
  for (const char* good : {"", "plain", "two\r\nlines\tand \x1b[1mcolour", "\xc3\xa9",
                           "\xe2\x82\xac", "\xf0\x9f\x90\x9d"})
    EXPECT_TRUE(table.fits(record(text(good)))) << good;
  for (const char* bad : {"\xc3", "\xc3x", "\xe2\x82", "\xe2\x82x", "\xf0\x9f\x90",
                          "\xf8\x88\x80\x80\x80", "\x80", "a\xff"})
    EXPECT_FALSE(table.fits(record(text(bad))));
}

TEST(TableShape, RefusesTextsWithControlCharacters) {
  const TableShape table = shape();
  int taken = 0;
  for (char byte = 0; byte < 0x20; ++byte)
    taken += table.fits(record(text(std::string("a") + byte + "b"))) ? 1 : 0;
  EXPECT_EQ(taken, 4) << "line feed, carriage return, tab, escape";
}

TEST(TableShape, RefusesValuesOfAnotherTypeOrNumber) {
  const TableShape table = shape();
  const StoredValue whole{.type = Type::Integer, .integer = 3};
  const StoredValue half{.type = Type::Real, .real = 0.5};
  const StoredValue blob{.type = Type::Blob, .bytes = "\x01"};
  EXPECT_TRUE(table.fits(record(text("a"), half, blob)));
  EXPECT_TRUE(table.fits(record(text("a"), whole, blob))) << "as SQLite stores whole reals";
  EXPECT_FALSE(table.fits(record({}))) << "not null";
  EXPECT_FALSE(table.fits(record(whole)));
  EXPECT_FALSE(table.fits(record(text("a"), text("b"))));
  EXPECT_FALSE(table.fits(record(text("a"), half, text("b"))));
  StoredRecord other = record(text("a"));
  other.values[0] = whole;
  EXPECT_FALSE(table.fits(other)) << "the rowid stands in no column";
  other = record(text("a"));
  other.values.push_back({});
  EXPECT_FALSE(table.fits(other)) << "one too many";
  other = record(text("a"));
  other.rowid.reset();
  EXPECT_FALSE(table.fits(other));
}

TEST(TableShape, TakesRecordsFromBeforeColumnsWereAdded) {
  TableShape table = shape();
  StoredRecord known = record(text("a"));
  for (std::size_t least = 0; least <= 5; ++least) {
    table.least_columns = least;
    EXPECT_EQ(table.fits(known), least <= 4) << least;
  }
  table.least_columns = 0;
  known.values.clear();
  EXPECT_FALSE(table.fits(known)) << "a record without values";
  EXPECT_FALSE(table.fits(
      record(text("a"), {.type = Type::Real, .real = std::numeric_limits<double>::infinity()})));
}

/// Name, tree and columns of each table, in the order of the record; "=" stands for the rowid.
TEST(TableShape, FollowsFromTheTable) {
  sqlite::Connection connection(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  connection.execute(
      "CREATE TABLE keyed (a TEXT NOT NULL, k2 INTEGER, k1 TEXT, b REAL, PRIMARY KEY (k1, k2))"
      " STRICT, WITHOUT ROWID;"
      "CREATE TABLE named (id TEXT PRIMARY KEY, n INTEGER) STRICT;"
      "CREATE TABLE later (note TEXT, id INTEGER PRIMARY KEY) STRICT;"
      "CREATE VIEW v AS SELECT 1");
  std::vector<std::string> shown;
  for (const TableShape& table : table_shapes(connection)) {
    std::string line = table.name + " in " + table.tree + (table.has_rowids ? " rowids:" : ":");
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      line += (static_cast<int>(i) == table.alias ? " =" : " ") + table.columns[i].name + " " +
              table.columns[i].type + (table.columns[i].may_be_null ? " or null" : "");
    }
    shown.push_back(line);
  }
  EXPECT_EQ(shown, (std::vector<std::string>{
                       "keyed in keyed: k1 TEXT k2 INTEGER a TEXT b REAL or null",
                       "later in later rowids: note TEXT or null =id INTEGER",
                       "named in named rowids: id TEXT n INTEGER or null",
                       "source in sqlite_autoindex_source_1: name TEXT id INTEGER"}));
  const TableShape keyed = table_shapes(connection).front();
  EXPECT_EQ(keyed.insertion(1), "INSERT OR IGNORE INTO keyed (k1) VALUES (?)");
  EXPECT_EQ(keyed.insertion(3), "INSERT OR IGNORE INTO keyed (k1, k2, a) VALUES (?,?,?)");
}

}  // namespace
}  // namespace swarmsmith
