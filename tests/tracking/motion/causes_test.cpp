#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"

namespace swarmsmith {
namespace {

constexpr Seeing kFilm{.cycles = 100, .frame_rate = 15};

std::string refusal(const SeenRun& seen) {
  const auto run = seen.track();
  return run ? "" : run.error().message;
}

/// A robot that carries another one's number.
TEST(CausesTest, OneNumberOnTwoRobots) {
  SeenRun seen = seen_run(on_circle, kFilm);
  for (Sighting& sighting : seen.observations.sightings)
    if (sighting.tag == 1) sighting.tag = 2;
  EXPECT_THAT(refusal(seen), HasSubstr("rvr1 (tag 1) was not seen"));
  EXPECT_THAT(refusal(seen), HasSubstr("tag 2 is there twice in 166 of the 166 frames"));
}

TEST(CausesTest, ATagThatDoesNotLieLevel) {
  SeenRun seen = seen_run(on_circle, kFilm);
  for (Sighting& sighting : seen.observations.sightings) {
    if (sighting.tag != 2) continue;
    // One side is nearer to the camera.
    const double middle = (sighting.corners[0].u + sighting.corners[2].u) / 2;
    for (ImagePoint& corner : sighting.corners)
      corner.u = middle + 0.8 * (corner.u - middle);
  }
  EXPECT_THAT(refusal(seen), HasSubstr("E_ROBOT_MISSING: rvr2 (tag 2) was seen"));
  EXPECT_THAT(refusal(seen), HasSubstr("does not lie level"));
}

TEST(CausesTest, WhatIsOddAboutTheFilm) {
  SeenRun seen = seen_run(on_circle, kFilm);
  std::erase_if(seen.observations.sightings, [](const Sighting& s) { return s.tag == 1; });
  seen.observations.issues.push_back({IssueCode::FilmOdd, "a.mp4: it is interlaced", {}, {}, {}});
  EXPECT_THAT(refusal(seen), HasSubstr("start. Note: a.mp4: it is interlaced"));
}

TEST(CausesTest, ADamagedFileIsNotACameraThatRanTooShort) {
  SeenRun seen = seen_run(on_circle, kFilm);
  seen.cut(6, 100);
  EXPECT_THAT(find_issue(*seen.track(), IssueCode::VideoTruncated)->text,
              HasSubstr("let the camera run"));
  seen.observations.issues.push_back({IssueCode::VideoTruncated, "it broke off", {}, {}, {}});
  EXPECT_THAT(find_issue(*seen.track(), IssueCode::VideoTruncated)->text,
              HasSubstr("damaged or cut off"));
  seen.observations.issues.clear();
  seen.observations.cameras[0].damaged_frames = 60;
  EXPECT_THAT(find_issue(*seen.track(), IssueCode::VideoTruncated)->text,
              HasSubstr("60 of the file's pictures are damaged"));
}

}  // namespace
}  // namespace swarmsmith
