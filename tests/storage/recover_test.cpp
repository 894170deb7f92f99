#include "storage/recover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "base/rng.h"
#include "storage/internal/page_image.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/synthetic_real_run.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_ahead_log.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPage = 8192;

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// A store of some 40 pages, which is damaged and recovered.
struct RecoverTest : testing::Test {
  TemporaryFolder folder;
  fs::path damaged = folder / "damaged.db", out = folder / "out.db";
  SyntheticCampaign campaign =
      synthetic_campaign({.designs = 2, .iterations = 6, .candidates = 40});
  std::string bytes, digest;

  void SetUp() override {
    fill_store(damaged, campaign);
    digest = digest_of(damaged);
    for (const char* ending : {"-wal", "-shm"})
      fs::remove(damaged.string() + ending);
    bytes = whole_file(damaged);
    ASSERT_GT(bytes.size(), 20 * kPage);
  }

  /// The digest of what comes out; the file is there afterwards.
  std::string recovered() {
    fs::remove(out);
    auto recovery = Recovery::begin(damaged, out);
    EXPECT_TRUE(recovery) << to_string(recovery.error());
    if (!recovery) return "";
    if ((*recovery)->campaigns().empty()) (*recovery)->put_campaign(campaign.campaign);
    const auto put = (*recovery)->put_designs((*recovery)->campaigns().front(), campaign.designs);
    EXPECT_TRUE(put) << to_string(put.error());
    found = (*recovery)->found();
    const auto end = (*recovery)->finish();
    EXPECT_TRUE(end) << to_string(end.error());
    doubt = end ? end->doubt : "";
    without_parent = end ? end->without_parent : 0;
    return end ? end->digest : "";
  }
  Salvaged found;
  std::string doubt;
  std::int64_t without_parent = 0;

  /// Every row of `reader` that the original has, too, and how many there are.
  std::size_t expect_no_other_rows() {
    const fs::path original = folder / "original.db";
    write_bytes(original, bytes);
    const auto whole = cells_of(*open_reader(original), kScores);
    const std::set<std::vector<std::string>> known(whole.begin(), whole.end());
    const auto rows = cells_of(*open_reader(out), kScores);
    for (const auto& row : rows)
      EXPECT_TRUE(known.contains(row)) << row[0];
    return rows.size();
  }
  static constexpr const char* kScores =
      "SELECT id, score, state_digest, source FROM v_evaluations";
};

/// What was lost of each table that lost something: "pair: 2 pages, 1 broken".
std::string losses(const Salvaged& found) {
  std::string text;
  for (const SalvagedTable& table : found.tables) {
    if (table.lost_pages == 0 && table.broken == 0 && !table.tree_is_lost) continue;
    text += (text.empty() ? "" : ", ") + table.name + ": " + std::to_string(table.lost_pages) +
            " pages, " + std::to_string(table.broken) + " broken" +
            (table.tree_is_lost ? ", tree" : "");
  }
  return text;
}

TEST_F(RecoverTest, AWholeStoreComesOutWhole) {
  EXPECT_EQ(recovered(), digest);
  EXPECT_FALSE(found.header_is_damaged);
  EXPECT_EQ(found.unplaced, 0);
  EXPECT_EQ(found.schema, kSchemaVersion);
  EXPECT_EQ(found.pages, static_cast<std::int64_t>(bytes.size() / kPage));
  EXPECT_EQ(found.changed_evaluations, 0);
  EXPECT_EQ(losses(found), "");
  sqlite::Connection connection(damaged.string(), SQLITE_OPEN_READONLY);
  for (const SalvagedTable& table : not_empty(found.tables)) {
    EXPECT_EQ(table.rows, sqlite::integer_of(connection, "SELECT count(*) FROM " + table.name))
        << table.name;
  }
  EXPECT_EQ(
      static_cast<std::int64_t>(found.tables.size()),
      sqlite::integer_of(connection, "SELECT count(*) FROM sqlite_schema WHERE type = 'table'"));
}

TEST_F(RecoverTest, RowsThatAreNoTextsOfAStoreAreBroken) {
  sqlite::Connection connection(damaged.string(), SQLITE_OPEN_READWRITE);
  connection.execute("UPDATE elimination SET reason = 'a' || char(1) WHERE candidate % 2 = 0");
  const auto changed = connection.changes();
  ASSERT_GT(changed, 1);
  const std::int64_t all = sqlite::integer_of(connection, "SELECT count(*) FROM elimination");
  EXPECT_NE(recovered(), digest);
  EXPECT_EQ(losses(found), "elimination: 0 pages, " + std::to_string(changed) + " broken");
  EXPECT_EQ(std::ranges::find(found.tables, "elimination", &SalvagedTable::name)->rows,
            all - changed);
}

/// The first page of a table's tree, counted from 0.
std::size_t root_of(const fs::path& store, const std::string& name) {
  return static_cast<std::size_t>(
      sqlite::integer_of(sqlite::Connection(store.string(), SQLITE_OPEN_READONLY),
                         "SELECT rootpage - 1 FROM sqlite_schema WHERE name = '" + name + "'"));
}

TEST_F(RecoverTest, ARowThatItsPageHasLostIsBroken) {
  const std::size_t root = root_of(damaged, "elite") * kPage;
  ASSERT_EQ(bytes[root], 10) << "a page with rows";
  std::string broken = bytes;
  broken.replace(root + 8, 2, 2, '\0');  // where the first row is
  write_bytes(damaged, broken);
  recovered();
  EXPECT_EQ(losses(found), "elite: 0 pages, 1 broken");
}

TEST_F(RecoverTest, PagesToWhichNoTreeLeadsHaveTheirRows) {
  const std::size_t root = root_of(damaged, "candidate") * kPage;
  ASSERT_EQ(bytes[root], 5) << "a page that leads to others";
  std::string broken = bytes;
  broken.replace(root, kPage, kPage, '\0');
  write_bytes(damaged, broken);
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(losses(found), "candidate: 1 pages, 0 broken");
  EXPECT_EQ(found.unplaced, 0);
  // As a page of another kind, which no table with rowids has.
  broken[root] = 10;
  write_bytes(damaged, broken);
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(losses(found), "candidate: 1 pages, 0 broken");
}

TEST_F(RecoverTest, RowsOfAPageBehindTheOthersGoToTheOneTableThatTheyFit) {
  const fs::path other = folder / "other.db";
  {
    sqlite::Connection connection(other.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    connection.execute(
        "PRAGMA page_size = 8192; CREATE TABLE t (id INTEGER PRIMARY KEY, name TEXT);"
        "INSERT INTO t VALUES (700, 'a source'), (701, 'another'), (702, NULL)");
  }
  write_bytes(damaged, bytes + whole_file(other).substr(kPage, kPage));
  EXPECT_EQ(recovered(), digest) << "no score is of these sources";
  EXPECT_EQ(std::ranges::find(found.tables, "source", &SalvagedTable::name)->rows, 3);
  EXPECT_EQ(found.unplaced, 0);
  EXPECT_EQ(found.pages, static_cast<std::int64_t>(bytes.size() / kPage) + 1);
  EXPECT_EQ(losses(found), "");
}

/// Fourteen whole numbers are an evaluation with its time and bound, or a floor tag of a film.
TEST_F(RecoverTest, RowsThatMayBeOfTwoTablesAreOfNone) {
  const fs::path other = folder / "other.db";
  sqlite::Connection(other.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE)
      .execute(
          "PRAGMA page_size = 8192; CREATE TABLE t (a, b, c, d, e, f, g, h, i, j, k, l, m, n,"
          " PRIMARY KEY (a, b, c)) WITHOUT ROWID; INSERT INTO t VALUES"
          " (1, 0, 77, 1, 0, 5, 6, 1, 8, 9, 1, 11, 12, 13), (1, 0, 78, 1, 0, 5, 6, 1, 8, 9, 1, 11,"
          " 12, 13)");
  write_bytes(damaged, bytes + whole_file(other).substr(kPage, kPage));
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(found.unplaced, 2);
  EXPECT_EQ(losses(found), "");
}

TEST_F(RecoverTest, ATreeThatLeadsBackToItselfIsFollowedOnce) {
  const std::size_t root = root_of(damaged, "candidate");
  std::string broken = bytes;
  broken[root * kPage + 10] = static_cast<char>((root + 1) >> 8U);
  broken[root * kPage + 11] = static_cast<char>((root + 1) & 0xffU);
  write_bytes(damaged, broken);
  EXPECT_EQ(recovered(), digest) << "the last page, to which nothing leads now, is found, too";
  EXPECT_EQ(losses(found), "");
}

TEST_F(RecoverTest, WhatWasDeletedStaysDeleted) {
  {
    sqlite::Connection connection(damaged.string(), SQLITE_OPEN_READWRITE);
    connection.execute(
        "PRAGMA secure_delete = OFF; WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM"
        " n LIMIT 3000) INSERT INTO event (severity, kind, text) SELECT 'info', 'mark', i FROM n;"
        "DELETE FROM event WHERE kind = 'mark'; PRAGMA wal_checkpoint(TRUNCATE)");
    ASSERT_GT(sqlite::integer_of(connection, "PRAGMA freelist_count"), 5);
  }
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(std::ranges::find(found.tables, "event", &SalvagedTable::name)->rows, 0);
  EXPECT_EQ(losses(found), "");
}

/// The size of pages follows from what is on them, or from the log.
TEST_F(RecoverTest, WithoutHeaderPagesOfAnySizeAreFound) {
  sqlite::Connection(damaged.string(), SQLITE_OPEN_READWRITE)
      .execute("PRAGMA journal_mode = DELETE; PRAGMA page_size = 4096; VACUUM");
  const std::string small = whole_file(damaged);
  write_bytes(damaged, std::string(100, '\0') + small.substr(100));
  EXPECT_EQ(recovered(), digest);
  EXPECT_TRUE(found.header_is_damaged);
  EXPECT_EQ(found.schema, kSchemaVersion);
  EXPECT_EQ(found.pages, static_cast<std::int64_t>(small.size() / 4096));
  const std::string log =
      write_ahead_log({{.page = 3, .pages_after = 1, .bytes = small.substr(2 * 4096, 4096)}}, 4096);
  write_bytes(damaged.string() + "-wal", log);
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(found.schema, kSchemaVersion);
  EXPECT_EQ(found.pages, static_cast<std::int64_t>(small.size() / 4096));
}

TEST_F(RecoverTest, AScoreThatAnotherProgramChangedIsLeftOut) {
  sqlite::Connection(damaged.string(), SQLITE_OPEN_READWRITE)
      .execute("UPDATE evaluation SET score = score + 1 WHERE candidate = 3 AND pair = 2");
  EXPECT_NE(recovered(), digest);
  EXPECT_EQ(found.changed_evaluations, 1);
  expect_no_other_rows();
}

TEST_F(RecoverTest, WhatCannotBeToldIsDoubted) {
  for (const char* sql : {"UPDATE source SET name = 'x'", "UPDATE campaign SET state = 'x'",
                          "UPDATE evaluation SET worker = worker + 1",
                          // Of a store of an earlier schema, whose rows say nothing of themselves.
                          "UPDATE evaluation SET score = score + 1, row_check = NULL"}) {
    SCOPED_TRACE(sql);
    write_bytes(damaged, bytes);
    sqlite::Connection(damaged.string(), SQLITE_OPEN_READWRITE).execute(sql);
    recovered();
    EXPECT_THAT(doubt, HasSubstr("not those that were committed"));
    EXPECT_EQ(found.changed_evaluations, 0);
    EXPECT_EQ(cells_of(*open_reader(out), "SELECT state FROM v_campaigns")[0][0], "distrusted");
  }
}

TEST_F(RecoverTest, WithoutHeaderOrFirstPageNothingIsLost) {
  for (const std::size_t lost : {std::size_t{16}, kPage}) {
    write_bytes(damaged, std::string(lost, '\xff') + bytes.substr(lost));
    EXPECT_FALSE(StoreReader::open(damaged));
    EXPECT_EQ(recovered(), digest) << lost << " bytes";
    EXPECT_TRUE(found.header_is_damaged);
  }
}

/// The same store with three real runs, one of a candidate, one with a person's word on it.
struct RecoverRealRuns : RecoverTest {
  std::vector<RealRunRows> runs;

  void SetUp() override {
    RecoverTest::SetUp();
    {
      const auto store = StoreAtRest::open(damaged, StoreAtRest::IfMissing::Refuse);
      for (std::uint64_t number = 1; number <= 3; ++number) {
        const CandidateId candidate = number == 2 ? candidate_id({1}, 1) : CandidateId{};
        ASSERT_TRUE((*store)->add_real_run(synthetic_real_run(number, candidate, 400)));
      }
      ASSERT_TRUE((*store)->add_override({{3}, "DEGRADED", "ada", "x"}));
    }
    for (std::int64_t id = 1; id <= 3; ++id)
      runs.push_back(*open_reader(damaged)->real_run({id}));
    bytes = whole_file(damaged);
  }
};

TEST_F(RecoverRealRuns, AWholeStoreComesOutWhole) {
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(found.unplaced, 0);
  const auto reader = open_reader(out);
  for (std::int64_t id = 1; id <= 3; ++id)
    EXPECT_EQ(*reader->real_run({id}), runs[static_cast<std::size_t>(id - 1)]);
  EXPECT_EQ(reader->real_runs()[2].verdict, "DEGRADED");
}

TEST_F(RecoverRealRuns, WithoutTheFirstPageNothingIsLost) {
  write_bytes(damaged, std::string(kPage, '\xff') + bytes.substr(kPage));
  EXPECT_EQ(recovered(), digest);
  EXPECT_EQ(*open_reader(out)->real_run({2}), runs[1]);
}

TEST_F(RecoverRealRuns, AStoreOfRealRunsAloneNeedsNoCampaignFile) {
  const fs::path path = folder / "real.db";
  {
    const auto store = StoreAtRest::open(path, StoreAtRest::IfMissing::Make);
    for (std::uint64_t number = 1; number <= 2; ++number)
      ASSERT_TRUE((*store)->add_real_run(synthetic_real_run(number, {}, 400)));
  }
  const std::string whole = digest_of(path);
  sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE).execute("DELETE FROM campaign");
  fs::remove(out);
  auto recovery = value_of(Recovery::begin(path, out));
  const auto end = value_of(recovery->finish());
  EXPECT_EQ(end.digest, whole);
  EXPECT_EQ(open_reader(out)->real_runs().size(), 2U);
}

TEST_F(RecoverRealRuns, ARunOfWhichPartsAreLostIsInvalidAndSaysWhich) {
  const auto pages = bytes.size() / kPage;
  int told = 0;
  for (std::size_t page = 2; page < pages; page += pages / 12) {
    std::string broken = bytes;
    broken.replace(page * kPage, kPage, kPage, '\x5a');
    write_bytes(damaged, broken);
    recovered();
    const auto reader = open_reader(out);
    EXPECT_TRUE(reader->integrity().empty()) << "page " << page;
    for (const RealRunHead& head : reader->real_runs()) {
      const RealRunRows rows = *reader->real_run(head.id);
      if (rows.score.program == "swarmsmith recover") {
        ++told;
        EXPECT_EQ(rows.score.verdict, "INVALID");
        EXPECT_THAT(rows.score.reasons, HasSubstr("were lost with the damaged store"));
        continue;
      }
      // Nothing that counts was changed; notes may be lost without a trace.
      const RealRunRows& whole = runs[static_cast<std::size_t>(head.id.value - 1)];
      EXPECT_EQ(rows.samples, whole.samples) << "page " << page;
      EXPECT_EQ(rows.cycles, whole.cycles) << "page " << page;
    }
  }
  EXPECT_GT(told, 3);
}

TEST_F(RecoverRealRuns, ARunThatLostItsCalibrationsSaysSo) {
  sqlite::Connection(damaged.string(), SQLITE_OPEN_READWRITE).execute("DELETE FROM calibration");
  recovered();
  const auto reader = open_reader(out);
  ASSERT_EQ(reader->real_runs().size(), 3U);
  for (const RealRunHead& head : reader->real_runs()) {
    const RealRunRows rows = *reader->real_run(head.id);
    EXPECT_EQ(rows.score.verdict, "INVALID");
    EXPECT_THAT(rows.score.reasons, HasSubstr("rows of its calibrations"));
    EXPECT_EQ(rows.samples, runs[static_cast<std::size_t>(head.id.value - 1)].samples);
  }
}

TEST_F(RecoverTest, WhatWasOnlyInTheLogIsFoundThere) {
  fs::remove(damaged);
  const auto store = filled_store(damaged, campaign);
  store->flush();
  fs::copy_file(damaged, folder / "crashed.db");
  fs::copy_file(damaged.string() + "-wal", folder / "crashed.db-wal");
  ASSERT_GT(fs::file_size(folder / "crashed.db-wal"), bytes.size() / 2);
  damaged = folder / "crashed.db";
  EXPECT_EQ(recovered(), digest);
  // A log that was cut off gives what was committed before.
  fs::resize_file(folder / "crashed.db-wal", fs::file_size(folder / "crashed.db-wal") / 2);
  EXPECT_NE(recovered(), digest);
  expect_no_other_rows();
}

TEST_F(RecoverTest, OfPagesThatAreOverwrittenTheOthersAreKept) {
  Rng rng(5);
  for (int round = 0; round < 15; ++round) {
    std::string broken = bytes;
    for (int pages = 0; pages <= round % 4; ++pages) {
      const auto page = static_cast<std::size_t>(
          rng.uniform_int(1, static_cast<std::int64_t>(bytes.size() / kPage) - 1));
      for (std::size_t i = 0; i < kPage; ++i)
        broken[page * kPage + i] = static_cast<char>(rng.uniform_int(0, 255));
    }
    write_bytes(damaged, broken);
    recovered();
    EXPECT_GT(expect_no_other_rows(), 0U) << "round " << round;
    EXPECT_TRUE(open_reader(out)->integrity().empty());
  }
}

TEST_F(RecoverTest, OfATableThatIsLostItsIndexGivesTheRows) {
  const std::int64_t root =
      sqlite::integer_of(sqlite::Connection(damaged, SQLITE_OPEN_READWRITE),
                         "SELECT rootpage FROM sqlite_schema WHERE name = 'source'");
  std::string broken = bytes;
  broken.replace(static_cast<std::size_t>(root - 1) * kPage, kPage, kPage, '\0');
  write_bytes(damaged, broken);
  EXPECT_EQ(recovered(), digest);
  EXPECT_GT(std::ranges::find(found.tables, "source", &SalvagedTable::name)->rows, 0);
}

TEST_F(RecoverTest, BytesThatAreChangedAnywhereBreakNothing) {
  Rng rng(6);
  for (int round = 0; round < 15; ++round) {
    std::string broken = bytes;
    for (int i = 0; i < 200; ++i) {
      const auto at = rng.uniform_int(0, static_cast<std::int64_t>(bytes.size()) - 1);
      broken[static_cast<std::size_t>(at)] = static_cast<char>(rng.uniform_int(0, 255));
    }
    write_bytes(damaged, broken);
    fs::remove(out);
    auto recovery = Recovery::begin(damaged, out);
    if (!recovery) continue;  // the schema's number may say that it is a newer store
    if ((*recovery)->campaigns().empty()) (*recovery)->put_campaign(campaign.campaign);
    const auto end = (*recovery)->finish();
    ASSERT_TRUE(end) << to_string(end.error());
    EXPECT_TRUE(open_reader(out)->integrity().empty());
  }
}

TEST_F(RecoverTest, ATruncatedStoreGivesWhatIsLeftAndSaysWhatIsNot) {
  write_bytes(damaged, bytes.substr(0, bytes.size() * 6 / 10 + 100));
  EXPECT_NE(recovered(), digest);
  expect_no_other_rows();
  std::int64_t lost = 0;
  for (const SalvagedTable& table : found.tables)
    lost += table.lost_pages;
  EXPECT_GT(lost, 0);
}

TEST_F(RecoverTest, ALogMayGiveItsPagesAnyNumber) {
  for (const std::uint32_t number : {0xffffffffU, 0xfffffffeU, 0x80000000U, 0U}) {
    const LogFrame frame{
        .page = number, .pages_after = number, .bytes = bytes.substr(5 * kPage, kPage)};
    write_bytes(
        damaged.string() + "-wal",
        write_ahead_log({frame, {.page = 1, .pages_after = 1, .bytes = bytes.substr(0, kPage)}},
                        kPage));
    EXPECT_EQ(recovered(), digest) << number;
  }
}

TEST_F(RecoverTest, CellsThatAllLeadToOneLongChainAreNotFollowedForEver) {
  // Leaves full of cells that are one and the same: 2,048,003 bytes; 1,003 of them are here and
  // the others on the 250 pages that begin at page 301.
  constexpr std::size_t kCells = 600, kAt = 4096;
  std::string leaf(kPage, '\0');
  leaf[0] = 0x0d;
  leaf[3] = static_cast<char>(kCells >> 8U);
  leaf[4] = static_cast<char>(kCells & 0xffU);
  for (std::size_t i = 0; i < kCells; ++i)
    leaf[8 + 2 * i] = static_cast<char>(kAt >> 8U);
  leaf.replace(kAt, 4, "\xfd\x80\x03\x01", 4);
  leaf.replace(kAt + 4 + 1003, 4, std::string("\x00\x00\x01\x2d", 4));
  std::string file = bytes.substr(0, 2 * kPage);
  for (std::uint32_t page = 3; page <= 1500; ++page) {
    std::string chained(kPage, '\0');
    chained[2] = static_cast<char>((page + 1) >> 8U);
    chained[3] = static_cast<char>((page + 1) & 0xffU);
    file += page <= 300 ? leaf : chained;
  }
  write_bytes(damaged, file);
  EXPECT_THAT(complaint_of(Recovery::begin(damaged, out)), HasSubstr("nothing of a store"));
}

TEST_F(RecoverTest, SaysWhatCannotBe) {
  write_bytes(damaged, std::string(50'000, 'x'));
  EXPECT_THAT(complaint_of(Recovery::begin(damaged, out)), HasSubstr("nothing of a store"));
  EXPECT_FALSE(Recovery::begin(folder / "none.db", out));
  write_bytes(out, "mine");
  EXPECT_THAT(complaint_of(Recovery::begin(damaged, out)), HasSubstr("nothing is overwritten"));
  EXPECT_EQ(whole_file(out), "mine");
}

/// No race makes these rows again.
TEST_F(RecoverTest, CandidatesOfAnImportOutliveTheirParents) {
  const DesignId design{3};
  const CandidateId lost = candidate_id(design, 1);
  const CandidateId child = candidate_id(design, 2);
  Addition addition{
      .campaign = CampaignRow{.name = "from elsewhere", .digest = "x", .deciding = "{}"},
      .designs = {{.row = {.id = design,
                           .mission = "m",
                           .method = "irace",
                           .flavour = "watermelon",
                           .repetition = 1},
                   .name = "x"}},
      .removed = {},
      .rows = {PairRow{.design = design, .purpose = Purpose::Score, .number = 1, .seed = 5}},
      .profiles = {}};
  for (const CandidateId id : {lost, child}) {
    addition.rows.emplace_back(CandidateRow{.id = id,
                                            .iteration = id == lost ? 1 : 2,
                                            .parent = id == lost ? CandidateId{} : lost,
                                            .parameters = "{}",
                                            .machine = "--nstates 1",
                                            .modules = R"({"stop":1})",
                                            .states = 1});
    addition.rows.emplace_back(
        EvaluationRow{.key = {id, Purpose::Score, 1}, .measured = {.score = 2}, .source = "real"});
  }
  addition.rows.emplace_back(RaceStepRow{
      .design = design, .step = 1, .iteration = 1, .pair = 1, .evaluated = 1, .best = lost});
  {
    const auto store = StoreAtRest::open(damaged, StoreAtRest::IfMissing::Refuse);
    const auto added = (*store)->add(addition);
    ASSERT_TRUE(added) << to_string(added.error());
  }
  sqlite::Connection raw(damaged.string(), SQLITE_OPEN_READWRITE);
  raw.execute(
      fmt::format("PRAGMA foreign_keys = OFF; DELETE FROM candidate WHERE id = {}", lost.value));
  raw = sqlite::Connection(":memory:", SQLITE_OPEN_READWRITE);
  recovered();
  EXPECT_EQ(without_parent, 1);
  EXPECT_EQ(cells_of(*open_reader(out),
                     "SELECT candidate, parent FROM v_candidates"
                     " WHERE design = 3"),
            (std::vector<std::vector<std::string>>{{std::to_string(child.value), "NULL"}}));
  EXPECT_EQ(cells_of(*open_reader(out),
                     "SELECT candidate, score FROM v_evaluations"
                     " WHERE design = 3"),
            (std::vector<std::vector<std::string>>{{std::to_string(child.value), "2"}}));
  EXPECT_EQ(cells_of(*open_reader(out), "SELECT step, best FROM v_race_steps WHERE design = 3"),
            (std::vector<std::vector<std::string>>{{"1", "NULL"}}));
}

TEST_F(RecoverTest, ACampaignOfOtherDesignsIsRefused) {
  auto recovery = value_of(Recovery::begin(damaged, out));
  std::vector<DesignRow> others = campaign.designs;
  others.front().seed += 1;
  EXPECT_FALSE(recovery->put_designs(recovery->campaigns().front(), others));
}

TEST(Recover, OldSchemasAreRecoveredAsSuchWithAndWithoutTheirHeader) {
  for (const int schema : {1, 2, 3}) {
    const TemporaryFolder folder;
    const std::string file =
        std::string(SWARMSMITH_TEST_DATA) + "/stores/schema-" + std::to_string(schema) + ".sqlite";
    const std::string digest = digest_of(file);
    const std::string bytes = whole_file(file);
    for (const std::size_t lost : {std::size_t{0}, std::size_t{100}}) {
      write_bytes(folder / "old.db", std::string(lost, '\0') + bytes.substr(lost));
      auto recovery =
          value_of(Recovery::begin(folder / "old.db", folder / ("new" + std::to_string(lost))));
      EXPECT_EQ(recovery->found().header_is_damaged, lost > 0);
      const auto end = value_of(recovery->finish());
      EXPECT_EQ(end.digest, digest) << "schema " << schema << " without " << lost << " bytes";
    }
  }
}

}  // namespace
}  // namespace swarmsmith
