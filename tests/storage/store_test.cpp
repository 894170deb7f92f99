#include "storage/store.h"

#include <gmock/gmock.h>
#include <algorithm>

#include <bit>
#include <cmath>
#include <condition_variable>
#include <future>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "storage/answer.h"
#include "tests/storage/fixture.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

struct StoreTest : testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign();

  void write_all(const std::vector<std::vector<Row>>& batches) {
    auto store = open_store(path, campaign);
    for (const auto& batch : batches)
      store->append(batch);
    store->flush();
  }
  /// A store with the campaign's first batch, which has the first candidates.
  std::unique_ptr<Store> begun() {
    auto store = open_store(path, campaign);
    store->append(campaign.batches.front());
    return store;
  }
  static EvaluationRow evaluation(double score) {
    EvaluationRow row;
    row.key = {.candidate = {1}, .purpose = Purpose::Race, .pair = 1};
    row.iteration = 1;
    row.measured.score = score;
    row.measured.state_digest = 0xfedcba9876543210U;
    row.source = "rvr";
    return row;
  }
};

TEST_F(StoreTest, GivesBackEveryRowOfTheAnswer) {
  write_all(campaign.batches);
  const std::vector<Row> stored = open_reader(path)->answer_rows();
  const auto is_stored = [&](const Row& row) {
    return std::any_of(stored.begin(), stored.end(),
                       [&](const Row& other) { return same_answer(row, other); });
  };
  std::size_t expected = 0;
  for (const auto& batch : campaign.batches) {
    for (const Row& row : batch) {
      const bool replaced_later = std::holds_alternative<CandidateTotalsRow>(row) ||
                                  std::holds_alternative<DesignStateRow>(row);
      if (!in_answer(row) || replaced_later) continue;
      ++expected;
      EXPECT_TRUE(is_stored(row)) << describe(row);
    }
  }
  const auto absolute = std::count_if(stored.begin(), stored.end(), [](const Row& row) {
    return std::holds_alternative<CandidateTotalsRow>(row) ||
           std::holds_alternative<DesignStateRow>(row);
  });
  EXPECT_EQ(stored.size(), expected + static_cast<std::size_t>(absolute));
}

TEST_F(StoreTest, TellsTheTestsOfItsDesigns) {
  write_all(campaign.batches);
  const auto tested = open_store(path, campaign)->tested_designs();
  const auto reader = open_reader(path);
  ASSERT_EQ(tested.size(), campaign.designs.size());
  for (const TestedDesign& one : tested) {
    const auto end = reader->query(
        "SELECT test_mean, test_runs FROM v_leaderboard WHERE candidate = " +
            std::to_string(one.winner.value),
        {}, [](const auto&) {},
        [&](const auto& cells) {
          EXPECT_DOUBLE_EQ(cells[0].real(), one.mean);
          EXPECT_EQ(cells[1].integer(), one.runs);
        });
    ASSERT_TRUE(end);
    EXPECT_EQ(end->rows, 1);
  }
}

TEST_F(StoreTest, KeepsTheLastOfRowsWithAbsoluteValues) {
  write_all(campaign.batches);
  const auto rows = cells_of(*open_reader(path),
                             "SELECT runs, score_sum FROM candidate_totals WHERE candidate = 1");
  CandidateTotalsRow last;
  for (const auto& batch : campaign.batches) {
    for (const Row& row : batch) {
      const auto* totals = std::get_if<CandidateTotalsRow>(&row);
      if (totals != nullptr && totals->candidate.value == 1) last = *totals;
    }
  }
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0][0], std::to_string(last.runs));
  EXPECT_EQ(std::stod(rows[0][1]), last.score_sum);
}

TEST_F(StoreTest, KeepsCampaignAndDesignsAsTheyWereGiven) {
  write_all({});
  const auto reader = open_reader(path);
  EXPECT_EQ(reader->campaign().digest, campaign.campaign.digest);
  EXPECT_EQ(reader->campaign().deciding, campaign.campaign.deciding);
  EXPECT_EQ(reader->campaign().file, campaign.campaign.file);
  ASSERT_EQ(reader->designs().size(), campaign.designs.size());
  EXPECT_EQ(reader->designs()[1].mission, campaign.designs[1].mission);
  EXPECT_EQ(reader->designs()[1].seed, campaign.designs[1].seed);
}

TEST_F(StoreTest, TakesTheSameRowsTwiceWithoutHarm) {
  write_all(campaign.batches);
  const std::string once = digest_of(path);
  const auto evaluations = open_reader(path)->scores().size();
  write_all(campaign.batches);
  EXPECT_EQ(digest_of(path), once);
  EXPECT_EQ(open_reader(path)->scores().size(), evaluations);
}

TEST_F(StoreTest, KeepsTheBitsOfScoresAndDigests) {
  for (const double score : {0.1, -5e-324, 1.7976931348623157e308, 381000.0, 0x1.fffffp-30}) {
    const TemporaryFolder own;
    auto store = open_store(own / "s.db", campaign);
    store->append(campaign.batches.front());
    store->append({evaluation(score)});
    store->flush();
    const auto scores = store->scores();
    ASSERT_EQ(scores.size(), 1U);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(scores[0].measured.score),
              std::bit_cast<std::uint64_t>(score));
    EXPECT_EQ(scores[0].measured.state_digest, 0xfedcba9876543210U);
  }
}

TEST_F(StoreTest, KeepsTheFirstOfTwoDifferentResults) {
  auto store = begun();
  store->append({evaluation(1.0)});
  store->append({evaluation(2.0)});
  EvaluationRow rejected = evaluation(0);
  rejected.status = EvaluationStatus::Rejected;
  store->append({rejected});
  store->flush();
  ASSERT_EQ(store->scores().size(), 1U);
  EXPECT_EQ(store->scores()[0].measured.score, 1.0);
  EXPECT_EQ(store->scores()[0].status, EvaluationStatus::Ok);
}

TEST_F(StoreTest, LetsTheRaceTakeUpWhatWasComputedAheadOnlyWithTheSameBits) {
  auto store = begun();
  EvaluationRow ahead = evaluation(1.0);
  ahead.iteration = 0;
  store->append({ahead});
  store->append({evaluation(2.0)});
  store->flush();
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT iteration FROM evaluation")[0][0], "NULL");
  store->append({evaluation(1.0)});
  store->flush();
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT iteration FROM evaluation")[0][0], "1");
}

TEST_F(StoreTest, RefusesNumbersThatAreNotFinite) {
  auto store = begun();
  EvaluationRow rejected = evaluation(std::numeric_limits<double>::quiet_NaN());
  rejected.status = EvaluationStatus::Rejected;  // and has no score
  EXPECT_NO_THROW(store->append({rejected}));
  std::vector<Row> bad;
  const auto with = [&bad](const auto& row, auto... fields) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
      const auto add = [&](auto field) {
        auto changed = row;
        changed.*field = value;
        bad.emplace_back(changed);
      };
      (add(fields), ...);
    }
  };
  with(RaceStepRow{}, &RaceStepRow::mean_best, &RaceStepRow::statistic, &RaceStepRow::p_value,
       &RaceStepRow::kendall_w, &RaceStepRow::spearman_rho, &RaceStepRow::qvar,
       &RaceStepRow::bound);
  with(EliminationRow{}, &EliminationRow::rank_sum);
  with(EliteRow{}, &EliteRow::mean);
  with(CandidateTotalsRow{}, &CandidateTotalsRow::score_sum, &CandidateTotalsRow::score_squares);
  with(DesignStateRow{}, &DesignStateRow::best_mean);
  with(ConflictRow{}, &ConflictRow::kept_score, &ConflictRow::other_score);
  with(evaluation(1), &EvaluationRow::bound);
  EvaluationRow timed = evaluation(1);
  timed.measured.time = std::numeric_limits<double>::infinity();
  bad.emplace_back(timed);
  bad.emplace_back(evaluation(-std::numeric_limits<double>::infinity()));
  for (const Row& row : not_empty(bad)) {
    try {
      store->append({row});
      ADD_FAILURE() << describe(row);
    } catch (const std::invalid_argument& refused) {
      EXPECT_EQ(refused.what(), "a number is not finite in " + describe(row));
    }
  }
  ASSERT_TRUE(store->flush());
  EXPECT_EQ(store->scores().size(), 1U);
}

TEST_F(StoreTest, EndsWithRowsThatItCanNeverTake) {
  auto store = begun();
  store->append({CandidateTotalsRow{.candidate = {999}, .runs = 1}});  // of no candidate
  EXPECT_THAT(to_string(why_not(store->flush())), HasSubstr("so no more are written"));
}

TEST_F(StoreTest, CountsTicketsFromOneAndTellsThemInOrderBeforeFlushReturns) {
  auto store = open_store(path, campaign);
  std::vector<std::uint64_t> told;
  store->set_listener([&](const WriterNews& news) {
    EXPECT_EQ(news.trouble, "");
    told.push_back(news.committed);
  });
  std::uint64_t wanted = 0;
  for (const auto& batch : campaign.batches)
    EXPECT_EQ(store->append(batch), ++wanted);
  store->flush();
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), wanted);
}

/// A thread that waits in flush(), and a large group, do not wait for more rows.
TEST_F(StoreTest, CommitsAtOnceForAFlushAndForALargeGroup) {
  auto store = open_store(path, campaign, {.gather = std::chrono::hours(1)});
  std::mutex mutex;
  std::condition_variable told;
  std::uint64_t committed = 0;
  store->set_listener([&](const WriterNews& news) {
    const std::lock_guard lock(mutex);
    committed = news.committed;
    told.notify_all();
  });
  for (int i = 0; i < 2; ++i) {
    store->append(campaign.batches.front());
    ASSERT_TRUE(store->flush());
  }
  for (int i = 0; i < 1024; ++i)
    store->append({evaluation(1)});
  std::unique_lock lock(mutex);
  EXPECT_TRUE(told.wait_for(lock, std::chrono::seconds(60), [&] { return committed > 2; }));
}

TEST_F(StoreTest, NumbersItsWorkersFromOneOn) {
  auto store = begun();
  EXPECT_EQ(store->next_worker(), 1);
  WorkerRow worker;
  worker.id = 4;
  store->append({worker});
  ASSERT_TRUE(store->flush());
  EXPECT_EQ(store->next_worker(), 5);
}

TEST_F(StoreTest, CommitsWhatIsQueuedWhenItEndsAndLeavesOneFile) {
  fill_store(path, campaign);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names, testing::ElementsAre("s.db"));
  EXPECT_TRUE(open_reader(path)->finished());
}

TEST_F(StoreTest, IsReadByOthersWhileItIsWritten) {
  auto store = begun();
  store->flush();
  const auto reader = open_reader(path);
  EXPECT_TRUE(reader->scores().empty());
  store->append({evaluation(1.0)});
  store->flush();
  EXPECT_EQ(reader->scores().size(), 1U);
}

TEST_F(StoreTest, GivesAResumedCampaignItsScoresAndSteps) {
  write_all(campaign.batches);
  auto store = open_store(path, campaign);
  const auto scores = store->scores();
  EXPECT_TRUE(std::is_sorted(scores.begin(), scores.end(),
                             [](const auto& a, const auto& b) { return a.key < b.key; }));
  EXPECT_EQ(scores.size(), open_reader(path)->scores().size());
  EXPECT_EQ(store->steps().size(), 2U * 3U * 7U);
  EXPECT_TRUE(store->finished());
}

TEST_F(StoreTest, KeepsWorkersConflictsAndEventsForPeople) {
  auto store = begun();
  WorkerRow worker;
  worker.id = 1;
  worker.host = "node3";
  worker.state = WorkerState::Connected;
  store->append({worker});
  worker.state = WorkerState::Lost;
  worker.done = 12;
  store->append({worker, evaluation(1.0)});
  const ConflictRow conflict{.key = evaluation(1).key, .kept_score = 1, .other_score = 2};
  store->append({conflict, conflict});
  store->append({EventRow{.severity = "warning", .kind = "worker lost", .text = "{}"}});
  store->flush();
  const auto reader = open_reader(path);
  EXPECT_EQ(cells_of(*reader, "SELECT state, done FROM v_workers"),
            (std::vector<std::vector<std::string>>{{"lost", "12"}}));
  EXPECT_EQ(cells_of(*reader, "SELECT other_score FROM conflict").size(), 1U);
  EXPECT_EQ(cells_of(*reader, "SELECT kind FROM event")[0][0], "worker lost");
}

TEST_F(StoreTest, RemembersWhoIsNotBelieved) {
  auto store = begun();
  EXPECT_FALSE(store->trust().distrusted);
  WorkerRow worker;
  worker.id = 4;
  worker.principal = "node@10.0.0.5";
  worker.state = WorkerState::Quarantined;
  const EvaluationKey audited{{7}, Purpose::Race, 3};
  store->append({worker, CampaignStateRow{"distrusted"},
                 AttemptRow{.key = audited, .outcome = AttemptOutcome::Audited},
                 AttemptRow{.key = {{8}, Purpose::Race, 3}, .outcome = AttemptOutcome::Lost}});
  store->flush();
  const StoredTrust trust = store->trust();
  EXPECT_EQ(trust.audited, std::set<EvaluationKey>{audited});
  EXPECT_TRUE(trust.distrusted);
  ASSERT_EQ(trust.quarantined.size(), 1U);
  EXPECT_EQ(trust.quarantined[0].principal, "node@10.0.0.5");
  EXPECT_EQ(trust.quarantined[0].identity, "");
  EXPECT_EQ(trust.principals.at(4), "node@10.0.0.5");
}

TEST_F(StoreTest, RemembersWhyAndForgetsWhomAPersonForgives) {
  auto store = begun();
  WorkerRow keyed{.id = 4, .identity = "aa", .state = WorkerState::Quarantined, .client = "node"};
  keyed.principal = "node@10.0.0.5";
  WorkerRow plain{.id = 5, .identity = "bb", .state = WorkerState::Quarantined};
  plain.principal = "loopback";
  store->append({keyed, plain,
                 event_row("error", "workers in quarantine",
                           {{"who", "node@10.0.0.5"}, {"reason", "it \"lied\""}}),
                 event_row("error", "workers in quarantine",
                           {{"who", "loopback"}, {"reason", "another"}, {"worker", 9}}),
                 event_row("error", "workers in quarantine",
                           {{"who", "loopback"}, {"reason", "its own"}, {"worker", 5}})});
  store->flush();
  std::vector<Quarantine> all = store->trust().quarantined;
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].reason, "it \"lied\"");
  EXPECT_EQ(all[0].since.size(), std::string("2026-01-02T03:04:05.678Z").size());
  EXPECT_EQ(all[1].identity, "bb") << "without a key it is one process";
  EXPECT_EQ(all[1].reason, "its own");
  store->append({ForgivenRow{"node@10.0.0.5"}});
  store->flush();
  all = store->trust().quarantined;
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].principal, "loopback");
}

TEST_F(StoreTest, KeepsASecretUntilTheCampaignIsFinished) {
  const std::string secret = "the quick brown fox jumps over it";
  auto store = begun();
  EXPECT_EQ(store->keep_secret(secret), secret);
  EXPECT_EQ(store->keep_secret("another"), secret);
  store->append({CampaignStateRow{"finished"}});
  store->flush();
  EXPECT_EQ(cells_of(*open_reader(path), "SELECT * FROM meta WHERE key = 'lease_secret'").size(),
            0U);
  store.reset();
  EXPECT_EQ(whole_file(path).find(secret), std::string::npos) << "stores are published";
}

}  // namespace
}  // namespace swarmsmith
