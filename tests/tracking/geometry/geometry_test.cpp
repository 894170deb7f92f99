#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/support/overhead_camera.h"
#include "tracking/geometry/tag_pose.h"

namespace swarmsmith {
namespace {

/// 2.7 m above the floor, looking down, tilted by an angle about the world's x axis.
View view_from_above(double tilt_rad) {
  const double c = std::cos(tilt_rad);
  const double s = std::sin(tilt_rad);
  View view{wide_camera(), {{1, 0, 0, 0, -c, s, 0, -s, -c}, {0, 0, 0}}};
  const Point3 down = view.place.seen_from_camera({0, 0, 2.7});
  view.place.translation = {-down.x, -down.y, -down.z};
  return view;
}

TEST(CameraModelTest, RaysComeBackToTheirPixelsUpToTheCorners) {
  const CameraModel camera = wide_camera();
  const std::vector<ImagePoint> points{
      {0, 0}, {1919, 1079}, {1919, 0}, {960, 540}, {300.25, 900.5}};
  const std::vector<Ray> rays = rays_of(camera, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImagePoint back = image_of(camera, {rays[i].x, rays[i].y, 1});
    EXPECT_NEAR(back.u, points[i].u, 1e-6);
    EXPECT_NEAR(back.v, points[i].v, 1e-6);
  }
}

/// Written out from the formulas of tracking facts, section 2.
TEST(CameraModelTest, FollowsTheBrownModel) {
  const CameraModel camera = wide_camera();
  const double x = 0.4;
  const double y = -0.3;
  const double r2 = x * x + y * y;
  const double g = 1 - 0.285 * r2 + 0.08 * r2 * r2;
  const double u = x * g + 2 * 0.0005 * x * y - 0.0003 * (r2 + 2 * x * x);
  const double v = y * g + 0.0005 * (r2 + 2 * y * y) - 2 * 0.0003 * x * y;
  const ImagePoint seen = image_of(camera, {2 * x, 2 * y, 2});
  EXPECT_NEAR(seen.u, 1015 * u + 959.5, 1e-9);
  EXPECT_NEAR(seen.v, 1015 * v + 539.5, 1e-9);
}

TEST(CameraModelTest, SeesWhenAModelFolds) {
  CameraModel camera = wide_camera();
  EXPECT_TRUE(is_monotonic(camera));
  camera.distortion = {-0.5, 0, 0, 0, 0};
  EXPECT_FALSE(is_monotonic(camera));
}

TEST(ViewTest, PointsComeBackFromTheImageToTheirPlane) {
  const View view = view_from_above(0.06);
  EXPECT_NEAR(view.place.centre().z, 2.7, 1e-12);
  for (const double height : {0.0, 0.2}) {
    for (const Point point : {Point{1.2, 0}, Point{-0.9, 0.8}, Point{0, 0}}) {
      const std::vector<ImagePoint> seen{image_of(view, Point3{point.x, point.y, height})};
      const Point back = on_plane(view, seen, height).front();
      EXPECT_NEAR(back.x, point.x, 1e-8);
      EXPECT_NEAR(back.y, point.y, 1e-8);
    }
  }
}

TEST(TagPoseTest, IsExactOnExactCorners) {
  const View view = view_from_above(0.05);
  for (const Pose tag : {Pose{1.1, 0.2, 0.3}, Pose{-0.7, -0.9, -3.0}, Pose{0, 0, 1.5}}) {
    const TagPose found = tag_pose(view, seen_corners(view, tag, 0.1, 0.2), 0.1, 0.2);
    EXPECT_NEAR(found.pose.x, tag.x, 1e-8);
    EXPECT_NEAR(found.pose.y, tag.y, 1e-8);
    EXPECT_NEAR(found.pose.theta, tag.theta, 1e-7);
    EXPECT_NEAR(found.scale, 1, 1e-7);
    EXPECT_LT(found.residual_m, 1e-7);
  }
}

/// A tag that is taken to lie on the floor moves outward by rho h / (H - h) (tracking facts,
/// section 4): what the height correction is for.
TEST(TagPoseTest, ShowsTheParallaxOfAWrongHeight) {
  const View view = view_from_above(0);
  const TagPose found = tag_pose(view, seen_corners(view, {1, 0, 0}, 0.1, 0.2), 0.1, 0);
  EXPECT_NEAR(found.pose.x, 1 + 0.2 / 2.5, 1e-6);
  EXPECT_NEAR(found.scale, 2.7 / 2.5, 1e-6);
}

TEST(TagPoseTest, TheScaleTellsAWrongEdge) {
  const View view = view_from_above(0);
  const TagPose found = tag_pose(view, seen_corners(view, {0.5, 0, 1}, 0.09, 0.2), 0.1, 0.2);
  EXPECT_NEAR(found.scale, 0.9, 1e-6);
  EXPECT_NEAR(found.residual_m, 0.1 * 0.1 / std::numbers::sqrt2, 1e-6);
}

TEST(TagOffsetTest, GoesThereAndBack) {
  const TagOffset offset{0.06, -0.04, 0.7};
  const Pose robot{0.3, -0.8, 3.0};
  const Pose back = robot_pose(tag_pose_of_robot(robot, offset), offset);
  EXPECT_NEAR(back.x, robot.x, 1e-15);
  EXPECT_NEAR(back.y, robot.y, 1e-15);
  EXPECT_NEAR(back.theta, robot.theta, 1e-15);
}

}  // namespace
}  // namespace swarmsmith
