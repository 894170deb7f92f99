#include "storage/internal/table_shape.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace swarmsmith
