#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <thread>

#include "storage/internal/file_checks.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

struct OpeningTest : testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 2});

  Error refusal() { return why_not(Store::open(path, campaign.campaign, campaign.designs)); }
  Error reader_refusal() { return why_not(StoreReader::open(path)); }
  void execute(const std::string& sql) {
    sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE).execute(sql);
  }
  void overwrite(std::streamoff at, const std::string& bytes) {
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(at) << bytes;
  }
};

TEST_F(OpeningTest, MakesAStoreInAnEmptyFileToo) {
  std::ofstream(path).flush();
  fill_store(path, campaign);
  EXPECT_TRUE(open_reader(path)->finished());
}

TEST_F(OpeningTest, OnlyItsOwnerCanReadANewStore) {
  using std::filesystem::perms;
  const auto store = open_store(path, campaign);
  for (const char* ending : {"", "-wal", "-shm"})
    EXPECT_EQ(std::filesystem::status(path.string() + ending).permissions(),
              perms::owner_read | perms::owner_write)
        << ending;
}

TEST_F(OpeningTest, RefusesAFileThatIsNoDatabase) {
  std::ofstream(path) << "candidate,score\n" << std::string(500, '1');
  EXPECT_EQ(refusal().kind, ErrorKind::Corrupt);
  EXPECT_THAT(refusal().message, HasSubstr("not an SQLite database"));
  EXPECT_EQ(refusal().where, path.string());
  EXPECT_EQ(reader_refusal().kind, ErrorKind::Corrupt);
}

TEST_F(OpeningTest, RefusesATruncatedStoreAndSaysHowMuchIsMissing) {
  fill_store(path, campaign);
  const auto size = std::filesystem::file_size(path);
  for (const auto left : {size - 8192, size / 2, std::uintmax_t{50}}) {
    std::filesystem::resize_file(path, left);
    EXPECT_EQ(refusal().kind, ErrorKind::Corrupt);
    EXPECT_THAT(refusal().message, HasSubstr(fmt::format("truncated: it has {} bytes", left)));
    EXPECT_EQ(reader_refusal().kind, ErrorKind::Corrupt);
  }
}

TEST_F(OpeningTest, RefusesAnotherProgramsDatabaseAndLeavesItAlone) {
  execute("CREATE TABLE photos (id INTEGER)");
  const auto before = std::filesystem::file_size(path);
  EXPECT_EQ(refusal().kind, ErrorKind::Corrupt);
  EXPECT_THAT(refusal().message, HasSubstr("another program"));
  EXPECT_EQ(std::filesystem::file_size(path), before);
  EXPECT_EQ(reader_refusal().kind, ErrorKind::Corrupt);
}

TEST_F(OpeningTest, RefusesAStoreOfALaterVersion) {
  fill_store(path, campaign);
  execute("PRAGMA user_version = 99");
  EXPECT_EQ(refusal().kind, ErrorKind::Newer);
  EXPECT_THAT(refusal().message, HasSubstr("schema 99"));
  EXPECT_EQ(reader_refusal().kind, ErrorKind::Newer);
}

TEST_F(OpeningTest, RefusesAnotherCampaignAndNamesWhatDiffers) {
  fill_store(path, campaign);
  campaign.campaign.digest = "0ther";
  campaign.campaign.deciding = R"({"seed":1,"race":{"budget":2000},"flavour":"watermelon"})";
  const Error error = refusal();
  EXPECT_EQ(error.kind, ErrorKind::Conflict);
  EXPECT_THAT(error.message, HasSubstr("race.budget is 100000 in the store and 2000 in the "
                                       "campaign; flavour is nothing in the store and watermelon"));
  EXPECT_THAT(error.message, Not(HasSubstr("seed is")));
}

TEST_F(OpeningTest, NamesTenDifferencesAtMost) {
  std::string keys;
  for (int i = 0; i < 14; ++i)
    keys += fmt::format("{}\"key{}\":1", i == 0 ? "" : ",", i);
  campaign.campaign.deciding = "{" + keys + "}";
  fill_store(path, campaign);
  campaign.campaign.digest = "0ther";
  campaign.campaign.deciding = "{}";
  EXPECT_THAT(refusal().message, HasSubstr("and 4 more"));
  EXPECT_THAT(refusal().message, Not(HasSubstr("key13")));
}

TEST_F(OpeningTest, SaysThatAFolderIsMissingOrThatAStoreIsAFile) {
  path = folder / "none" / "s.db";
  EXPECT_THAT(refusal().message, HasSubstr("does not exist; make it first"));
  path = folder.path();
  EXPECT_THAT(refusal().message, HasSubstr("a store is a file"));
  path = folder / "none.db";
  EXPECT_EQ(reader_refusal().kind, ErrorKind::NotFound);
}

TEST_F(OpeningTest, KnowsSharedFileSystemsFromLocalOnes) {
  for (const long shared : {0x6969L, 0x517bL, 0xff534d42L, 0x0bd00bd0L}) {
    EXPECT_THAT(kind_of_shared(shared, ""), "a network file system") << shared;
  }
  EXPECT_EQ(kind_of_shared(0x6969, "nfs4"), "nfs4, a network file system");
  for (const long local : {0xef53L, 0x58465342L, 0x9123683eL, 0x01021994L, 0x794c7630L}) {
    EXPECT_EQ(kind_of_shared(local, "ext4"), "") << local;
  }
}

TEST_F(OpeningTest, KnowsWhichProgramsBehindFuseAreLocal) {
  constexpr long kFuse = 0x65735546;
  for (const char* local : {"fuseblk", "fuse.bindfs", "fuse.gocryptfs", "fuse.encfs",
                            "fuse.fuse-overlayfs", "fuse.ntfs-3g"}) {
    EXPECT_EQ(kind_of_shared(kFuse, local), "") << local;
  }
  for (const char* shared : {"fuse.sshfs", "fuse.glusterfs", "fuse.mergerfs", "fuse.new-thing",
                             "virtiofs", "bindfs", "fuse.fuse.bindfs"}) {
    EXPECT_THAT(kind_of_shared(kFuse, shared), StartsWith(shared)) << shared;
  }
  for (const char* unknown : {"", "fuse"})
    EXPECT_THAT(kind_of_shared(kFuse, unknown), HasSubstr("unknown kind")) << unknown;
}

TEST_F(OpeningTest, FindsTheFileSystemOfAFolderOfThisHost) {
  EXPECT_EQ(shared_file_system("/proc/self"), "");
  EXPECT_EQ(shared_file_system("/dev"), "");
}

TEST_F(OpeningTest, RefusesTextsThatAreLongerThanAnyOfOurs) {
  constexpr int kName = kLongestName;
  const std::vector<std::pair<std::string, int>> limits{
      {"campaign.name", kName},   {"source.name", kName},      {"design.mission", kName},
      {"design.method", kName},   {"design.flavour", kName},   {"design.reason", 1 << 20},
      {"design.name", kName},     {"phrase.machine", 8 << 20}, {"phrase.parameters", 8 << 20},
      {"phrase.modules", 8 << 20}};
  fill_store(path, campaign);
  execute("INSERT OR IGNORE INTO phrase (id, machine, parameters, modules) VALUES (1, '', '', '')");
  const std::filesystem::path whole = folder / "whole.db";
  std::filesystem::copy_file(path, whole);
  for (const auto& [name, most] : limits) {
    SCOPED_TRACE(name);
    const std::string table = name.substr(0, name.find('.'));
    const std::string column = name.substr(name.find('.') + 1);
    // SQLite's length() of a text ends at its first zero.
    for (const std::string& text :
         {std::string("substr(hex(zeroblob({0})), 1, {0})"), std::string("zeroblob({0})")}) {
      const auto set = [&](int length) {
        std::filesystem::copy_file(whole, path, std::filesystem::copy_options::overwrite_existing);
        execute("UPDATE " + table + " SET " + column + " = CAST(" +
                fmt::format(fmt::runtime(text), length) +
                " AS TEXT) WHERE id = (SELECT min(id) FROM " + table + ")");
      };
      set(most);
      EXPECT_TRUE(StoreReader::open(path));
      set(most + 1);
      EXPECT_EQ(reader_refusal().kind, ErrorKind::Corrupt);
      EXPECT_EQ(reader_refusal().message,
                fmt::format("a {} in the store's table {} has {} bytes; the limit is {}", column,
                            table, most + 1, most));
    }
  }
}

TEST_F(OpeningTest, RefusesASecondWriterOfTheSameProcess) {
  const auto first = open_store(path, campaign);
  EXPECT_EQ(refusal().kind, ErrorKind::Conflict);
  EXPECT_THAT(refusal().message, HasSubstr(fmt::format("pid={}", ::getpid())));
}

TEST_F(OpeningTest, WaitsForAWriterThatIsSoonDone) {
  auto first = open_store(path, campaign);
  const std::jthread brief([&first] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    first.reset();
  });
  const auto second = Store::open(path, campaign.campaign, campaign.designs,
                                  {.patience = std::chrono::milliseconds(60'000)});
  EXPECT_TRUE(second.has_value());
}

TEST_F(OpeningTest, WaitsForAnOrdinaryClientOfAStoreThatIsStillEmpty) {
  sqlite::Connection client(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  // As every client does that takes away the journal of a coordinator that died at the beginning.
  client.execute("BEGIN IMMEDIATE");
  const std::jthread brief([&client] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    client.execute("COMMIT");
  });
  const auto store = Store::open(path, campaign.campaign, campaign.designs);
  EXPECT_TRUE(store.has_value()) << to_string(store.error());
}

/// A child that does `work`, then writes a byte and waits to be killed.
pid_t child_that_waits(const std::function<void()>& work) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    (void)!::write(ends[1], "x", 1);
    while (true)
      ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), 1);
  ::close(ends[0]);
  ::close(ends[1]);
  return child;
}

void kill_and_wait(pid_t child) {
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST_F(OpeningTest, NamesTheProcessThatHoldsTheStoreAndOpensWhenItHasDied) {
  std::unique_ptr<Store> held;
  const pid_t child = child_that_waits([&] { held = open_store(path, campaign); });
  EXPECT_EQ(refusal().kind, ErrorKind::Conflict);
  EXPECT_THAT(refusal().message, HasSubstr(fmt::format("pid={} host=", child)));
  kill_and_wait(child);
  EXPECT_TRUE(std::filesystem::exists(path.string() + ".lock"));
  EXPECT_NE(open_store(path, campaign), nullptr);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".lock"));
}

TEST_F(OpeningTest, LooksAtEveryPageAfterAnUncleanEnd) {
  fill_store(path, campaign);
  // A page in the middle; its kind, 0, is none that SQLite knows.
  const auto closed = std::filesystem::last_write_time(path);
  overwrite(8192 * 5, std::string(200, '\0'));
  std::filesystem::last_write_time(path, closed);
  EXPECT_NE(open_store(path, campaign), nullptr) << "a clean end was not followed by a check";
  std::ofstream(path.string() + ".lock") << "pid=1 host=x\n";
  EXPECT_EQ(refusal().kind, ErrorKind::Corrupt);
  EXPECT_THAT(refusal().message, HasSubstr("not closed properly")) << "forgotten at a second try";
}

TEST_F(OpeningTest, ReadsAStoreInAFolderThatMayNotBeWritten) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root, to become another user";
  fill_store(path, campaign);
  const std::string wanted = digest_of(path);
  std::filesystem::remove(path.string() + "-wal");
  std::filesystem::remove(path.string() + "-shm");
  using std::filesystem::perms;
  // A store belongs to its user alone, until that user gives it to others.
  std::filesystem::permissions(path, perms::group_read | perms::others_read,
                               std::filesystem::perm_options::add);
  std::filesystem::permissions(folder.path(),
                               perms::all & ~perms::group_write & ~perms::others_write);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::setuid(65534) != 0) ::_exit(2);
    const auto reader = StoreReader::open(path);
    if (!reader) fmt::print(stderr, "{}\n", to_string(reader.error()));
    ::_exit(reader && (*reader)->digest() == wanted ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(OpeningTest, MigratesStepByStepAfterACopy) {
  fill_store(path, campaign);
  sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
  const std::vector<Migration> steps{
      {kSchemaVersion + 1,
       [](sqlite::Connection& c) { c.execute("ALTER TABLE design ADD COLUMN note TEXT"); }},
      {kSchemaVersion + 2,
       [](sqlite::Connection& c) { c.execute("UPDATE design SET note = 'moved'"); }},
  };
  migrate(connection, path, steps);
  connection.allow_views(true);
  EXPECT_EQ(sqlite::integer_of(connection, "PRAGMA user_version"), kSchemaVersion + 2);
  EXPECT_EQ(sqlite::text_of(connection, "SELECT note FROM design"), "moved");
  EXPECT_EQ(sqlite::text_of(connection, "SELECT state FROM v_designs"), "finished");
  const sqlite::Connection copy(path.string() + ".before-v" + std::to_string(kSchemaVersion + 2),
                                SQLITE_OPEN_READONLY);
  EXPECT_EQ(sqlite::integer_of(copy, "PRAGMA user_version"), kSchemaVersion);
  EXPECT_EQ(sqlite::text_of(copy, "PRAGMA integrity_check"), "ok");
}

TEST_F(OpeningTest, LeavesTheVersionBeforeWhenAMigrationFails) {
  fill_store(path, campaign);
  const std::string before = digest_of(path);
  {
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE);
    const std::vector<Migration> steps{{kSchemaVersion + 1, [](sqlite::Connection& c) {
                                          c.execute("DELETE FROM evaluation");
                                          c.execute("a mistake");
                                        }}};
    EXPECT_THROW(migrate(connection, path, steps), sqlite::SqliteError);
    EXPECT_EQ(sqlite::integer_of(connection, "PRAGMA user_version"), kSchemaVersion);
  }
  EXPECT_EQ(digest_of(path), before);
}

}  // namespace
}  // namespace swarmsmith
