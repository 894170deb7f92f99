#include "coordinator/service/telemetry.h"

#include <gtest/gtest.h>

#include "tests/coordinator/synthetic_campaign.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// One campaign of two designs, and rows by hand.
class Telemetries : public ::testing::Test {
 protected:
  static std::vector<TelemetryCampaign> campaigns() {
    return {
        {.name = "c",
         .designs = {{.id = {1}, .mission = "m", .method = "x", .repetition = 1, .budget = 100},
                     {.id = {2}, .mission = "m", .method = "x", .repetition = 2, .budget = 100}},
         .states = {{.design = {1}, .state = DesignState::Finished, .used = 90}}}};
  }
  LiveStatus status() { return telemetry.status(coordinator, now, true); }

  cluster::SyntheticCampaign source{{}};
  Coordinator coordinator{CoordinatorOptions{}, {{.digest = "d", .source = &source}}};
  TimePoint now{seconds(1000)};
  Telemetry telemetry{campaigns(), now};
};

TEST_F(Telemetries, NothingIsLeftOfDesignsThatAreOver) {
  const CampaignTotals totals = status().campaigns->front().totals();
  EXPECT_EQ(totals.used, 90);
  EXPECT_EQ(totals.budget, 200);
  EXPECT_EQ(totals.left, 100);
}

TEST_F(Telemetries, AnExtensionCountsFromTheStepAfterWhichItActs) {
  CommandRow extension{
      .number = 1, .kind = CommandKind::Extend, .design = {1}, .step = std::nullopt, .budget = 50};
  telemetry.on_rows(0, std::vector<Row>{extension}, now);
  EXPECT_EQ(status().campaigns->front().totals().budget, 200) << "it is asked for, and waits";
  extension.step = 9;
  telemetry.on_rows(
      0,
      std::vector<Row>{extension,
                       DesignStateRow{.design = {1}, .state = DesignState::Racing, .used = 90}},
      now);
  const CampaignStatus one = status().campaigns->front();
  EXPECT_EQ(one.designs.front().budget, 150);
  EXPECT_EQ(one.totals().budget, 250);
  EXPECT_EQ(one.totals().left, 160);
}

TEST_F(Telemetries, BeginWithTheCommandsOfTheStore) {
  std::vector<TelemetryCampaign> stored = campaigns();
  stored.front().commands = {
      {.number = 1, .kind = CommandKind::Extend, .design = {1}, .step = 9, .budget = 50},
      {.number = 2, .kind = CommandKind::Pause, .design = {1}, .step = std::nullopt},
      {.number = 3, .kind = CommandKind::Pause, .design = {2}, .step = std::nullopt}};
  Telemetry resumed(stored, now);
  const auto campaign = resumed.status(coordinator, now, true).campaigns->front();
  EXPECT_EQ(campaign.designs[0].budget, 150);
  EXPECT_FALSE(campaign.designs[0].paused) << "it is over";
  EXPECT_TRUE(campaign.designs[1].paused);
}

TEST_F(Telemetries, TestsOfAFinishedDesignSayHowGoodItsBestIs) {
  const CandidateId winner{1'000'001};
  const auto test = [&](std::int64_t number, double score) {
    return EvaluationRow{.key = {winner, Purpose::Test, number}, .measured = {.score = score}};
  };
  const auto state = [&](DesignState now_in) {
    return DesignStateRow{
        .design = {2}, .state = now_in, .used = 90, .best = winner, .best_mean = 5};
  };
  telemetry.on_rows(0, std::vector<Row>{state(DesignState::Testing), test(1, 2), test(2, 4)}, now);
  EXPECT_EQ(status().campaigns->front().designs[1].told_mean(), 5) << "not all are done";
  telemetry.on_rows(0, std::vector<Row>{test(3, 3), state(DesignState::Finished)}, now);
  const DesignStatus design = status().campaigns->front().designs[1];
  EXPECT_EQ(design.test_runs, 3);
  EXPECT_DOUBLE_EQ(design.told_mean(), 3);
  EXPECT_EQ(design.best_mean, 5);
}

TEST_F(Telemetries, TestsOfBeforeCountOn) {
  std::vector<TelemetryCampaign> stored = campaigns();
  const CandidateId winner{1};
  stored.front().states = {
      {.design = {1}, .state = DesignState::Testing, .used = 90, .best = winner, .best_mean = 5}};
  stored.front().tested = {{.winner = winner, .mean = 2, .runs = 3}};
  Telemetry resumed(stored, now);
  resumed.on_rows(
      0,
      std::vector<Row>{EvaluationRow{.key = {winner, Purpose::Test, 4}, .measured = {.score = 6}},
                       DesignStateRow{.design = {1},
                                      .state = DesignState::Finished,
                                      .used = 90,
                                      .best = winner,
                                      .best_mean = 5}},
      now);
  const auto campaign = resumed.status(coordinator, now, true).campaigns->front();
  EXPECT_EQ(campaign.designs[0].test_runs, 4);
  EXPECT_DOUBLE_EQ(campaign.designs[0].told_mean(), 3);
}

TEST_F(Telemetries, TheEndIsToldFromTheRecentRateOrNotAtAll) {
  EXPECT_LT(seconds_left(status()), 0);
  for (int i = 1; i <= 10; ++i) {
    now += seconds(1);
    telemetry.on_rows(0, std::vector<Row>{RaceStepRow{.design = {2}, .step = i, .used = 5 * i}},
                      now);
    status();
  }
  EXPECT_NEAR(status().used_per_s, 5, 0.01);
  EXPECT_NEAR(seconds_left(status()), 10, 0.1);
  // Nothing moves any more.
  for (int i = 0; i < 200; ++i) {
    now += seconds(1);
    status();
  }
  EXPECT_LT(seconds_left(status()), 0);
}

TEST_F(Telemetries, StepsAndCommitsAreTimed) {
  telemetry.on_rows(0, std::vector<Row>{RaceStepRow{.design = {2}, .step = 1}}, now);
  telemetry.on_rows(0, std::vector<Row>{RaceStepRow{.design = {2}, .step = 2}}, now + seconds(2));
  telemetry.on_appended(0, 1, now);
  telemetry.on_appended(0, 2, now + milliseconds(10));
  EXPECT_EQ(telemetry.queued_units(), 2U);
  telemetry.on_committed(0, 1, now + milliseconds(20));
  const CampaignStatus one = status().campaigns->front();
  EXPECT_EQ(one.step_time.count(), 1U);
  EXPECT_NEAR(one.step_time.sum, 2, 1e-9);
  EXPECT_EQ(one.commit_time.count(), 1U);
  EXPECT_NEAR(one.commit_time.sum, 0.02, 1e-9);
  EXPECT_EQ(one.queued_units, 1);
}

TEST_F(Telemetries, AStatusComesBackFromItsJson) {
  telemetry.on_frame_in(17);
  LiveStatus sent = status();
  sent.malformed_by["header"] = 3;
  sent.slot_times.slots = 8;
  sent.slot_times.idle[static_cast<std::size_t>(IdleCause::Network)] = 2;
  sent.fleet = std::make_shared<const std::vector<WorkerStatus>>(
      std::vector<WorkerStatus>{{.number = 4, .host = "node\xff"}});
  const auto got = live_status_of(to_json(sent).text());
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->bytes_in, 17);
  EXPECT_EQ(got->malformed_by.at("header"), 3U);
  EXPECT_EQ(got->slot_times.idle_total(), 2);
  EXPECT_EQ(got->campaigns->front().designs.size(), 2U);
  EXPECT_EQ(got->fleet->front().number, 4);
  EXPECT_FALSE(live_status_of("{}"));
  EXPECT_FALSE(live_status_of("rubbish"));
}

TEST(Histograms, BoundsBelongToTheTimesBelow) {
  Histogram histogram;
  histogram.observe(0.001);
  histogram.observe(0.0011);
  histogram.observe(5000.0);
  EXPECT_EQ(histogram.counts[2], 1U);
  EXPECT_EQ(histogram.counts[3], 1U);
  EXPECT_EQ(histogram.counts.back(), 1U);
  EXPECT_EQ(histogram.count(), 3U);
}

}  // namespace
}  // namespace swarmsmith
