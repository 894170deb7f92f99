#include "cli/output/status_text.h"

#include <numeric>

#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

/// A thousand workers on fifty hosts, one of them bad, at thirty designs.
LiveStatus cluster() {
  LiveStatus status;
  status.workers = 1000;
  status.slots = 64'000;
  status.used_per_s = 100;
  std::vector<WorkerStatus> fleet;
  for (int i = 0; i < 1000; ++i) {
    fleet.push_back({.number = i + 1,
                     .state = "connected",
                     .host = "node" + std::to_string(i % 50),
                     .slots = 64,
                     .failed = i == 7 ? 12 : 0,
                     .busy = 0.9});
  }
  status.fleet = std::make_shared<const std::vector<WorkerStatus>>(fleet);
  CampaignStatus campaign{.name = "thesis", .state = "running"};
  for (int i = 0; i < 30; ++i) {
    campaign.designs.push_back({.id = {i + 1},
                                .mission = "aggregation",
                                .method = "argos3",
                                .state = i < 20 ? DesignState::Finished : DesignState::Racing,
                                .used = i < 20 ? 990 : 100,
                                .budget = 1000});
  }
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  SlotTimes& times = status.slot_times_last_minute;
  times.slots = 100;
  times.busy = 75;
  times.idle[static_cast<std::size_t>(IdleCause::Barrier)] = 20;
  times.idle[static_cast<std::size_t>(IdleCause::Network)] = 5;
  return status;
}

std::string joined(const std::vector<std::string>& lines) {
  return std::accumulate(
      lines.begin(), lines.end(), std::string(),
      [](std::string text, const std::string& line) { return std::move(text) + line + "\n"; });
}

TEST(StatusText, FitsAScreenWithTheWorstHostFirst) {
  const std::vector<std::string> lines = status_lines(cluster(), {80, 24});
  EXPECT_LE(lines.size(), 24U);
  for (const std::string& line : lines)
    EXPECT_LE(line.size(), 80U) << line;
  const auto headline = std::ranges::find_if(
      lines, [](const std::string& line) { return line.starts_with("host "); });
  ASSERT_NE(headline, lines.end());
  EXPECT_THAT(*(headline + 1), HasSubstr("node7 "));
  EXPECT_THAT(joined(lines), AllOf(HasSubstr("... and"), HasSubstr("d21")));
}

TEST(StatusText, TellsTheTimeWhereItIsTheBudget) {
  CampaignStatus campaign{.name = "c", .state = "running", .max_time = 300.5};
  campaign.designs.push_back({.id = {1}, .state = DesignState::Racing, .used = 57});
  LiveStatus status;
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  EXPECT_THAT(joined(status_lines(status, {200, 100})),
              AllOf(HasSubstr("experiments 57  time budget 300.5 a design"),
                    HasSubstr("57/time 300.5"), Not(HasSubstr("/0"))));
  EXPECT_THAT(status_summary(status), HasSubstr("experiments 57  workers"));
  EXPECT_LT(seconds_left(status), 0) << "how much is left is not known";
}

TEST(StatusText, TellsTheMeanOfTheTestsOnceADesignIsFinished) {
  CampaignStatus campaign{.name = "c", .state = "running"};
  for (const DesignState state : {DesignState::Testing, DesignState::Finished})
    campaign.designs.push_back({.id = {state == DesignState::Testing ? 1 : 2},
                                .state = state,
                                .used = 900,
                                .best = {7},
                                .best_mean = 3,
                                .test_mean = 2.25,
                                .test_runs = 50});
  LiveStatus status;
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  const std::vector<std::string> lines = status_lines(status, {200, 100});
  EXPECT_THAT(joined(lines), HasSubstr("2.25 in tests"));
  EXPECT_THAT(*std::ranges::find_if(lines, [](auto& line) { return line.starts_with("d1 "); }),
              AllOf(HasSubstr(" 3 "), Not(HasSubstr("tests"))));
}

TEST(StatusText, TellsCostsOfProgramsAsTheySayThem) {
  CampaignStatus campaign{.name = "c", .state = "finished", .costs = true};
  campaign.designs.push_back({.id = {1},
                              .mission = "m",
                              .state = DesignState::Finished,
                              .used = 9,
                              .best = {7},
                              .best_mean = -0.25});
  LiveStatus status;
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  EXPECT_THAT(joined(status_lines(status, {200, 100})), HasSubstr(" cost 0.25 "));
}

TEST(StatusText, TellsNoMeanOfAnImportedMachine) {
  CampaignStatus campaign{.name = "c", .state = "imported"};
  campaign.designs.push_back(
      {.id = {1}, .mission = "m", .state = DesignState::Finished, .best = {1}});
  LiveStatus status;
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  const std::vector<std::string> lines = status_lines(status, {200, 100});
  const auto line = std::ranges::find_if(lines, [](auto& each) { return each.starts_with("d1 "); });
  ASSERT_NE(line, lines.end());
  EXPECT_THAT(line->substr(line->find("it ") + 6, 8), Not(HasSubstr("0")));
}

TEST(StatusText, SaysWhereTheTimeGoesAndWhenItEnds) {
  const std::string text = joined(status_lines(cluster(), {200, 100}));
  EXPECT_THAT(text, HasSubstr("last minute  busy 75 %  barrier 20 %  on the way 5 %\n"));
  EXPECT_THAT(text, HasSubstr("[##############################bbbbbbbboo]"));
  EXPECT_THAT(text,
              HasSubstr("campaign thesis  running  designs 20/30  experiments 20800/30000 (70 %)"));
  EXPECT_THAT(text, HasSubstr("ETA 1m30s"));
}

TEST(StatusText, PromisesNoEndWhenNothingMoves) {
  LiveStatus status = cluster();
  status.used_per_s = 0;
  status.trouble = "disk full";
  const std::string text = joined(status_lines(status, {200, 100}));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("ETA")), HasSubstr("NOTHING IS STORED: disk full")));
  EXPECT_THAT(status_summary(status), HasSubstr("NOTHING IS STORED"));
}

TEST(StatusText, HasNothingToShowBeforeAWorkerCame) {
  EXPECT_THAT(joined(status_lines({}, {80, 24})), HasSubstr("no heartbeats yet"));
  EXPECT_THAT(status_lines(cluster(), {80, 2}), ::testing::SizeIs(2));
}

}  // namespace
}  // namespace swarmsmith::cli
