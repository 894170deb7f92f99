#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

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
    scene.robots.back().path =
        Path({{0.4 * i - 0.5, 0.2, 0.5 * i}, {0.4 * i - 0.46, 0.23, 0.5 * i + 0.05}});
  }
  return scene;
}

TEST(VirtualCameraTest, SameSeedSamePixels) {
  const VirtualCamera one(three_robots(), shooting_of(480), 7);
  const VirtualCamera two(three_robots(), shooting_of(480), 7);
  const VirtualCamera other(three_robots(), shooting_of(480), 8);
  EXPECT_EQ(one.picture(0.05, 3).bgr, two.picture(0.05, 3).bgr);
  EXPECT_NE(one.picture(0.05, 3).bgr, other.picture(0.05, 3).bgr);
  EXPECT_NE(one.picture(0.05, 3).bgr, one.picture(0.05, 4).bgr);
  if (const char* file = std::getenv("FILM_SHOW")) {
    Shooting shooting = shooting_of(960);
    Scene scene = three_robots();
    scene.arms.push_back({{1.6, -0.9}, {0.35, 0.2}, 0.06, 0.35, 0, 1});
    const VirtualCamera camera(scene, shooting, 7);
    const auto start = std::chrono::steady_clock::now();
    ColorImage image;
    for (int i = 0; i < 50; ++i)
      image = camera.picture(0.002 * i, i);
    std::printf("%.2f ms a frame\n",
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                        .count() /
                    50);
    cv::imwrite(file, cv::Mat(image.height, image.width, CV_8UC3, image.bgr.data()));
  }
}

}  // namespace
}  // namespace swarmsmith::film
