#include <set>

#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

using Outcome = Check::Outcome;

std::vector<std::string> of(const TrackedRun& run, Outcome outcome) {
  std::vector<std::string> names;
  for (const Check& check : run.checks)
    if (check.outcome == outcome) names.push_back(check.name + ", " + check.subject);
  return names;
}

/// What every list of checks must be.
void expect_sound(const TrackedRun& run, const std::string& what) {
  SCOPED_TRACE(what);
  std::set<std::pair<std::string, std::string>> asked;
  bool has_failed = false;
  bool has_warned = false;
  for (const Check& check : run.checks) {
    EXPECT_TRUE(asked.emplace(check.name, check.subject).second) << check.name << " twice";
    EXPECT_FALSE(check.name.empty() || check.catches.empty()) << check.name;
    EXPECT_EQ(check.reason.empty(), check.outcome != Outcome::NotRun) << check.name;
    has_failed |= check.outcome == Outcome::Failed;
    has_warned |= check.outcome == Outcome::Warned;
  }
  const auto is_wrong = [](const Issue& issue) { return is_error(issue.code); };
  EXPECT_EQ(has_failed, std::ranges::any_of(run.issues, is_wrong));
  EXPECT_EQ(has_warned, !std::ranges::all_of(run.issues, is_wrong));
}

TEST(ChecksTest, OfACleanRunPassAndSayWhatWasNotAsked) {
  SeenRun seen = seen_run(on_circle, {.cycles = 200});
  seen.options.scored_at_the_end = true;
  const TrackedRun run = seen.track().value();
  expect_sound(run, "clean");
  EXPECT_THAT(of(run, Outcome::Failed), IsEmpty());
  EXPECT_THAT(of(run, Outcome::Warned), IsEmpty());
  EXPECT_THAT(
      of(run, Outcome::NotRun),
      ElementsAre("length of the film, camera0", "cameras agree, rvr1", "cameras agree, rvr2",
                  "cameras agree, rvr3", "reach of the lens calibration, camera0",
                  // They drive on one and the same circle all the time.
                  "tag against the treads, rvr1", "tag against the treads, rvr2",
                  "tag against the treads, rvr3", "direction of time, "));
  // Each robot and the camera are asked all that there is to ask.
  for (const char* robot : {"rvr1", "rvr2", "rvr3"}) {
    const auto asked = std::ranges::count(run.checks, robot, &Check::subject);
    EXPECT_EQ(asked, std::ranges::count(run.checks, "rvr1", &Check::subject));
    EXPECT_GE(asked, 12);
    const Check* gap = find_check(run, "longest gap", robot);
    ASSERT_NE(gap, nullptr);
    EXPECT_NEAR(gap->value.value(), 1.0 / 30, 1e-6);
    EXPECT_EQ(gap->limit, 1.0);
    EXPECT_EQ(gap->unit, "s");
    EXPECT_NE(find_check(run, "gap around the last instant", robot), nullptr);
  }
  for (const char* name : {"repeated pictures", "length of the film", "clock of the film",
                           "steps of the clock", "speed of the robots"})
    EXPECT_EQ(std::ranges::count(run.checks, name, &Check::name), 1) << name;
  EXPECT_NEAR(find_check(run, "frame rate", "camera0")->value.value(), 30, 1e-6);
  EXPECT_LT(find_check(run, "camera stayed where it was", "camera0")->value.value(), 0.1);
}

TEST(ChecksTest, SayWhatFailedWhereAndByHowMuch) {
  SeenRun hidden = seen_run(on_circle, {.cycles = 200});
  hidden.hide(2, 5, 6.4);
  const TrackedRun lost = hidden.track().value();
  expect_sound(lost, "hidden");
  EXPECT_EQ(find_check(lost, "longest gap", "rvr2")->outcome, Outcome::Failed);
  EXPECT_GT(find_check(lost, "longest gap", "rvr2")->value.value(), 1.4);
  EXPECT_EQ(find_check(lost, "longest gap", "rvr1")->outcome, Outcome::Passed);

  SeenRun slow = seen_run(on_circle, {.cycles = 200, .frame_rate = 8});
  const TrackedRun few = slow.track().value();
  expect_sound(few, "8 frames/s");
  EXPECT_EQ(find_check(few, "frame rate", "camera0")->outcome, Outcome::Failed);

  SeenRun wrong = seen_run(on_circle, {.cycles = 200});
  for (RobotSetup& robot : wrong.rig.robots)
    robot.edge_m = 0.09;
  const TrackedRun sized = wrong.track().value();
  expect_sound(sized, "edge");
  const Check* scale = find_check(sized, "size of the tag", "rvr3");
  EXPECT_EQ(scale->outcome, Outcome::Failed);
  EXPECT_NEAR(scale->value.value(), 100 * (0.1 / 0.09 - 1), 0.1);

  SeenRun centre = seen_run(on_circle, {.cycles = 200});
  centre.rig.offsets.erase("rvr1.offset.toml");
  centre.options.takes_tags_for_centres = true;
  const TrackedRun biased = centre.track().value();
  expect_sound(biased, "tag as centre");
  EXPECT_EQ(find_check(biased, "fit of the tag's offset", "rvr1")->outcome, Outcome::Warned);
  EXPECT_EQ(find_check(biased, "fit of the tag's offset", "rvr2")->outcome, Outcome::Passed);
}

TEST(ChecksTest, ThatNeedWhatIsNotThereSayWhatIsMissing) {
  SeenRun blind = seen_run(on_circle, {.cycles = 200});
  blind.observations.cameras[0].references.clear();
  const TrackedRun run = blind.track().value();
  expect_sound(run, "no floor tags");
  const Check* moved = find_check(run, "camera stayed where it was", "camera0");
  ASSERT_NE(moved, nullptr);
  EXPECT_EQ(moved->outcome, Outcome::NotRun);
  EXPECT_EQ(moved->reason, "none of its floor tags was seen");
  EXPECT_EQ(find_check(run, "floor tags seen until the end", "camera0")->outcome, Outcome::Warned);

  SeenRun timed = seen_run(on_circle, {.cycles = 200});
  timed.observations.cameras[0].time_source = TimeSource::FrameRate;
  timed.options.span.lengths_s = {30.0};
  const TrackedRun fast = timed.track().value();
  expect_sound(fast, "length");
  EXPECT_EQ(find_check(fast, "length of the film", "camera0")->outcome, Outcome::Failed);

  SeenRun two = seen_run(on_circle, {.cycles = 200});
  add_camera(two, on_circle, {.cycles = 200}, {0.3, 0.2});
  const TrackedRun both = two.track().value();
  expect_sound(both, "two cameras");
  EXPECT_EQ(find_check(both, "cameras agree", "rvr1")->outcome, Outcome::Passed);
}

}  // namespace
}  // namespace swarmsmith
