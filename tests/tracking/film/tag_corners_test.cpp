#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tracking/film/library_detector.h"
#include "tests/tracking/film/small_scene.h"

namespace swarmsmith::film {
namespace {

/// Differences of found corners from true ones, pixels.
struct Differences {
  double u = 0;
  double v = 0;
  double squares = 0;
  int count = 0;

  void add(const TagCorners& found, const TagCorners& truth) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double du = found[i].u - truth[i].u;
      const double dv = found[i].v - truth[i].v;
      u += du;
      v += dv;
      squares += du * du + dv * dv;
      ++count;
    }
  }
  double mean_u() const { return u / count; }
  double mean_v() const { return v / count; }
  double rms() const { return std::sqrt(squares / count); }
};

/// Twelve robots with all headings, spread over the arena.
Scene twelve_robots() {
  Scene scene;
  scene.arena = dodecagon_of_the_thesis();
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    const double radius = i % 2 == 0 ? 0.9 : 0.45;
    scene.robots.push_back(
        robot_at(i + 1, {radius * std::cos(angle), radius * std::sin(angle), angle * 5 + 0.13}));
  }
  return scene;
}

TEST(TagCornersTest, LibraryFindsThemWhereTheTruthIs) {
  for (const double blur : {0.5, 0.8}) {
    Shooting shooting = shooting_of(1280);
    shooting.blur_px = blur;
    const VirtualCamera camera(twelve_robots(), shooting, 3);
    Differences differences;
    for (int frame = 0; frame < 2; ++frame) {
      const ColorImage image = camera.picture(0, frame);
      const std::vector<std::uint8_t> gray = gray_of(image);
      const auto found = found_by_library(as_gray_image(gray, {image.width, image.height}));
      ASSERT_EQ(found.size(), 12U);
      for (std::size_t i = 0; i < 12; ++i)
        differences.add(found.at(static_cast<int>(i) + 1), camera.corners_of_robot(i, 0));
    }
    // Half a pixel of bias, or a corner that is another, would stand out.
    EXPECT_NEAR(differences.mean_u(), 0, 0.05);
    EXPECT_NEAR(differences.mean_v(), 0, 0.05);
    EXPECT_LT(differences.rms(), 0.2);
    RecordProperty("rms_px", std::to_string(differences.rms()));
    std::printf("blur %.1f: mean %.3f %.3f rms %.3f px\n", blur, differences.mean_u(),
                differences.mean_v(), differences.rms());
  }
}

}  // namespace
}  // namespace swarmsmith::film
