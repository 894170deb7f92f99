#include <fmt/format.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>

#include "storage/internal/sqlite.h"
#include "storage/store_at_rest.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// What a store said last.
class LastNews {
 public:
  void operator()(const WriterNews& news) {
    const std::lock_guard guard(mutex_);
    news_ = news;
    changed_.notify_all();
  }
  WriterNews when_lost() {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [&] { return news_.is_lost; });
    return news_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  WriterNews news_;
};

/// A file is what it is, whatever it is called.
struct IdentityTest : testing::Test {
  TemporaryFolder folder;
  fs::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});
  LastNews news;

  std::unique_ptr<Store> filled_store() {
    auto store = swarmsmith::filled_store(path, campaign);
    EXPECT_TRUE(store->flush());
    store->set_listener(std::ref(news));
    return store;
  }
  Error refusal(const fs::path& name) {
    return why_not(Store::open(name, campaign.campaign, campaign.designs));
  }
  std::string wanted() { return digest_after(campaign, campaign.batches); }

  /// Something happens to the files of a store that has nothing to write: it notices, says
  /// `sentence`, and all that it had is in a file from which the campaign goes on.
  void expect_saved(const std::function<void()>& happening, const std::string& sentence) {
    const fs::path saved = path.string() + ".saved";
    auto store = filled_store();
    happening();
    const WriterNews last = news.when_lost();
    EXPECT_THAT(last.trouble, HasSubstr(sentence));
    EXPECT_THAT(last.trouble, HasSubstr(saved.string()));
    EXPECT_EQ(last.committed, campaign.batches.size());
    EXPECT_EQ(why_not(store->flush()).kind, ErrorKind::Conflict);
    store.reset();
    EXPECT_EQ(digest_of(saved), wanted());
    EXPECT_TRUE(fs::exists(path.string() + ".lock")) << "so that the next program checks it";
    for (const char* ending : {"-wal", "-shm"})
      EXPECT_FALSE(fs::exists(path.string() + ending)) << ending;
    // As the sentence says.
    fs::rename(saved, path);
    EXPECT_NE(open_store(path, campaign), nullptr);
    EXPECT_EQ(digest_of(path), wanted());
  }
};

TEST_F(IdentityTest, ALinkIsTheFileThatItLeadsTo) {
  const fs::path link = folder / "link.db";
  fs::create_symlink("s.db", link);
  EXPECT_NE(open_store(link, campaign), nullptr) << "of a store that is still to be made";
  EXPECT_TRUE(fs::exists(path));
  const auto writer = filled_store();
  EXPECT_EQ(refusal(link).kind, ErrorKind::Conflict);
  EXPECT_THAT(refusal(link).message, HasSubstr(fmt::format("pid={}", ::getpid())));
  EXPECT_EQ(digest_of(link), wanted());
}

TEST_F(IdentityTest, ARenamedFileGetsNoSecondWriter) {
  const auto writer = filled_store();
  const fs::path renamed = folder / "renamed.db";
  fs::rename(path, renamed);
  const Error error = refusal(renamed);
  EXPECT_EQ(error.kind, ErrorKind::Conflict);
  EXPECT_THAT(error.message, HasSubstr(fmt::format("pid={} host=", ::getpid())));
  EXPECT_FALSE(StoreAtRest::open(renamed, StoreAtRest::IfMissing::Refuse));
}

TEST_F(IdentityTest, AFileWithTwoNamesIsRefused) {
  filled_store();
  const fs::path other = folder / "other.db";
  fs::create_hard_link(path, other);
  for (const fs::path& name : {path, other}) {
    EXPECT_EQ(refusal(name).kind, ErrorKind::BadInput);
    EXPECT_THAT(refusal(name).message, HasSubstr("second name"));
    EXPECT_FALSE(StoreReader::open(name));
  }
  fs::remove(other);
  EXPECT_NE(open_store(path, campaign), nullptr);
}

TEST_F(IdentityTest, AReaderThatStaysDoesNotKeepTheRightToWrite) {
  filled_store();
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->designs().size(), 1U);
  for (int i = 0; i < 3; ++i)
    EXPECT_NE(open_store(path, campaign), nullptr) << i;
  sqlite::Connection other(path.string(), SQLITE_OPEN_READWRITE);
  sqlite::Connection third(path.string(), SQLITE_OPEN_READWRITE);
  EXPECT_NE(other.descriptor(), third.descriptor());
}

TEST_F(IdentityTest, ADeletedStoreIsSaved) {
  expect_saved([&] { fs::remove(path); }, "the store was deleted while it was being written");
}

TEST_F(IdentityTest, ADeletedStoreIsSavedWithItsLogDeletedToo) {
  expect_saved(
      [&] {
        for (const char* ending : {"-wal", "-shm", ""})
          fs::remove(path.string() + ending);
      },
      " while it was being written");
}

TEST_F(IdentityTest, ARenamedStoreIsSaved) {
  const fs::path renamed = folder / "renamed.db";
  expect_saved([&] { fs::rename(path, renamed); },
               "the store was renamed to " + renamed.string() + " while");
}

TEST_F(IdentityTest, AReplacedStoreIsSavedAndWhatHasItsNameIsLeftAlone) {
  const fs::path other = folder / "other";
  std::ofstream(other) << "another file";
  expect_saved(
      [&] {
        fs::rename(other, path);
        fs::create_hard_link(path, other);
      },
      "the store was deleted, and another file has its name, while");
  EXPECT_EQ(whole_file(other), "another file");
}

TEST_F(IdentityTest, AStoreWithoutItsLogIsSaved) {
  expect_saved([&] { fs::remove(path.string() + "-wal"); }, "s.db-wal, which SQLite needs");
}

TEST_F(IdentityTest, AStoreWithoutItsSharedMemoryIsSaved) {
  expect_saved([&] { fs::remove(path.string() + "-shm"); }, "s.db-shm, which SQLite needs");
}

TEST_F(IdentityTest, AStoreThatIsDeletedJustBeforeItIsClosedIsSavedToo) {
  auto store = filled_store();
  fs::remove(path);
  store.reset();
  EXPECT_EQ(digest_of(path.string() + ".saved"), wanted());
}

TEST_F(IdentityTest, ALogThatReplacesTheStoresStaysThere) {
  const fs::path log = path.string() + "-wal";
  auto store = filled_store();
  std::ofstream(folder / "other") << "another log";
  fs::rename(folder / "other", log);
  store.reset();
  EXPECT_EQ(whole_file(log), "another log");
  EXPECT_EQ(digest_of(path.string() + ".saved"), wanted());
}

TEST_F(IdentityTest, AStoreWhoseFolderIsGoneIsSavedWhereTheProcessIs) {
  const fs::path elsewhere = folder / "elsewhere", home = fs::current_path();
  fs::create_directory(elsewhere);
  path = folder / "store" / "s.db";
  for (const bool is_replaced : {false, true}) {
    fs::create_directory(path.parent_path());
    auto store = filled_store();
    fs::remove_all(path.parent_path());
    if (is_replaced) std::ofstream(path.parent_path()) << "a file";
    fs::current_path(elsewhere);
    store.reset();
    fs::current_path(home);
    EXPECT_EQ(digest_of(elsewhere / (is_replaced ? "s.db.saved-2" : "s.db.saved")), wanted());
  }
}

TEST_F(IdentityTest, NothingIsSavedOverAnotherFile) {
  const fs::path saved = path.string() + ".saved";
  std::ofstream(saved) << "an earlier one";
  auto store = filled_store();
  fs::remove(path);
  EXPECT_THAT(news.when_lost().trouble, HasSubstr(saved.string() + "-2"));
  store.reset();
  EXPECT_EQ(fs::file_size(saved), std::string("an earlier one").size());
  EXPECT_EQ(digest_of(saved.string() + "-2"), wanted());
}

TEST_F(IdentityTest, AnAdditionToALostStoreIsRefusedAndSaved) {
  filled_store();
  auto store = value_of(StoreAtRest::open(path, StoreAtRest::IfMissing::Refuse));
  fs::remove(path);
  const Error added = why_not(store->add({.rows = {EventRow{.severity = "info", .kind = "mark"}}}));
  EXPECT_EQ(added.where, path.string());
  EXPECT_THAT(added.message, HasSubstr("s.db.saved"));
  store.reset();
  const auto reader = open_reader(path.string() + ".saved");
  EXPECT_EQ(cells_of(*reader, "SELECT count(*) FROM event WHERE kind = 'mark'").front().front(),
            "1");
}

}  // namespace
}  // namespace swarmsmith
