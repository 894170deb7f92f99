#include <gtest/gtest.h>

#include <cmath>

#include "tests/tracking/film/library_detector.h"
#include "tests/tracking/film/small_scene.h"

namespace swarmsmith::film {
namespace {

Scene three_robots() {
  Scene scene;
  scene.arena = dodecagon_of_the_thesis();
  scene.arena.patches.push_back({Disc{{0, 0.5}, 0.5}, {0, 0, 0}});
  for (int i = 0; i < 6; ++i) {
    const double angle = i * 1.0472;
    scene.tags.push_back({100 + i, {1.08 * std::cos(angle), 1.08 * std::sin(angle), 0.3 * i}});
  }
  for (int i = 0; i < 3; ++i) {
    scene.robots.push_back(robot_at(i + 1, {}));
    // 0.4 m/s and 2 rad/s.
    scene.robots.back().path =
        Path({{0.5 * i - 0.6, 0.2, 0.5 * i}, {0.5 * i - 0.6, 0.16, 0.5 * i + 0.2}});
  }
  return scene;
}

double mean_of(const ColorImage& image) {
  double sum = 0;
  const std::vector<std::uint8_t> gray = gray_of(image);
  for (const std::uint8_t value : gray)
    sum += value;
  return sum / static_cast<double>(gray.size());
}

/// How far the corners of the robots' tags, as the library finds them, are from what `camera` says;
/// root mean square, pixels.
double corner_error(const VirtualCamera& camera, double time_s) {
  const ColorImage image = camera.picture(time_s, 0);
  const std::vector<std::uint8_t> gray = gray_of(image);
  const auto found = found_by_library(as_gray_image(gray, {image.width, image.height}));
  double squares = 0;
  for (std::size_t robot = 0; robot < camera.scene().robots.size(); ++robot) {
    const TagCorners& corners = found.at(camera.scene().robots[robot].tag);
    const TagCorners truth = camera.corners_of_robot(robot, time_s);
    for (std::size_t i = 0; i < 4; ++i) {
      squares += std::pow(corners[i].u - truth[i].u, 2) + std::pow(corners[i].v - truth[i].v, 2);
    }
  }
  return std::sqrt(squares / (4.0 * static_cast<double>(camera.scene().robots.size())));
}

TEST(VirtualCameraTest, SameSeedSamePixels) {
  const VirtualCamera one(three_robots(), shooting_of(480), 7);
  const VirtualCamera two(three_robots(), shooting_of(480), 7);
  const VirtualCamera other(three_robots(), shooting_of(480), 8);
  EXPECT_EQ(one.picture(0.05, 3).bgr, two.picture(0.05, 3).bgr);
  EXPECT_NE(one.picture(0.05, 3).bgr, other.picture(0.05, 3).bgr);
  EXPECT_NE(one.picture(0.05, 3).bgr, one.picture(0.05, 4).bgr);
}

TEST(VirtualCameraTest, WindowsLeaveNoSeams) {
  // Where a window was painted anew, what does not move has the pixels of the backdrop.
  Shooting shooting = shooting_of(480);
  shooting.noise = 0;
  Scene scene = three_robots();
  const ColorImage before = VirtualCamera(scene, shooting, 1).picture(0, 0);
  scene.arms.push_back({{0.2, -0.6}, {0.3, -0.5}, 0.05, 0.35, 5, 6});
  const VirtualCamera camera(scene, shooting, 1);
  EXPECT_EQ(camera.picture(0, 0).bgr, before.bgr);
  EXPECT_NE(camera.picture(5.5, 0).bgr, camera.picture(6.5, 0).bgr);
  scene.robots.clear();
  const ColorImage empty = VirtualCamera(scene, shooting, 1).picture(0, 0);
  int changed = 0;
  for (std::size_t i = 0; i < empty.bgr.size(); i += 3)
    changed += empty.bgr[i] == before.bgr[i] ? 0 : 1;
  // Three robots of about 26 x 26 pixels.
  EXPECT_GT(changed, 3 * 400);
  EXPECT_LT(changed, 3 * 1500);
}

TEST(VirtualCameraTest, RowsOfARollingShutterAreAtTheirTime) {
  Shooting shooting = shooting_of(1280);
  shooting.exposure_s = 0.004;
  shooting.readout_s = 0.030;
  const VirtualCamera rolling(three_robots(), shooting, 1);
  EXPECT_LT(corner_error(rolling, 0.04), 0.2);
  // All at the first row's time would be some pixels off: 0.4 m/s over half the readout.
  const TagCorners at_row = rolling.corners_of_robot(1, 0.04);
  shooting.readout_s = 0;
  const VirtualCamera global(three_robots(), shooting, 1);
  EXPECT_LT(corner_error(global, 0.04), 0.2);
  const TagCorners at_once = global.corners_of_robot(1, 0.04);
  EXPECT_GT(std::hypot(at_row[0].u - at_once[0].u, at_row[0].v - at_once[0].v), 1.0);
}

TEST(VirtualCameraTest, TheBumpedCameraSeesTheFloorElsewhere) {
  Shooting shooting = shooting_of(1280);
  shooting.bump_s = 1;
  shooting.bumped = looking_at({0.104, -0.123, 2.7}, {0.03, 0.01}, 0.02);
  const VirtualCamera camera(three_robots(), shooting, 1);
  EXPECT_LT(corner_error(camera, 0.5), 0.2);
  EXPECT_LT(corner_error(camera, 1.5), 0.2);
  const TagCorners before = camera.corners_of_robot(0, 0.99);
  const TagCorners after = camera.corners_of_robot(0, 1.01);
  EXPECT_GT(std::hypot(before[0].u - after[0].u, before[0].v - after[0].v), 2.0);
}

TEST(VirtualCameraTest, LightAndNoiseAreAsAskedFor) {
  Shooting shooting = shooting_of(480);
  shooting.noise = 0;
  const ColorImage bright = VirtualCamera(three_robots(), shooting, 1).picture(0, 0);
  shooting.gain = 0.5;
  const ColorImage dark = VirtualCamera(three_robots(), shooting, 1).picture(0, 0);
  EXPECT_NEAR(mean_of(dark) / mean_of(bright), 0.5, 0.01);
  shooting.noise = 4;
  const std::vector<std::uint8_t> noisy =
      gray_of(VirtualCamera(three_robots(), shooting, 1).picture(0, 0));
  const std::vector<std::uint8_t> clean = gray_of(dark);
  double squares = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i)
    squares += std::pow(static_cast<double>(noisy[i]) - static_cast<double>(clean[i]), 2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(noisy.size())), 4, 0.2);
}

TEST(VirtualCameraTest, SwappedTagsAreCarriedByTheOther) {
  Scene scene = three_robots();
  scene.robots[0].swap_s = 1;
  scene.robots[0].other_tag = 2;
  scene.robots[1].swap_s = 1;
  scene.robots[1].other_tag = 1;
  const VirtualCamera camera(scene, shooting_of(1280), 1);
  const ColorImage image = camera.picture(2, 0);
  const std::vector<std::uint8_t> gray = gray_of(image);
  const auto found = found_by_library(as_gray_image(gray, {image.width, image.height}));
  EXPECT_NEAR(found.at(2)[0].u, camera.corners_of_robot(0, 2)[0].u, 0.5);
  EXPECT_NEAR(found.at(1)[0].u, camera.corners_of_robot(1, 2)[0].u, 0.5);
}

}  // namespace
}  // namespace swarmsmith::film
