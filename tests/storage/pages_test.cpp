#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "storage/internal/btree_page.h"
#include "storage/internal/page_image.h"
#include "storage/internal/sqlite.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_ahead_log.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kPage = 512;

/// A database file written by hand: bytes 0, but for the header.
class Pages : public testing::Test {
 protected:
  Pages() {
    bytes.replace(0, 16, "SQLite format 3\0", 16);
    put(16, 2, kPage);
  }

  /// A big-endian number of `count` bytes.
  void put(std::size_t at, std::size_t count, std::uint64_t value) {
    for (std::size_t i = count; i-- > 0; value >>= 8U)
      bytes[at + i] = static_cast<char>(value & 0xffU);
  }
  PageImage image() const {
    std::ofstream(path, std::ios::binary) << bytes;
    return value_of(PageImage::read(path));
  }
  PageImage image_with_log(const std::string& log) const {
    std::ofstream(path.string() + "-wal", std::ios::binary) << log;
    return image();
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  std::string bytes = std::string(200 * kPage, '\0');
};

TEST_F(Pages, FreeOnesAreListedByTheirTrunks) {
  put(32, 4, 2);
  put(kPage + 4, 4, 3);
  for (std::uint64_t i = 0; i < 3; ++i)
    put(kPage + 8 + 4 * i, 4, 10 + i);
  EXPECT_THAT(image().free_pages(), ElementsAre(2, 10, 11, 12));
}

TEST_F(Pages, ATrunkListsNoMoreThanItHolds) {
  put(32, 4, 2);
  put(kPage + 4, 4, 0xffffffff);
  EXPECT_EQ(image().free_pages().size(), 1 + (kPage / 4 - 2));
}

TEST_F(Pages, OfALogWithAnotherSizeAreNotTaken) {
  for (const std::size_t size : {kPage, 2 * kPage}) {
    std::ofstream(path.string() + "-wal", std::ios::binary)
        << write_ahead_log({{.page = 2, .pages_after = 200, .bytes = std::string(size, 'x')}},
                           static_cast<std::uint32_t>(size));
    EXPECT_EQ(image().page(2)[0], size == kPage ? 'x' : 0) << size;
  }
}

TEST_F(Pages, BehindSixteenMegabytesAreReadToo) {
  bytes.resize(17U << 20U);
  bytes[(16U << 20U) - 1] = 'a';
  bytes[16U << 20U] = 'b';
  const PageImage read = image();
  EXPECT_EQ(read.page((16U << 20U) / kPage).back(), 'a');
  EXPECT_EQ(read.page((16U << 20U) / kPage + 1).front(), 'b');
}

TEST_F(Pages, AreFreeAsFarAsTheTrunksLead) {
  put(32, 4, 2);
  put(kPage, 4, 5);
  put(kPage + 4, 4, 1);
  put(kPage + 8, 4, 9);
  for (const std::uint64_t next : {0U, 201U, 5U}) {  // the end, a page that is missing, itself
    put(4 * kPage, 4, next);
    const std::vector<std::uint32_t> free = image().free_pages();
    ASSERT_GE(free.size(), 3U);
    EXPECT_EQ(std::vector(free.begin(), free.begin() + 3), (std::vector<std::uint32_t>{2, 9, 5}));
    EXPECT_EQ(free.size(), next == 5 ? 200U : 3U) << "no more than the file has";
  }
}

TEST_F(Pages, HaveTheSizeOfAValidHeader) {
  struct Case {
    std::uint64_t said;
    std::size_t size;  ///< 0: not valid
  };
  for (const auto& [said, size] :
       {Case{512, 512}, Case{1024, 1024}, Case{32768, 32768}, Case{1, 65536}, Case{0, 0},
        Case{256, 0}, Case{1000, 0}, Case{0xffff, 0}}) {
    put(16, 2, said);
    put(60, 4, 0xfffffffe);
    const PageImage read = image();
    EXPECT_EQ(read.has_header(), size != 0) << said;
    EXPECT_EQ(read.knows_page_size(), size != 0) << said;
    EXPECT_EQ(read.page_size(), size != 0 ? size : 8192) << said;
    EXPECT_EQ(read.user_version(), size != 0 ? -2 : 0) << said;
  }
  put(16, 2, kPage);
  put(32, 4, 1);
  bytes[15] = 'x';
  EXPECT_FALSE(image().has_header()) << "the last byte of the name of the format";
  EXPECT_THAT(image().free_pages(), IsEmpty());
  bytes[15] = 0;
  bytes.resize(100);
  EXPECT_TRUE(image().has_header());
  EXPECT_EQ(image().user_version(), -2);
  bytes.resize(99);
  EXPECT_FALSE(image().has_header());
}

TEST_F(Pages, AreNumberedFromOneWithoutTheLastOneThatIsCutOff) {
  bytes.resize(3 * kPage + kPage - 1);
  bytes[2 * kPage] = 'a';
  const PageImage read = image();
  EXPECT_EQ(read.numbers(), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(read.bytes(), bytes.size());
  EXPECT_EQ(read.page(3).size(), kPage);
  EXPECT_EQ(read.page(3).front(), 'a');
  EXPECT_TRUE(read.page(0).empty());
  EXPECT_TRUE(read.page(4).empty());
}

std::string page_of(char letter) {
  return std::string(kPage, letter);
}

/// The first letters of pages 2 to 5, which are 'f' in the file.
std::string letters(const PageImage& image) {
  std::string text;
  for (std::uint32_t number = 2; number <= 5; ++number)
    text += static_cast<char>(image.page(number).front());
  return text;
}

TEST_F(Pages, OfALogCountUpToTheLastWholeCommit) {
  constexpr std::size_t kHeader = 32, kFrame = 24 + kPage;
  for (std::size_t page = 1; page < 5; ++page)
    bytes[page * kPage] = 'f';
  const std::string log = write_ahead_log({{2, 200, page_of('a')},
                                           {3, 0, page_of('b')},
                                           {2, 200, page_of('c')},
                                           {4, 200, page_of('d')},
                                           {5, 0, page_of('e')}},
                                          kPage);
  EXPECT_EQ(letters(image_with_log(log)), "cbdf");
  // Frame by frame, whole and without its last byte.
  const std::vector<std::string> after{"ffff", "afff", "afff", "cbff", "cbdf", "cbdf"};
  for (std::size_t frames = 0; frames < after.size(); ++frames) {
    const std::size_t size = kHeader + frames * kFrame;
    EXPECT_EQ(letters(image_with_log(log.substr(0, size))), after[frames]) << frames;
    if (frames > 0)
      EXPECT_EQ(letters(image_with_log(log.substr(0, size - 1))), after[frames - 1]) << frames;
  }
  EXPECT_EQ(letters(image_with_log(log.substr(0, kHeader - 1))), "ffff");
  // A frame of an older log, whose salts differ, ends it, whatever comes behind.
  std::string older = log.substr(kHeader, kFrame);
  older[8] = 'x';
  std::string with_older = log;
  with_older.insert(kHeader + kFrame, older);
  EXPECT_EQ(letters(image_with_log(with_older)), "afff");
  // So does each change of a frame's number, size, salts, checksums or page.
  const auto change_in = [&](std::size_t at) {
    std::string changed = log;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    return changed;
  };
  for (const std::size_t at : {0U, 4U, 8U, 15U, 16U, 20U, 24U, 24U + 511U}) {
    const std::string changed = change_in(kHeader + 3 * kFrame + at);
    EXPECT_EQ(letters(image_with_log(changed)), "cbff") << at;
  }
  for (const std::size_t at : {0U, 4U, 11U, 12U, 24U, 28U})
    EXPECT_EQ(letters(image_with_log(change_in(at))), "ffff") << at;
}

TEST_F(Pages, OfTheLogAloneComeAfterThoseOfTheFile) {
  const PageImage read = image_with_log(write_ahead_log(
      {{300, 0, page_of('x')}, {5, 0, page_of('y')}, {250, 300, page_of('z')}}, kPage));
  std::vector<std::uint32_t> wanted(200);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = static_cast<std::uint32_t>(i + 1);
  wanted.insert(wanted.end(), {250, 300});
  EXPECT_EQ(read.numbers(), wanted);
  EXPECT_EQ(read.bytes(), bytes.size() + 3 * kPage);
  EXPECT_EQ(read.page(300).front(), 'x');
  EXPECT_EQ(read.page(5).front(), 'y');
}

TEST_F(Pages, HaveTheHeaderThatTheLogHasIfThatOfTheFileIsLost) {
  std::string first = bytes.substr(0, kPage);
  first[63] = 7;  // user_version
  bytes.replace(0, 100, 100, 'x');
  const PageImage read = image_with_log(write_ahead_log({{1, 200, first}}, kPage));
  EXPECT_TRUE(read.has_header());
  EXPECT_EQ(read.page_size(), kPage);
  EXPECT_EQ(read.user_version(), 7);
  const PageImage sized = image_with_log(write_ahead_log({{2, 200, page_of('a')}}, kPage));
  EXPECT_FALSE(sized.has_header());
  EXPECT_TRUE(sized.knows_page_size());
  EXPECT_EQ(sized.page_size(), kPage);
  bytes.resize(99);  // too short for a header: the log's page has it nevertheless
  const PageImage cut = image_with_log(write_ahead_log({{1, 200, first}}, kPage));
  EXPECT_TRUE(cut.has_header());
  EXPECT_EQ(cut.user_version(), 0);
}

// --- pages of b-trees ---

std::string text_of(const StoredRecord& record) {
  std::string text = record.rowid ? fmt::format("{}:", *record.rowid) : "";
  for (const StoredValue& value : record.values) {
    switch (value.type) {
      case StoredValue::Type::Null:
        text += " null";
        break;
      case StoredValue::Type::Integer:
        text += fmt::format(" {}", value.integer);
        break;
      case StoredValue::Type::Real:
        text += fmt::format(" {}r", value.real);
        break;
      case StoredValue::Type::Text:
        text += " '" + value.bytes + "'";
        break;
      case StoredValue::Type::Blob:
        text += " x'" + value.bytes + "'";
    }
  }
  return text;
}

/// The same of the columns of a statement; if there is a rowid, it is the first one.
std::string text_of(const sqlite::Statement& row, bool has_rowid) {
  StoredRecord record;
  if (has_rowid) record.rowid = row.integer(0);
  for (int i = has_rowid ? 1 : 0; i < sqlite3_column_count(row.handle()); ++i) {
    const int type = sqlite3_column_type(row.handle(), i);  // before a value is converted
    StoredValue value{.integer = row.integer(i), .real = row.real(i), .bytes = row.text(i)};
    value.type = type == SQLITE_NULL      ? StoredValue::Type::Null
                 : type == SQLITE_INTEGER ? StoredValue::Type::Integer
                 : type == SQLITE_FLOAT   ? StoredValue::Type::Real
                 : type == SQLITE_TEXT    ? StoredValue::Type::Text
                                          : StoredValue::Type::Blob;
    record.values.push_back(std::move(value));
  }
  return text_of(record);
}

/// What is on all pages of a file.
struct Forest {
  std::vector<std::string> records;
  std::vector<std::uint32_t> children;
  std::int64_t broken = 0;
  std::size_t pages = 0;
  std::uint64_t chained = 0;  ///< what may still be read

  Forest(const PageImage& image, std::uint64_t may_read) : chained(may_read) {
    for (const std::uint32_t number : image.numbers()) {
      const auto page = read_btree_page(image, number, chained);
      if (!page) continue;
      ++pages;
      EXPECT_EQ(page->is_leaf, page->children.empty()) << number;
      children.insert(children.end(), page->children.begin(), page->children.end());
      broken += page->broken;
      for (const StoredRecord& record : page->records)
        records.push_back(text_of(record));
    }
    std::ranges::sort(records);
    std::ranges::sort(children);
  }
};

/// Values of each size that a record may have, and texts with each length around the sizes with
/// which SQLite begins to move them to other pages.
TEST_F(Pages, HaveTheRecordsThatSqliteReadsThere) {
  for (const std::size_t size : {std::size_t{512}, std::size_t{4096}}) {
    std::filesystem::remove(path);
    std::vector<std::string> wanted;
    {
      sqlite::Connection file(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
      file.execute(
          fmt::format("PRAGMA page_size = {}; BEGIN;"
                      "CREATE TABLE t (id INTEGER PRIMARY KEY, i INTEGER, r REAL, s, b);"
                      "CREATE TABLE w (k PRIMARY KEY, v TEXT) WITHOUT ROWID",
                      size));
      sqlite::Statement put(file, "INSERT INTO t VALUES (?,?,?,?,CAST(? AS BLOB))");
      std::int64_t id = 0;
      for (const int bits : {0, 7, 15, 23, 31, 47, 62}) {
        const std::int64_t most = (std::int64_t{1} << static_cast<unsigned>(bits)) - 1;
        for (const std::int64_t value : {most, most + 1, -most - 1, -most - 2})
          put.run(++id, value, 0.5 + static_cast<double>(bits), "text", "blob");
      }
      for (const std::int64_t rowid : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                       std::numeric_limits<std::int64_t>::max()})
        put.run(rowid, rowid, -1.25, "", "");
      file.execute("INSERT INTO t (id) VALUES (900000)");
      sqlite::Statement key(file, "INSERT INTO w VALUES (?,?)");
      const std::size_t step = size / 512;
      for (std::size_t length = 0; length <= 1100 * step; length += length < 1100 ? 1 : step) {
        put.run(static_cast<std::int64_t>(1000 + length), 5, 0.25, std::string(length, 's'), "b");
        key.run(fmt::format("{:05}", length), std::string(length, 'v'));
      }
      file.execute("COMMIT");
      for (const std::string sql : {"SELECT id, NULL, i, r, s, b FROM t",
                                    "SELECT rowid, * FROM sqlite_schema", "SELECT * FROM w"}) {
        sqlite::Statement row(file, sql);
        while (row.step())
          wanted.push_back(text_of(row, !sql.ends_with("w")));
      }
    }
    std::ranges::sort(wanted);
    const PageImage read = value_of(PageImage::read(path));
    ASSERT_EQ(read.page_size(), size);
    const Forest forest(read, 1U << 30U);
    EXPECT_TRUE(forest.records == wanted) << "of pages of " << size << " bytes";
    EXPECT_EQ(forest.broken, 0);
    // Each page belongs to a tree or to the chain of one record. Three are roots.
    EXPECT_EQ(forest.children.size(), forest.pages - 3);
    EXPECT_EQ(std::ranges::adjacent_find(forest.children), forest.children.end());
    const std::uint64_t in_chains = (read.numbers().size() - forest.pages) * size;
    EXPECT_EQ((1U << 30U) - forest.chained, in_chains);
    EXPECT_GT(in_chains, 0U);
    EXPECT_EQ(Forest(read, in_chains).broken, 0);
    EXPECT_EQ(Forest(read, in_chains - 1).broken, 1);
  }
}

/// Page 2 alone, written by hand.
struct PageByHand : Pages {
  /// The records of the page and the number of broken cells, as a text: "7: 1 null, broken 1".
  std::string shown() {
    std::uint64_t chained = 1 << 20;
    const auto page = read_btree_page(image(), 2, chained);
    if (!page) return "no page";
    std::vector<std::string> parts;
    for (const StoredRecord& record : page->records)
      parts.push_back(text_of(record));
    if (!page->children.empty())
      parts.push_back(fmt::format("to {}", fmt::join(page->children, " ")));
    if (page->broken != 0) parts.push_back(fmt::format("broken {}", page->broken));
    return fmt::format("{}", fmt::join(parts, ", "));
  }
  /// The page as a leaf with one cell, as much of it as there is room for at that place.
  std::string with_cell(const std::string& cell, std::size_t at = 100) {
    bytes.replace(kPage, kPage, kPage, '\0');
    put(kPage, 1, 0x0d);
    put(kPage + 3, 2, 1);
    put(kPage + 8, 2, at);
    const std::string part = cell.substr(0, kPage - at);
    bytes.replace(kPage + at, part.size(), part);
    return shown();
  }
  /// A cell of row 7 with this payload, which is shorter than 128 bytes.
  static std::string cell(const std::string& payload) {
    return std::string(1, static_cast<char>(payload.size())) + "\x07" + payload;
  }
};

TEST_F(PageByHand, HasOneOfFourKinds) {
  for (int kind = 0; kind < 256; ++kind) {
    bytes.replace(kPage, kPage, kPage, '\0');
    put(kPage, 1, static_cast<std::uint64_t>(kind));
    put(kPage + 3, 2, 1);
    put(kPage + 8, 4, 31);
    put(kPage + 12, 2, 200);
    put(kPage + 200, 4, 30);
    bytes.replace(kPage + 204, 3, "\x02\x02\x08");
    EXPECT_EQ(shown(), kind == 5                  ? "to 30 31"
                       : kind == 2                ? " 0, to 30 31"
                       : kind == 10 || kind == 13 ? "broken 1"
                                                  : "no page")
        << kind;
  }
  std::uint64_t chained = 0;
  EXPECT_FALSE(read_btree_page(image(), 201, chained)) << "which does not exist";
}

TEST_F(PageByHand, TakesRecordsThatEndWhereTheyAnnounce) {
  const std::string one("\x01");
  const std::pair<std::string, std::string> cases[] = {
      {std::string("\x02\x08", 2), "7: 0"},
      {std::string("\x02\x09", 2), "7: 1"},
      {std::string("\x02\x00", 2), "7: null"},
      {one, "7:"},
      {std::string("\x02\x01\xff", 3), "7: -1"},
      {std::string("\x03\x01\x0f\x05z", 5), "7: 5 'z'"},
      {std::string("\x03\x0c\x0d", 3), "7: x'' ''"},
      {std::string("\x02\x0ez", 3), "7: x'z'"},
      {std::string("\x02\x07\x3f\xe0\0\0\0\0\0\0", 10), "7: 0.5r"},
      // Types that SQLite reserves, and headers and values that are too short or too long.
      {std::string("\x02\x0a", 2), "broken 1"},
      {std::string("\x02\x0b", 2), "broken 1"},
      {std::string("\x00", 1), "broken 1"},
      {"", "broken 1"},
      {std::string("\x03\x08", 2), "broken 1"},
      {std::string("\x02\x81\x08", 3), "broken 1"},
      {std::string("\x02\x01", 2), "broken 1"},
      {std::string("\x02\x08\x05", 3), "broken 1"},
      {std::string("\x02\x01\x05\x05", 4), "broken 1"},
  };
  for (const auto& [payload, wanted] : cases)
    EXPECT_EQ(with_cell(cell(payload)), wanted) << fmt::format(
        "{:02x}", fmt::join(std::vector<unsigned char>(payload.begin(), payload.end()), " "));
}

TEST_F(PageByHand, TakesCellsBetweenItsListAndItsEnd) {
  const std::string shortest = cell(std::string("\x02\x08", 2));
  EXPECT_EQ(with_cell(shortest, kPage - 4), "7: 0");
  EXPECT_EQ(with_cell(cell("\x01"), kPage - 3), "broken 1") << "no cell is so short";
  EXPECT_EQ(with_cell(shortest, 10), "7: 0") << "right behind the list";
  // In the list itself: the last byte of the list, 9, is the size of a record of a blob.
  EXPECT_EQ(with_cell(std::string("\x09\x07\x02\x1a", 4) + "seven b", 9), "broken 1");
  const std::string longer = cell(std::string("\x02\x1bsevenby", 9));
  ASSERT_EQ(with_cell(longer, kPage - longer.size()), "7: 'sevenby'");
  EXPECT_EQ(with_cell(longer, kPage - longer.size() + 1), "broken 1");
  EXPECT_EQ(with_cell(std::string("\x84\x84\x84\x84", 4), kPage - 4), "broken 1") << "no number";
  EXPECT_EQ(with_cell(std::string("\x81\x81\x81\x01", 4), kPage - 4), "broken 1") << "no rowid";
}

TEST_F(PageByHand, ListsNoMoreCellsThanItHasRoomFor) {
  put(kPage, 1, 0x0d);
  put(kPage + 3, 2, (kPage - 8) / 2);
  EXPECT_EQ(shown(), fmt::format("broken {}", (kPage - 8) / 2));
  put(kPage + 3, 2, (kPage - 8) / 2 + 1);
  EXPECT_EQ(shown(), "no page");
}

/// A record of 600 bytes has its first 92 on the page and 508 on another; one of 1,108 has two.
TEST_F(PageByHand, FollowsAChainThatIsAsLongAsItsRecord) {
  const auto shown_with = [&](std::size_t size, std::uint64_t first, std::uint64_t second,
                              std::uint64_t third) {
    const std::size_t type = 12 + 2 * (size - 3);
    std::string whole;
    for (const std::size_t number : {size, std::size_t{0}, type}) {
      if (number == 0) {
        whole += "\x07\x03";
        continue;
      }
      whole += static_cast<char>(0x80U | number >> 7U);
      whole += static_cast<char>(number & 0x7fU);
    }
    for (const std::size_t page : {2U, 3U, 4U})
      bytes.replace(page * kPage, kPage, kPage, 'x');
    put(2 * kPage, 4, second);
    put(3 * kPage, 4, third);
    put(4 * kPage, 4, 0);
    std::string cell = whole + std::string(89, 'x') + std::string(4, '\0');
    cell.back() = static_cast<char>(first);
    return with_cell(cell);
  };
  const auto blob = [](std::size_t size) { return "7: x'" + std::string(size - 3, 'x') + "'"; };
  EXPECT_EQ(shown_with(600, 3, 0, 0), blob(600));
  EXPECT_EQ(shown_with(600, 3, 4, 0), "broken 1") << "longer";
  EXPECT_EQ(shown_with(600, 201, 0, 0), "broken 1") << "no page";
  EXPECT_EQ(shown_with(1108, 3, 4, 0), blob(1108));
  EXPECT_EQ(shown_with(1108, 4, 3, 3), "broken 1") << "longer";
  EXPECT_EQ(shown_with(1108, 3, 3, 0), "broken 1") << "a circle";
  EXPECT_EQ(shown_with(1108, 3, 0, 0), "broken 1") << "shorter";
}

}  // namespace
}  // namespace swarmsmith
