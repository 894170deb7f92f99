#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "base/rng.h"
#include "tests/storage/fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/long_runs.h"

namespace swarmsmith {
namespace {

constexpr StoreOptions kHasty{.retry = std::chrono::milliseconds(1),
                              .gather = std::chrono::milliseconds(1)};

/// Batches that carry a mark each, so that it can be seen which of them are in a store.
std::vector<std::vector<Row>> marked(std::vector<std::vector<Row>> batches) {
  for (std::size_t i = 0; i < batches.size(); ++i) {
    batches[i].push_back(
        EventRow{.severity = "info", .kind = "mark", .text = std::to_string(i + 1)});
  }
  return batches;
}

/// How many marks from 1 on there are without a hole; what comes after a hole would be a loss.
std::uint64_t marks_in_order(StoreReader& reader, const std::string& kind = "mark") {
  const auto marks =
      cells_of(reader, "SELECT DISTINCT CAST(text AS INTEGER) FROM event WHERE kind = '" + kind +
                           "' ORDER BY 1");
  for (std::size_t i = 0; i < marks.size(); ++i) {
    EXPECT_EQ(marks[i][0], std::to_string(i + 1)) << "a batch is missing";
  }
  return marks.size();
}

/// What a store told, for a thread that waits for it.
class Told {
 public:
  void operator()(const WriterNews& news) {
    const std::lock_guard guard(mutex_);
    committed_ = std::max(committed_, news.committed);
    if (!news.trouble.empty()) trouble_ = news.trouble;
    well_again_ = news.trouble.empty();
    changed_.notify_all();
  }
  /// Until everything is committed or there is trouble.
  std::uint64_t wait_for(std::uint64_t ticket) {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [&] { return committed_ >= ticket || !trouble_.empty(); });
    return committed_;
  }
  std::string trouble() {
    const std::lock_guard guard(mutex_);
    return trouble_;
  }
  bool well_again() {
    const std::lock_guard guard(mutex_);
    return well_again_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t committed_ = 0;
  std::string trouble_;
  bool well_again_ = true;
};

/// From one change of the disk that fails to the next.
const std::int64_t kStep = times<std::int64_t>(4, 1);

struct CrashTest : testing::Test {
  SyntheticCampaign campaign =
      synthetic_campaign({.designs = 1, .iterations = 1, .candidates = 6, .steps = 5});
  std::string wanted = digest_after(campaign, campaign.batches);
};

/// A store that is open on a disk that has become full.
struct OnAFullDisk {
  explicit OnAFullDisk(const SyntheticCampaign& campaign)
      : store(open_store(path(), campaign, kHasty)) {
    store->set_listener(std::ref(told));
    disk.fail_at(1, SQLITE_FULL, 1'000'000'000);
  }
  std::filesystem::path path() const { return folder / "s.db"; }

  TemporaryFolder folder;
  FaultyDisk disk;
  Told told;
  std::unique_ptr<Store> store;
};

TEST_F(CrashTest, AnyChangeOfTheDiskMayFailAndNothingIsLost) {
  for (const int code : {SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_IOERR_FSYNC}) {
    bool failed = true;
    for (std::int64_t n = 1; failed; n += kStep) {
      const TemporaryFolder folder;
      FaultyDisk disk;
      Told told;
      {
        auto store = open_store(folder / "s.db", campaign, kHasty);
        store->set_listener(std::ref(told));
        const std::int64_t before = disk.changes();
        disk.fail_at(n, code, 2);
        for (const auto& batch : campaign.batches) {
          store->append(batch);
          while (!store->flush()) {
          }
        }
        failed = disk.changes() >= before + n;
        store.reset();
      }
      EXPECT_TRUE(told.well_again());
      EXPECT_EQ(told.trouble().empty(), !failed) << "change " << n << ", code " << code;
      EXPECT_EQ(digest_of(folder / "s.db"), wanted) << "change " << n << ", code " << code;
      EXPECT_TRUE(open_reader(folder / "s.db")->integrity().empty());
    }
  }
}

TEST_F(CrashTest, AFlushThatTheDiskRefusesSaysSoAndTheNextOneTriesAgain) {
  OnAFullDisk full(campaign);
  for (const auto& batch : campaign.batches)
    full.store->append(batch);
  auto flushing = std::async(std::launch::async, [&] { return full.store->flush(); });
  const bool returned = eventually(
      [&] { return flushing.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  EXPECT_TRUE(returned) << "flush() waits for room, and says nothing";
  EXPECT_THAT(full.told.trouble(), testing::HasSubstr("full"));
  full.disk.fail_at(1, SQLITE_OK);
  const auto flushed = flushing.get();
  if (returned) {
    EXPECT_EQ(why_not(flushed).kind, ErrorKind::Unavailable);
    EXPECT_THAT(why_not(flushed).message, testing::HasSubstr("cannot be written"));
  }
  EXPECT_TRUE(eventually([&] { return full.store->flush().has_value(); }));
  EXPECT_TRUE(full.told.well_again());
  EXPECT_EQ(digest_of(full.path()), wanted);
}

TEST_F(CrashTest, AFailureAtTheBirthOfAStoreLeavesOneThatOpens) {
  bool failed = true;
  for (std::int64_t n = 1; failed; n += kStep) {
    const TemporaryFolder folder;
    FaultyDisk disk;
    disk.fail_at(n, SQLITE_FULL, 1000);
    const auto store = Store::open(folder / "s.db", campaign.campaign, campaign.designs);
    failed = !store;
    if (failed) {
      EXPECT_EQ(store.error().kind, ErrorKind::Unavailable);
      EXPECT_THAT(store.error().message, testing::HasSubstr("full"));
      disk.fail_at(1, SQLITE_OK);
      EXPECT_NE(open_store(folder / "s.db", campaign), nullptr) << "change " << n;
    }
    ASSERT_LT(n, 1000);
  }
}

TEST_F(CrashTest, APowerCutAtAnyMomentLosesNothingThatWasAcknowledged) {
  const auto batches = marked(campaign.batches);
  bool was_cut = true;
  for (std::int64_t n = 1; was_cut; n += kStep) {
    const TemporaryFolder folder;
    const auto path = folder / "s.db";
    FaultyDisk disk;
    std::uint64_t acknowledged = 0;
    disk.cut_power_at(n);
    if (auto store = Store::open(path, campaign.campaign, campaign.designs, kHasty); store) {
      Told told;
      (*store)->set_listener(std::ref(told));
      for (const auto& batch : batches) {
        acknowledged = told.wait_for((*store)->append(batch));
        if (!told.trouble().empty()) break;
      }
      store->reset();
    }
    was_cut = disk.power_is_off();
    Rng rng(static_cast<std::uint64_t>(n));
    disk.restart(rng);
    auto store = open_store(path, campaign);
    ASSERT_NE(store, nullptr) << "cut at change " << n;
    EXPECT_GE(marks_in_order(*open_reader(path)), acknowledged) << "cut at change " << n;
    for (const auto& batch : batches)
      store->append(batch);
    store.reset();
    EXPECT_EQ(digest_of(path), wanted) << "cut at change " << n;
    EXPECT_TRUE(open_reader(path)->integrity().empty());
  }
}

TEST_F(CrashTest, AFullDiskIsToldAndWhatIsLeftWhenTheStoreEndsIsWhatWasTold) {
  OnAFullDisk full(campaign);
  full.told.wait_for(full.store->append(marked(campaign.batches).front()));
  EXPECT_THAT(full.told.trouble(), testing::HasSubstr("full"));
  full.store.reset();
  full.disk.fail_at(1, SQLITE_OK);
  EXPECT_EQ(marks_in_order(*open_reader(full.path())), 0U);
}

/// Writes marked batches until it is killed, and tells each ticket that was acknowledged.
[[noreturn]] void write_until_killed(const std::filesystem::path& path,
                                     const SyntheticCampaign& campaign, int round, int to) {
  auto store = Store::open(path, campaign.campaign, campaign.designs);
  if (!store) ::_exit(1);
  (*store)->set_listener(
      [to](const WriterNews& news) { (void)!::write(to, &news.committed, sizeof news.committed); });
  for (std::uint64_t ticket = 1;; ++ticket) {
    std::vector<Row> batch = campaign.batches[ticket % campaign.batches.size()];
    if (ticket == 1) batch = campaign.batches.front();
    batch.push_back(EventRow{.severity = "info",
                             .kind = fmt::format("round {}", round),
                             .text = std::to_string(ticket)});
    (*store)->append(std::move(batch));
    if (ticket % 7 == 0) std::this_thread::yield();
    if (ticket % 50 == 0) (*store)->flush();
  }
}

TEST_F(CrashTest, AKilledWriterHasLostNothingThatItAcknowledged) {
  const TemporaryFolder folder;
  const auto path = folder / "s.db";
  Rng rng(7);
  for (int round = 1; round <= 25; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(path, campaign, round, ends[1]);
    ::close(ends[1]);
    std::uint64_t acknowledged = 0;
    const std::uint64_t last_words = 1 + rng.below(40);
    for (std::uint64_t i = 0; i < last_words; ++i) {
      ASSERT_EQ(::read(ends[0], &acknowledged, sizeof acknowledged), 8);
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(ends[0], &acknowledged, sizeof acknowledged) == 8)
      continue;
    ::close(ends[0]);
    const auto reader = open_reader(path);
    EXPECT_GE(marks_in_order(*reader, fmt::format("round {}", round)), acknowledged);
    EXPECT_TRUE(reader->integrity().empty());
  }
  fill_store(path, campaign);
  EXPECT_EQ(digest_of(path), wanted);
}

}  // namespace
}  // namespace swarmsmith
