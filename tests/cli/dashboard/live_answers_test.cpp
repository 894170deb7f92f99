#include "cli/dashboard/live_answers.h"

#include <chrono>
#include <filesystem>
#include <utility>

#include "tests/cli/dashboard/asking.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;
using testing::SizeIs;

History::Time at(double seconds) {
  return History::Time(
      std::chrono::duration_cast<History::Time::duration>(std::chrono::duration<double>(seconds)));
}

json told(const History& history, double after_s) {
  return json::parse(history.json(after_s).text());
}

TEST(HistoryTest, AfterATimeThatWasToldComesOnlyWhatIsLater) {
  History history;
  LiveStatus status;
  // Answers have times in milliseconds; they are taken more exactly.
  for (const double time : {1000.0004, 1001.0004, 1002.0004}) {
    status.done += 10;
    history.add(status, at(time));
  }
  const json all = told(history, 0);
  EXPECT_THAT(all["t_s"], ElementsAre(1000.0, 1001.0, 1002.0));
  EXPECT_THAT(all["evaluations_per_s"], SizeIs(3));
  EXPECT_THAT(told(history, 1001)["t_s"], ElementsAre(1002.0));
  EXPECT_THAT(told(history, 1002)["t_s"], IsEmpty());
  history.add(status, at(1003.0004));
  EXPECT_THAT(told(history, 1002)["t_s"], ElementsAre(1003.0));
}

/// A store that is being written, and a dashboard of the process that writes it.
class GrowingStoreTest : public testing::Test {
 protected:
  GrowingStoreTest() : campaign_(synthetic_campaign({})) {
    store_ = Store::open(file_, campaign_.campaign, campaign_.designs).value();
    DashboardOptions options{.stores = {{file_, 0, true}}};
    options.program = SWARMSMITH_BIN_DIR "/swarmsmith";
    asking_.site = make_dashboard(std::move(options));
  }
  /// So many of the campaign's batches.
  void write(std::size_t count) {
    for (; count > 0 && written_ < campaign_.batches.size(); --count)
      store_->append(std::move(campaign_.batches[written_++]));
    store_->flush();
  }
  std::size_t steps() const { return asking_.json("c1/designs/d1/steps")["step"].size(); }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "growing.db";
  SyntheticCampaign campaign_;
  std::unique_ptr<Store> store_;
  std::size_t written_ = 0;
  Asking asking_{file_};
};

TEST_F(GrowingStoreTest, WhatLiveHasToldOfIsInEveryAnswerAfterIt) {
  write(campaign_.batches.size() / 4);
  const std::size_t before = steps();
  write(campaign_.batches.size());
  const json live = asking_.json("live");
  ASSERT_EQ(live["campaigns"][0]["designs"][0]["iteration"], 3);
  EXPECT_GT(steps(), before) << "the answer of a moment ago lacks what `live` has told of";
}

TEST_F(GrowingStoreTest, TheRaceWithoutANumberIsTheNewestAtEachTime) {
  // A batch for an iteration's beginning, one a step, and one for its elites. The second iteration
  // has begun, and has no step yet.
  write(1 + 7 + 1 + 1);
  const json first = asking_.json("c1/designs/d1/race");
  EXPECT_EQ(first["iteration"], 1);
  EXPECT_EQ(first["ended"], true);
  write(campaign_.batches.size());
  asking_.json("live");
  EXPECT_EQ(asking_.json("c1/designs/d1/race")["iteration"], 3);
}

TEST_F(GrowingStoreTest, AnotherFileUnderTheNameIsAnotherStore) {
  write(1);
  ASSERT_EQ(asking_.json("c1")["campaign"]["name"], campaign_.campaign.name);
  SyntheticCampaign other = synthetic_campaign({});
  other.campaign.name = "another";
  store_.reset();
  std::filesystem::rename(file_, folder_ / "moved.db");
  for (const char* ending : {"-wal", "-shm"})
    std::filesystem::remove(file_.string() + ending);
  store_ = Store::open(file_, other.campaign, other.designs).value();
  asking_.json("live");
  EXPECT_EQ(asking_.json("c1")["campaign"]["name"], "another");
}

TEST_F(GrowingStoreTest, ItsReadersGoWithTheDashboard) {
  write(campaign_.batches.size());
  asking_.json("live");
  asking_.site.reset();
  store_.reset();
  EXPECT_FALSE(std::filesystem::exists(file_.string() + "-wal")) << "the log is in the file";
}

}  // namespace
}  // namespace swarmsmith::cli
