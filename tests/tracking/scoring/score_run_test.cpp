#include "tracking/scoring/score_run.h"

#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

Mission mission_of(const char* name, int cycles) {
  Mission mission = built_in_mission(name).value();
  mission.cycles = cycles;
  return mission;
}

/// Robots that stand still at (x, 0), (0.2, 0) and (-0.1, 0.3).
TrackedRun standing_at(double x, double noise_px = 0.05) {
  const Truth still = [x](int robot, double /*time_s*/) {
    if (robot == 0) return Pose{x, 0, 0};
    return robot == 1 ? Pose{0.2, 0, 0} : Pose{-0.1, 0.3, 2};
  };
  SeenRun seen = seen_run(still, {.cycles = 100, .noise_px = noise_px});
  seen.options.scored_at_the_end = true;
  return seen.track().value();
}

TEST(ScoreRunTest, IsTheSimulatorsScoreWithDistancesToTheBorder) {
  const Mission mission = mission_of("aggregation", 100);
  const ScoredRun scored = score_run(standing_at(0.7), mission, {}, {}).value();
  EXPECT_EQ(scored.score, 2);
  EXPECT_EQ(scored.verdict, Verdict::Valid);
  EXPECT_FALSE(scored.biased);
  EXPECT_TRUE(scored.reasons.empty());
  ASSERT_EQ(scored.borders.size(), 3U);
  EXPECT_NEAR(scored.borders[0]->signed_m, -0.2, 0.001);
  EXPECT_NEAR(scored.borders[1]->signed_m, 0.3, 0.001);
  EXPECT_EQ(scored.borders[1]->border, "black spot at (0, 0)");
  EXPECT_FALSE(scored.borders[1]->too_close);
}

TEST(ScoreRunTest, SaysWhatIsTooCloseToCall) {
  const Mission mission = mission_of("aggregation", 100);
  const ScoredRun scored = score_run(standing_at(0.5002), mission, {}, {}).value();
  EXPECT_TRUE(scored.borders[0]->too_close);
  EXPECT_EQ(scored.verdict, Verdict::Degraded);
  ASSERT_EQ(scored.reasons.size(), 1U);
  EXPECT_THAT(scored.reasons[0], HasSubstr("W_TOO_CLOSE_TO_CALL: rvr1 ends"));
  EXPECT_THAT(scored.reasons[0], HasSubstr("may count 1"));
  // The noise is a tenth of a millimetre; survey, height and tilt are 2.7 mm, and 5 mm are within
  // three of them.
  EXPECT_EQ(score_run(standing_at(0.505), mission, {}, {})->verdict, Verdict::Degraded);
  EXPECT_EQ(score_run(standing_at(0.512), mission, {}, {})->verdict, Verdict::Valid);
}

/// Between frames a robot is less sure than in them; what counts is how sure it is at the end.
TEST(ScoreRunTest, AsksHowWellTheLastInstantIsKnown) {
  const Mission mission = mission_of("aggregation", 100);
  TrackedRun run = standing_at(0.512);
  run.robots[0].sigmas.front().sigma_m = 0.005;
  EXPECT_EQ(score_run(run, mission, {}, {})->verdict, Verdict::Valid);
  run.robots[0].sigmas.back().sigma_m = 0.005;
  const ScoredRun scored = score_run(run, mission, {}, {}).value();
  EXPECT_EQ(scored.verdict, Verdict::Degraded);
  EXPECT_TRUE(scored.borders[0]->too_close);
  EXPECT_EQ(scored.borders[0]->sigma_m, 0.005);
  EXPECT_THAT(scored.reasons[0], HasSubstr("is known to 15.0 mm (3 sigma)"));
}

TEST(ScoreRunTest, TheVerdictFollowsFromAllIssues) {
  const Mission mission = mission_of("aggregation", 100);
  TrackedRun run = standing_at(0.7);
  const auto verdict = [&](std::vector<Issue> before) {
    return score_run(run, mission, {}, before)->verdict;
  };
  EXPECT_EQ(verdict({{IssueCode::UnknownTags, "tag 7", {}, {}, {}}}), Verdict::Valid);
  EXPECT_EQ(verdict({{IssueCode::FramesDropped, "6 %", {}, {}, {}}}), Verdict::Degraded);
  run.issues.push_back({IssueCode::Gap, "rvr1 was not seen", "rvr1", 1, 3});
  const ScoredRun scored =
      score_run(run, mission, {}, {{IssueCode::FramesDropped, "6 %", {}, {}, {}}}).value();
  EXPECT_EQ(scored.verdict, Verdict::Invalid);
  EXPECT_THAT(scored.reasons, ElementsAre("W_FRAMES_DROPPED: 6 %", "E_GAP: rvr1 was not seen"));
  EXPECT_EQ(scored.score, 2);  // provisional
  run.issues = {{IssueCode::TagAsCentre, "rvr1", "rvr1", {}, {}}};
  EXPECT_TRUE(score_run(run, mission, {}, {})->biased);
}

TEST(ScoreRunTest, OfAllInstantsHasNoBorders) {
  const ScoredRun scored =
      score_run(standing_at(0.7), mission_of("grid_exploration", 100), {}, {}).value();
  EXPECT_LT(scored.score.value(), 0);
  EXPECT_THAT(scored.borders, testing::Each(testing::Eq(std::nullopt)));
}

TEST(ScoreRunTest, OfColoursNeedsThePatches) {
  const Mission mission = mission_of("color_selection", 100);
  const TrackedRun run = standing_at(0.7);
  EXPECT_THAT(score_run(run, mission, {}, {}).error().message, HasSubstr("E_LAYOUT_MISSING"));
  const Instance instance = instance_of(mission, 3).value();
  const ScoredRun scored = score_run(run, mission, instance.patches, {}).value();
  EXPECT_EQ(scored.score, score_of(mission, instance, run.trajectory));
}

TEST(ScoreRunTest, RefusesWhatNoCameraCanScore) {
  const TrackedRun run = standing_at(0.7);
  Mission mission = mission_of("aggregation", 100);
  mission.robots = 4;
  EXPECT_THAT(score_run(run, mission, {}, {}).error().message,
              HasSubstr("E_CONFIG: the mission has 4 robots, and 3 were tracked"));
  EXPECT_THAT(score_run(run, mission_of("aggregation", 1200), {}, {}).error().message,
              HasSubstr("1200 cycles, and 100"));
  mission = mission_of("aggregation", 100);
  mission.rule = ObjectsOn{};
  EXPECT_THAT(score_run(run, mission, {}, {}).error().message, HasSubstr("movable objects"));
}

TEST(ScoreRunTest, KnowsWhatIsScoredAtTheEnd) {
  EXPECT_TRUE(is_scored_at_the_end(mission_of("aggregation", 1)));
  EXPECT_TRUE(is_scored_at_the_end(mission_of("color_selection", 1)));
  EXPECT_FALSE(is_scored_at_the_end(mission_of("grid_exploration", 1)));
}

}  // namespace
}  // namespace swarmsmith
