#include "tracking/observing/observations.h"

#include <gmock/gmock.h>

#include "tracking/observing/reference_medians.h"

namespace swarmsmith {
namespace {

TagCorners corners_at(double u, double v) {
  return {{{u, v}, {u + 10, v}, {u + 10, v - 10}, {u, v - 10}}};
}

TEST(ObservationsTest, CamerasAreNumberedInTheirOrder) {
  CameraObservations left;
  left.record.camera = "left";
  left.sightings = {{0, 0, 0.1, 1, {}, 0, 50}, {0, 1, 0.2, 1, {}, 0, 50}};
  left.issues = {{IssueCode::VideoTruncated, "left.mp4: broke off", {}, {}, {}}};
  CameraObservations right;
  right.record.camera = "right";
  right.sightings = {{0, 0, 0.15, 2, {}, 0, 50}};
  const Observations all = joined_observations({left, right});
  ASSERT_EQ(all.cameras.size(), 2U);
  EXPECT_EQ(all.cameras[1].camera, "right");
  ASSERT_EQ(all.sightings.size(), 3U);
  EXPECT_EQ(all.sightings[1].camera, 0);
  EXPECT_EQ(all.sightings[2].camera, 1);
  EXPECT_EQ(all.sightings[2].tag, 2);
  EXPECT_EQ(all.issues.size(), 1U);
}

/// An outlier of one frame, and a push of the camera after 5 s.
TEST(ReferenceMediansTest, AreTakenOverSpans) {
  ReferenceMedians medians(5);
  for (int i = 0; i < 80; ++i) {
    const double time_s = 100 + 0.1 * i;
    medians.add(time_s, 7,
                corners_at((i == 3 ? 900 : 50) + (i >= 50 ? 4 : 0) + 0.001 * (i % 3), 60));
    if (i < 20) medians.add(time_s, 3, corners_at(5, 6));
  }
  const std::vector<ReferenceLook> looks = medians.take();
  ASSERT_EQ(looks.size(), 3U);
  EXPECT_EQ(looks[0].tag, 3);
  EXPECT_EQ(looks[0].frames, 20);
  EXPECT_EQ(looks[1].tag, 7);
  EXPECT_EQ(looks[1].frames, 50);
  EXPECT_NEAR(looks[1].time_s, 102.5, 1e-9);
  EXPECT_NEAR(looks[1].corners[0].u, 50.001, 1e-9);
  EXPECT_EQ(looks[2].tag, 7);
  EXPECT_EQ(looks[2].frames, 30);
  EXPECT_NEAR(looks[2].corners[1].u, 64.001, 1e-9);
  EXPECT_NEAR(looks[2].time_s, (105 + 107.9) / 2, 1e-9);
  EXPECT_TRUE(medians.take().empty());
}

TEST(ReferenceMediansTest, OfAnEvenNumberIsBetweenTheMiddleTwo) {
  ReferenceMedians medians(5);
  double time_s = 0;
  for (const double u : {4.0, 1.0, 3.0, 100.0})
    medians.add(time_s += 0.1, 1, corners_at(u, 0));
  EXPECT_EQ(medians.take()[0].corners[0].u, 3.5);
}

}  // namespace
}  // namespace swarmsmith
