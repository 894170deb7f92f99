#include <algorithm>
#include <cmath>

#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/resampling.h"

namespace swarmsmith {
namespace {

const Seeing kFirst{.cycles = 300, .noise_px = 0.1, .seed = 1};
/// Another rate, another clock, more noise.
const Seeing kSecond{.cycles = 300, .frame_rate = 25, .noise_px = 0.2, .seed = 2, .clock_s = 3.07};

SeenRun two_cameras(const Seeing& first = kFirst, const Seeing& second = kSecond) {
  SeenRun seen = seen_run(on_circle, first);
  add_camera(seen, on_circle, second, {0.3, 0.2});
  return seen;
}

TEST(SeveralCamerasTest, TogetherAreBetterThanTheBetterOne) {
  const double alone = rms_error(seen_run(on_circle, kFirst).track().value());
  const TrackedRun both = two_cameras().track().value();
  EXPECT_LT(rms_error(both), 0.97 * alone);
  EXPECT_TRUE(both.issues.empty()) << both.issues.front().text;
}

TEST(SeveralCamerasTest, OneThatSeesNothingTakesNothing) {
  SeenRun seen = two_cameras();
  const TrackedRun alone = seen_run(on_circle, kFirst).track().value();
  for (int tag = 1; tag <= 3; ++tag)
    seen.hide(tag, -10, 100, 1);
  EXPECT_EQ(seen.track()->trajectory, alone.trajectory);
}

TEST(SeveralCamerasTest, HandARobotOver) {
  SeenRun seen = two_cameras();
  seen.hide(1, 14.99, 100, 0);
  seen.hide(1, -10, 15.03, 1);
  seen.hide(2, 10, 12, 0);  // seen by the other
  const TrackedRun run = seen.track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_LT(rms_error(run), 0.002);
  EXPECT_EQ(std::ranges::count(run.robots[0].cycles, CycleKind::Measured), 300);
}

TEST(SeveralCamerasTest, ATwinThatOneOfThemSeesIsCounted) {
  SeenRun seen = two_cameras();
  std::vector<Sighting> twins = seen.observations.sightings;
  std::erase_if(twins, [](const Sighting& of) {
    return of.camera != 0 || of.tag != 1 || of.frame < 200 || of.frame > 230;
  });
  for (Sighting& twin : twins) {
    for (ImagePoint& corner : twin.corners)
      corner.u += 300;
    seen.observations.sightings.push_back(twin);
  }
  EXPECT_THAT(issue_of(seen.track().value(), IssueCode::DuplicateId).text,
              HasSubstr("twice in 31 frames"));
}

TEST(SeveralCamerasTest, DisagreementIsSaidWithNumbers) {
  SeenRun seen = two_cameras();
  // A clock 60 ms off is 18 mm at 0.3 m/s.
  seen.options.span.starts_s[1] += 0.06;
  const TrackedRun run = seen.track().value();
  const Issue& issue = issue_of(run, IssueCode::CamerasDisagree);
  EXPECT_EQ(issue.robot, "rvr1");
  EXPECT_THAT(issue.text, HasSubstr("more than 10 mm apart in "));
}

TEST(SeveralCamerasTest, DoNotDependOnTheOrderOfSightings) {
  SeenRun seen = two_cameras();
  const TrackedRun before = seen.track().value();
  std::ranges::reverse(seen.observations.sightings);
  EXPECT_EQ(seen.track()->trajectory, before.trajectory);
}

}  // namespace
}  // namespace swarmsmith
