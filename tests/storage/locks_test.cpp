#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "storage/backup.h"
#include "storage/internal/lock_file.h"
#include "storage/merge.h"
#include "storage/recover.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// SQLite's shared lock: a read lock on 510 bytes behind the first GiB.
/// https://www.sqlite.org/fileformat2.html, section 1.3.1 (the lock-byte page)
constexpr std::int64_t kSharedFirst = 0x40000002;

/// Whether this process has the lock that tells all others that the file is open here. A process
/// loses it when it closes any descriptor of the file, and the next ordinary client that leaves
/// then takes the write-ahead log away.
bool is_locked_here(const std::filesystem::path& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return false;
  const std::string place =
      fmt::format("{:02x}:{:02x}:{}", major(file.st_dev), minor(file.st_dev), file.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, access, where;
    std::int64_t pid = 0, first = 0;
    words >> number >> kind >> advisory >> access >> pid >> where >> first;
    if (kind == "POSIX" && pid == ::getpid() && where == place && first == kSharedFirst)
      return true;
  }
  return false;
}

struct LocksTest : testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});

  std::unique_ptr<Store> filled_store() {
    auto store = swarmsmith::filled_store(path, campaign);
    store->flush();
    return store;
  }
  /// The store as a killed writer leaves it, with its log.
  void leave_unclean() {
    const auto killed = filled_store();
    const std::filesystem::path copy = folder / "copy.db";
    for (const char* ending : {"", "-wal", ".lock"})
      std::filesystem::copy_file(path.string() + ending, copy.string() + ending);
    path = copy;
  }
};

TEST_F(LocksTest, AWriterHoldsItsLockAfterEveryKindOfStart) {
  EXPECT_FALSE(is_locked_here(path));
  filled_store();
  {
    const auto clean = open_store(path, campaign);
    EXPECT_TRUE(is_locked_here(path)) << "after a clean end";
  }
  EXPECT_FALSE(is_locked_here(path));
  leave_unclean();
  const auto unclean = open_store(path, campaign);
  EXPECT_TRUE(is_locked_here(path)) << "after a crash";
}

TEST_F(LocksTest, AProgramWithoutStandardInputHasItsLockToo) {
  const int input = ::dup(STDIN_FILENO);
  ::close(STDIN_FILENO);
  const std::string complaint = complaint_of(LockFile::acquire(path, {}));
  ::dup2(input, STDIN_FILENO);
  ::close(input);
  EXPECT_EQ(complaint, "");
}

TEST_F(LocksTest, NothingThatIsDoneWithAStoreTakesTheLockOfItsWriterAway) {
  const auto writer = filled_store();
  ASSERT_TRUE(is_locked_here(path));
  const auto after = [&](const char* what, const std::function<void()>& done) {
    done();
    EXPECT_TRUE(is_locked_here(path)) << what;
  };
  after("reading", [&] { EXPECT_NE(open_reader(path)->digest(), ""); });
  after("checking", [&] { EXPECT_THAT(open_reader(path)->integrity(), IsEmpty()); });
  after("asking", [&] { EXPECT_TRUE(is_database(path)); });
  after("copying", [&] { EXPECT_TRUE(back_up(path, folder / "b.db", [](auto, auto) {})); });
  after("merging", [&] { EXPECT_TRUE(merge_stores({path}, folder / "m.db", [](auto, auto) {})); });
  after("recovering", [&] {
    auto recovery = value_of(Recovery::begin(path, folder / "r.db"));
    EXPECT_TRUE(recovery->finish());
  });
  after("a second writer", [&] {
    EXPECT_FALSE(Store::open(path, campaign.campaign, campaign.designs));
    EXPECT_FALSE(StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse));
  });
}

TEST(LockFiles, NameTheirHolderToThoseWhoMayReadTheStore) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "s.db", file = path.string() + ".lock";
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  const std::string holder = fmt::format("pid={} host={}", ::getpid(), host.data());
  const auto mode = [&] {
    struct stat facts {};
    return ::stat(file.c_str(), &facts) == 0 ? facts.st_mode & 0777U : 0U;
  };
  const mode_t mask = ::umask(0);
  for (const mode_t of_store : {0U, 0600U, 0644U, 0755U}) {
    if (of_store != 0) {
      std::ofstream(path).flush();
      ::chmod(path.c_str(), of_store);
    }
    const auto lock = LockFile::acquire(path, {});
    ASSERT_TRUE(lock);
    EXPECT_EQ(whole_file(file), holder + "\n");
    EXPECT_EQ(mode(), of_store == 0 ? 0600U : of_store & 0666U) << of_store;
    EXPECT_FALSE(lock->left_behind());
    EXPECT_EQ(to_string(why_not(LockFile::acquire(path, {}))),
              path.string() + ": another process is writing this store (" + holder +
                  "); wait for it to end or stop it, or read with a read-only command");
  }
  ::umask(mask);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_THAT(in_use_text(""), HasSubstr("this store (its name is unknown); wait"));
  std::ofstream(file) << "\n\n";
  EXPECT_FALSE(value_of(LockFile::acquire(path, {})).left_behind()) << "it names no process";
  std::ofstream(file) << "pid=1 host=x and much more that is longer than our text, which it is not"
                         " any more afterwards\n";
  {
    auto lock = value_of(LockFile::acquire(path, {}));
    EXPECT_TRUE(lock.left_behind());
    EXPECT_EQ(whole_file(file), holder + "\n");
    lock.set_suspect(true);
  }
  EXPECT_TRUE(std::filesystem::exists(file)) << "its store is suspect";
  EXPECT_TRUE(value_of(LockFile::acquire(path, {})).left_behind());
}

TEST(HasWriter, GoesByTheProcessThatTheLockFileNames) {
  const TemporaryFolder folder;
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});
  const std::filesystem::path path = folder / "s.db";
  EXPECT_FALSE(has_writer(path));
  auto store = open_store(path, campaign);
  EXPECT_TRUE(has_writer(path));
  std::filesystem::create_symlink(path, folder / "link.db");
  EXPECT_TRUE(has_writer(folder / "link.db"));
  store.reset();
  EXPECT_FALSE(has_writer(path));
  const auto left_by = [&](const std::string& holder) {
    std::ofstream(path.string() + ".lock") << holder;
    return has_writer(path);
  };
  EXPECT_TRUE(left_by("pid=1 host=another-host\n")) << "who knows";
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  EXPECT_TRUE(left_by(fmt::format("pid={} host={}\n", ::getpid(), host.data())));
  EXPECT_FALSE(left_by(fmt::format("pid=99999999 host={}\n", host.data())));
  EXPECT_FALSE(left_by(fmt::format("pid=0 host={}\n", host.data())));
  EXPECT_FALSE(left_by(fmt::format("pid=-1 host={}\n", host.data())));
  EXPECT_FALSE(left_by(fmt::format("of {}\n", ::getpid())));
  EXPECT_FALSE(left_by(""));
}

}  // namespace
}  // namespace swarmsmith
