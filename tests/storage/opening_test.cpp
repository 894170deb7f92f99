#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "storage/internal/closed_file.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/new_file.h"
#include "storage/internal/open_writer.h"
#include "storage/internal/schema.h"
#include "storage/internal/spill_place.h"
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

/// The numbers of statfs(2).
TEST_F(OpeningTest, KnowsSharedFileSystemsFromLocalOnes) {
  for (const long shared :
       {0x6969L, 0x517bL, 0xff534d42L, 0xfe534d42L, 0x0bd00bd0L, 0x00c36400L, 0x47504653L,
        0x19830326L, 0x5346414fL, 0x73757245L, 0x01021997L, 0x7461636fL})
    EXPECT_EQ(kind_of_shared(shared, ""), "a network file system") << shared;
  EXPECT_EQ(kind_of_shared(0x6969, "nfs4"), "nfs4, a network file system");
  EXPECT_EQ(kind_of_shared(-11317950L, "cifs"), "cifs, a network file system") << "signed";
  for (const long local : {0xef53L, 0x58465342L, 0x9123683eL, 0x01021994L, 0x794c7630L})
    EXPECT_EQ(kind_of_shared(local, "ext4"), "") << local;
}

TEST_F(OpeningTest, KnowsWhichProgramsBehindFuseAreLocal) {
  constexpr long kFuse = 0x65735546;
  for (const char* local : {"fuseblk", "fuse.bindfs", "fuse.gocryptfs", "fuse.encfs",
                            "fuse.fuse-overlayfs", "fuse.ntfs-3g"}) {
    EXPECT_EQ(kind_of_shared(kFuse, local), "") << local;
  }
  for (const std::string shared : {"fuse.sshfs", "fuse.glusterfs", "fuse.mergerfs",
                                   "fuse.new-thing", "virtiofs", "bindfs", "fuse.fuse.bindfs"}) {
    EXPECT_EQ(kind_of_shared(kFuse, shared),
              shared + ", a FUSE file system that is not known to be of this host alone");
  }
  for (const char* unknown : {"", "fuse"})
    EXPECT_EQ(kind_of_shared(kFuse, unknown), "a FUSE file system of an unknown kind");
}

TEST_F(OpeningTest, FindsTheFileSystemOfAFolderOfThisHost) {
  EXPECT_EQ(shared_file_system("/proc/self"), "");
  EXPECT_EQ(shared_file_system("/dev"), "");
  EXPECT_EQ(shared_file_system(folder / "missing"), "");
}

/// A file of so many bytes with SQLite's header: its page size and number of pages, and whether
/// that number is up to date.
TEST_F(OpeningTest, ComparesTheSizeOfAFileWithItsHeader) {
  struct Case {
    std::size_t bytes;
    unsigned page, pages;
    bool holds;
    const char* fault;
  };
  const std::string way_out =
      "; restore it from a backup, or let `swarmsmith recover` make a new store from what can be "
      "read";
  for (const auto& [bytes, page, pages, holds, fault] :
       {Case{1024, 512, 2, true, ""},
        Case{1023, 512, 2, true, "1023 bytes, and its header says 1024"},
        Case{1025, 512, 2, true, ""}, Case{512, 512, 2, false, ""}, Case{65536, 1, 1, true, ""},
        Case{65535, 1, 1, true, "65535 bytes, and its header says 65536"},
        Case{200000, 512, 0x01000000, true, "200000 bytes, and its header says 8589934592"},
        Case{100, 512, 0, true, ""}, Case{99, 512, 0, true, "99 bytes, and its header says 100"},
        Case{5, 512, 0, true, "5 bytes, and its header says 100"}, Case{0, 512, 0, true, ""}}) {
    std::string text("SQLite format 3\0", 16);
    text.resize(std::max<std::size_t>(bytes, 100));
    text[16] = static_cast<char>(page >> 8U);
    text[17] = static_cast<char>(page & 0xffU);
    text[28] = static_cast<char>(pages >> 24U);
    text[31] = static_cast<char>(pages & 0xffU);
    text[27] = 9;
    text[95] = holds ? 9 : 8;
    text.resize(bytes);
    std::ofstream(path, std::ios::binary) << text;
    const sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
    EXPECT_EQ(
        complaint_of(check_database_file(connection, "s")),
        *fault == '\0' ? "" : "s: the store is truncated: it has " + std::string(fault) + way_out);
    EXPECT_EQ(has_database_header(connection), bytes >= 16) << bytes;
    if (*fault == '\0' || bytes < 100) continue;
    std::ofstream(path.string() + "-wal") << "x";
    EXPECT_TRUE(check_database_file(connection, "s")) << "the log may have the rest";
    std::filesystem::resize_file(path.string() + "-wal", 0);
    EXPECT_FALSE(check_database_file(connection, "s"));
    std::filesystem::remove(path.string() + "-wal");
  }
  std::ofstream(path) << "SQLite format 4";
  EXPECT_THAT(complaint_of(check_database_file(
                  sqlite::Connection(path.string(), SQLITE_OPEN_READONLY), "s")),
              StartsWith("s: not a store: the file is not an SQLite database"));
}

TEST_F(OpeningTest, ReadsBytesOfAFileAsFarAsItGoes) {
  std::ofstream(path) << "0123456789";
  const sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
  EXPECT_EQ(connection.file_size(), 10);
  EXPECT_EQ(connection.file_bytes(0, 10), "0123456789");
  EXPECT_EQ(connection.file_bytes(3, 4), "3456");
  EXPECT_EQ(connection.file_bytes(7, 10), "789");
  EXPECT_EQ(connection.file_bytes(10, 1), "");
  EXPECT_EQ(connection.file_bytes(12, 5), "");
}

/// A connection treats what a file holds as data alone.
TEST_F(OpeningTest, OpensAFileOfItsOwnWithoutWhatCouldAct) {
  EXPECT_THROW(sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE), sqlite::SqliteError);
  EXPECT_FALSE(std::filesystem::exists(path)) << "made although it should be there";
  sqlite::Connection connection(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  for (const auto& [setting, wanted] :
       {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1), std::pair(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0),
        std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0), std::pair(SQLITE_DBCONFIG_ENABLE_VIEW, 0)}) {
    int now = -1;
    sqlite3_db_config(connection.handle(), setting, -1, &now);
    EXPECT_EQ(now, wanted) << setting;
  }
  EXPECT_EQ(sqlite3_limit(connection.handle(), SQLITE_LIMIT_LENGTH, -1), 25 << 20);
  struct stat opened {};
  struct stat named {};
  ASSERT_EQ(::fstat(connection.descriptor(), &opened), 0);
  ASSERT_EQ(::stat(path.c_str(), &named), 0);
  EXPECT_EQ(opened.st_ino, named.st_ino);
  EXPECT_EQ(opened.st_mode & 0777U, 0600U);
  EXPECT_EQ(connection.file(), path.string());
  const int before = connection.descriptor();
  std::ofstream(folder / "other") << "x";
  EXPECT_EQ(connection.descriptor(), before);

  sqlite::Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  EXPECT_EQ(memory.descriptor(), -1);
  EXPECT_EQ(memory.file(), "");
  EXPECT_FALSE(std::filesystem::exists(":memory:")) << "a file of that name";
  EXPECT_FALSE(is_as_closed(memory));
  sqlite::Statement row(memory, "SELECT NULL, 'a' || char(0) || 'b', 0.5, ?");
  row.bind(std::string_view());
  ASSERT_TRUE(row.step());
  EXPECT_EQ(row.text(0), "");
  EXPECT_EQ(row.text(1), std::string("a\0b", 3));
  EXPECT_EQ(row.optional_real(0), std::nullopt);
  EXPECT_EQ(row.optional_real(2), 0.5);
  EXPECT_FALSE(row.is_null(3)) << "an empty text is a text";
  EXPECT_FALSE(row.step());
  try {
    sqlite::Connection((folder / "none" / "s.db").string(),
                       SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    FAIL() << "there is no folder";
  } catch (const sqlite::SqliteError& error) {
    EXPECT_STREQ(error.what(), "unable to open database file (No such file or directory)");
    EXPECT_EQ(error.primary_code(), SQLITE_CANTOPEN);
  }
}

TEST_F(OpeningTest, MakesTemporaryFilesBesideAFileAlone) {
  const std::string beside = "beside " + folder.path().string();
  const auto place = [](const std::string& database) {
    const char* name = vfs_that_spills_beside(database);
    return name == nullptr ? std::string("SQLite's own") : std::string(name);
  };
  EXPECT_EQ(place(path.string()), beside);
  EXPECT_EQ(place((folder / "other.db").string()), beside);
  EXPECT_NE(sqlite3_vfs_find(beside.c_str()), nullptr);
  for (const std::string none : {"", ":memory:", "file:s.db"})
    EXPECT_EQ(place(none), "SQLite's own") << none;
  EXPECT_EQ(place((folder / "none" / "s.db").string()), "SQLite's own") << "no such folder";
  ::setenv("SQLITE_TMPDIR", "/tmp", 1);
  EXPECT_EQ(place(path.string()), "SQLite's own") << "as the environment says";
  ::unsetenv("SQLITE_TMPDIR");
}

TEST_F(OpeningTest, SaysWhyAStoreCannotBeOpened) {
  const auto error = [](int code) -> std::string {
    const Unexpected refused = not_writable(sqlite::SqliteError(code, "it is so"), "s.db");
    return refused.value().kind == ErrorKind::Corrupt ? "corrupt" : to_string(refused.value());
  };
  const std::string plain = "s.db: the store cannot be opened for writing: it is so";
  EXPECT_EQ(error(SQLITE_CORRUPT), "corrupt");
  EXPECT_EQ(error(SQLITE_NOTADB), "corrupt");
  EXPECT_EQ(error(SQLITE_CORRUPT_INDEX), "corrupt");
  EXPECT_EQ(error(SQLITE_FULL), plain);
  EXPECT_EQ(error(SQLITE_IOERR_FSYNC), plain);
}

TEST_F(OpeningTest, ANewFileGetsItsNameWhenItIsWholeAndTakesThatOfNoOther) {
  const std::filesystem::path part = path.string() + fmt::format(".part-{}", ::getpid());
  const auto write_part = [&] {
    for (const char* ending : {"", "-wal", "-shm", "-journal"})
      std::ofstream(part.string() + ending) << "part";
  };
  const auto names = [&] {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      found.push_back(entry.path().filename().string());
    return found;
  };
  write_part();  // of a killed process with the same number
  {
    auto file = value_of(NewFile::beside(path));
    EXPECT_EQ(file.path(), part);
    EXPECT_THAT(names(), IsEmpty());
    write_part();
  }
  EXPECT_THAT(names(), IsEmpty()) << "it was not published";
  {
    auto file = value_of(NewFile::beside(path));
    write_part();
    auto moved = std::move(file);
    ASSERT_TRUE(moved.publish());
    EXPECT_THAT(names(), ElementsAre("s.db"));
    std::ofstream(part) << "of another";
  }
  EXPECT_EQ(whole_file(path), "part");
  EXPECT_THAT(names(), Contains(part.filename().string())) << "it was not its own any more";
  std::filesystem::remove(part);
  const std::string taken =
      path.string() +
      ": a file with this name exists, and nothing is overwritten; choose another name";
  EXPECT_EQ(complaint_of(NewFile::beside(path)), taken);
  std::filesystem::remove(path);
  std::filesystem::create_symlink("nowhere", path);
  EXPECT_EQ(complaint_of(NewFile::beside(path)), taken) << "a link that leads nowhere";
  std::filesystem::remove(path);
  auto late = value_of(NewFile::beside(path));
  write_part();
  std::ofstream(path) << "mine";
  EXPECT_EQ(complaint_of(late.publish()), taken);
  EXPECT_EQ(whole_file(path), "mine");
  std::filesystem::remove(path);
  std::filesystem::remove(part);
  const Error gone = why_not(late.publish());
  EXPECT_EQ(gone.kind, ErrorKind::Unavailable);
  EXPECT_EQ(to_string(gone), path.string() + ": cannot be made: No such file or directory");
}

TEST_F(OpeningTest, RefusesAStoreWhoseNumbersOfDesignsCannotBe) {
  fill_store(path, campaign);
  constexpr std::int64_t kMost =
      std::numeric_limits<std::int64_t>::max() / 1'000'000 / 100'000 - 1;  // before ids overflow
  const auto with = [&](std::int64_t before) {
    execute(fmt::format("UPDATE campaign SET designs_before = {}", before));
    return open_reader(path);
  };
  EXPECT_EQ(with(0)->campaigns().size(), 1U);
  EXPECT_EQ(with(kMost - 1)->campaigns().front().designs_before, kMost - 1);
  for (const std::int64_t before : {std::int64_t{-1}, kMost, kMost + 1}) {
    const auto reader = with(before);
    try {
      static_cast<void>(reader->campaigns());
      FAIL() << before;
    } catch (const StoreFailure& failure) {
      EXPECT_EQ(failure.what(), fmt::format("the table campaign says that there are {} designs "
                                            "before those of campaign 1",
                                            before));
    }
  }
  execute("DELETE FROM campaign");
  EXPECT_THROW(static_cast<void>(open_reader(path)->campaigns()), StoreFailure);
}

/// This process as a user without rights, for a while.
struct AsAnotherUser {
  AsAnotherUser() { EXPECT_EQ(::setresuid(65534, 65534, 0), 0); }
  AsAnotherUser(const AsAnotherUser&) = delete;
  AsAnotherUser& operator=(const AsAnotherUser&) = delete;
  ~AsAnotherUser() { EXPECT_EQ(::setresuid(0, 0, 0), 0); }
};

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
  path = folder / "A z-09_.é%41?#&=+.db";  // a URI uses some of these signs
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
  {
    const AsAnotherUser other;
    EXPECT_EQ(digest_of(path), wanted);
    EXPECT_THAT(complaint_of(Store::open(path, campaign.campaign, campaign.designs)),
                AllOf(HasSubstr(".lock: cannot make the lock file: Permission denied; a store can "
                                "only be written in a folder where files can be made")));
    EXPECT_EQ(vfs_that_spills_beside(path.string()), nullptr);
  }
  std::filesystem::permissions(folder.path(), perms::all);
  const AsAnotherUser other;
  EXPECT_EQ(complaint_of(Store::open(path, campaign.campaign, campaign.designs)),
            path.string() + ": the store may not be written by this user");
}

TEST_F(OpeningTest, GivesAStoreTheModulesThatTheProgramKnows) {
  fill_store(path, campaign);
  const auto names = [&] {
    sqlite::Connection connection(path.string(), SQLITE_OPEN_READONLY);
    connection.allow_views(true);
    return sqlite::text_of(connection,
                           "SELECT group_concat(flavour || kind || number || name) FROM"
                           " flavour_name");
  };
  const std::string wanted = names();
  EXPECT_THAT(wanted, HasSubstr("watermelons1stop"));
  execute(
      "DROP VIEW flavour_name; CREATE VIEW flavour_name(flavour, kind, number, name) AS"
      " SELECT 'mine', 's', 0, 'stop'");
  ASSERT_EQ(names(), "mines0stop");
  open_store(path, campaign).reset();
  EXPECT_EQ(names(), wanted);
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
