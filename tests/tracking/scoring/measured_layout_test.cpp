#include "tracking/scoring/measured_layout.h"

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/film/virtual_camera.h"
#include "tracking/scoring/internal/floor_light.h"
#include "tracking/scoring/run_patches.h"

namespace swarmsmith {
namespace {

/// How a floor is lit and its colours printed.
struct Light {
  std::array<double, 3> cast{1, 1, 1};  ///< of the lamps and the camera's white balance
  double vignetting = 0;                ///< dark of the image's corners
  double gradient = 0;                  ///< right edge minus left edge
  double noise = 0;
  double saturation = 1;  ///< of the paints
};

View small_view() {
  return {{{480, 270}, Lens::Pinhole, 254, 254, 239.5, 134.5, {-0.25, 0.06, 0, 0, 0}},
          film::looking_at({0.05, -0.1, 2.7}, {0, 0})};
}

std::uint8_t as_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// The floor as a camera sees it under a light; the clean picture comes from the virtual camera.
ColorImage under_light(ColorImage image, const Light& light, std::uint64_t seed) {
  Rng rng(seed);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const double x = (u - 0.5 * image.width) / image.width;
      const double y = (v - 0.5 * image.height) / image.width;
      const double bright = (1 - light.vignetting * 4 * (x * x + y * y)) * (1 + light.gradient * x);
      std::uint8_t* const bgr =
          &image.bgr[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(u))];
      const double gray = (bgr[0] + bgr[1] + bgr[2]) / 3.0;
      for (int c = 0; c < 3; ++c) {
        const double printed = gray + light.saturation * (bgr[c] - gray);
        const double lit = printed * bright * light.cast.at(static_cast<std::size_t>(2 - c));
        bgr[c] = as_byte(lit + light.noise * rng.normal());
      }
    }
  }
  return image;
}

class MeasuredLayoutTest : public testing::Test {
 protected:
  Mission mission = built_in_mission("color_selection").value();
  Instance instance = instance_of(mission, 11).value();

  film::Scene scene() const {
    film::Scene scene;
    scene.arena = arena_of(mission, instance);
    return scene;
  }

  FloorPicture picture_of(const film::Scene& scene, const Light& light,
                          std::vector<Point> robots = {}, double time_s = 0) const {
    film::Shooting shooting;
    shooting.view = small_view();
    shooting.noise = 0;
    const film::VirtualCamera camera(scene, shooting, 3);
    return {shooting.view, under_light(camera.picture(time_s, 0), light, 5), std::move(robots)};
  }

  Expected<MeasuredLayout> measured(const Light& light) const {
    const std::vector<FloorPicture> pictures{picture_of(scene(), light)};
    return measure_layout(pictures, mission);
  }

  /// In the order of the mission's places.
  std::vector<Patch> laid() const {
    std::vector<Patch> patches;
    for (const Rectangle& place : mission.shuffled.places) {
      for (const Patch& patch : instance.patches) {
        if (std::get<Rectangle>(patch.shape) == place) patches.push_back(patch);
      }
    }
    return patches;
  }
};

TEST_F(MeasuredLayoutTest, TellsThePatchesUnderAllLights) {
  const std::vector<Light> lights{
      {},
      {.cast = {1.5, 1, 0.6}},                                   // warm lamps
      {.cast = {0.65, 1, 1.4}, .gradient = 0.5},                 // a window on the right
      {.cast = {1.2, 1, 0.8}, .vignetting = 0.6, .noise = 6},    // a cheap lens
      {.cast = {0.12, 0.12, 0.12}, .noise = 2},                  // dusk: floor at 15 of 255
      {.cast = {1.9, 1.9, 1.9}},                                 // floor at 241: all paints clip
      {.cast = {1.1, 1, 0.9}, .noise = 3, .saturation = 0.35}};  // pale paints
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto layout = measured(lights[i]);
    ASSERT_TRUE(layout) << i << ": " << to_string(layout.error());
    EXPECT_EQ(layout->patches(mission.arena), laid()) << i;
    for (const MeasuredPatch& patch : layout->places)
      EXPECT_GT(patch.confidence, 0.5) << i;
  }
}

TEST_F(MeasuredLayoutTest, GivesPatchesThatARunCanBeScoredWith) {
  const std::vector<Patch> patches = measured({})->patches(mission.arena);
  EXPECT_TRUE(run_patches(mission, patches));
}

TEST_F(MeasuredLayoutTest, RefusesWhatItCannotSee) {
  EXPECT_THAT(measured({.cast = {0.02, 0.02, 0.02}}).error().message,
              HasSubstr("E_LAYOUT_MISSING: the pictures are too dark"));
  EXPECT_THAT(measured({.cast = {3, 3, 3}}).error().message, HasSubstr("overexposed"));
  const Error gray = why_not(measured({.saturation = 0.02}));
  EXPECT_THAT(gray.message, HasSubstr("E_LAYOUT_MISSING: the patch at (0.75, -0.25)"));
  EXPECT_THAT(gray.message, HasSubstr("of the floor around it"));
}

TEST_F(MeasuredLayoutTest, RefusesColoursThatAreNotTheMissions) {
  instance.patches[2].color = {0, 0, 255};
  EXPECT_THAT(complaint_of(measured({})), HasSubstr("cannot be measured"));
  instance.patches[2].color = instance.patches.back().color;
  EXPECT_THAT(complaint_of(measured({})),
              HasSubstr("patches were seen as 3 green, 4 red, 5 yellow, and the mission has 4 "
                        "green, 4 red, 4 yellow"));
}

TEST_F(MeasuredLayoutTest, TellsBarePlacesWhereTheMissionHasThem) {
  mission.shuffled.shares[1].count = 2;
  instance = instance_of(mission, 11).value();
  const auto layout = value_of(measured({.cast = {1.3, 1, 0.8}}));
  EXPECT_EQ(layout.patches(mission.arena), laid());
  EXPECT_EQ(layout.patches(mission.arena).size(), 10U);
}

/// A robot that stopped on a patch leaves a corner of it, or nothing; never another colour.
TEST_F(MeasuredLayoutTest, LooksBesideARobot) {
  const Point on = centre_of(laid()[6]);
  int told = 0;
  for (const double aside : {0.0, 0.03, 0.06, 0.09}) {
    film::Scene crowded = scene();
    const Pose robot{on.x - aside, on.y + 0.7 * aside, 0.2 + 10 * aside};
    crowded.robots.push_back({.tag = 1, .offset = {0.05, 0, 0}, .path = film::Path({robot})});
    const std::vector<FloorPicture> pictures{picture_of(crowded, {.noise = 2}, {robot.position()})};
    const auto layout = measure_layout(pictures, mission);
    if (!layout) continue;
    EXPECT_EQ(layout->patches(mission.arena), laid());
    ++told;
  }
  EXPECT_GE(told, 2);
}

/// Two robots hide a patch; in another picture they are elsewhere.
TEST_F(MeasuredLayoutTest, LooksBesideRobots) {
  film::Scene crowded = scene();
  const Point on = centre_of(laid()[3]);
  std::vector<Point> before;
  std::vector<Point> after;
  for (const double side : {-0.09, 0.09}) {
    const std::vector<Pose> way{{on.x + side, on.y, 0.4}, {-0.02 + 2 * side, 0.03, 1}};
    crowded.robots.push_back({.tag = 1, .path = film::Path(way, 0, 10)});
    before.push_back(way[0].position());
    after.push_back(way[1].position());
  }
  const FloorPicture hidden = picture_of(crowded, {.noise = 2}, before, 0);
  const std::vector<FloorPicture> one{hidden};
  EXPECT_THAT(complaint_of(measure_layout(one, mission)), HasSubstr("always hidden by a robot"));
  const std::vector<FloorPicture> two{hidden, picture_of(crowded, {.noise = 2}, after, 10)};
  const auto layout = value_of(measure_layout(two, mission));
  EXPECT_EQ(layout.patches(mission.arena), laid());
  EXPECT_EQ(layout.places[3].pictures, 1);
}

/// The light is that of bare floor, however much around a place is painted.
TEST_F(MeasuredLayoutTest, TakesNoLightFromAPaintedFloor) {
  const Rectangle place = mission.shuffled.places[5];
  const FloorPicture bare = picture_of(scene(), {});
  const auto plain = value_of(FloorLight(bare, mission).ratio_of(place));
  mission.arena.patches.push_back({Rectangle{place.centre, 0.8, 0.8}, {255, 0, 0}});
  const FloorPicture painted = picture_of(scene(), {});
  const auto beside_paint = value_of(FloorLight(painted, mission).ratio_of(place));
  for (std::size_t channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(beside_paint.at(channel), plain.at(channel), 0.05) << channel;
}

/// A robot's shadow ends 0.242 m behind its middle, seen from 2.7 m above.
TEST_F(MeasuredLayoutTest, TakesALookJustBeyondTheShadowOfARobot) {
  const Point robot{0.75, -0.1};  // 0.7 m from the camera's foot, along x
  const FloorPicture picture = picture_of(scene(), {}, {robot});
  const FloorLight light(picture, mission);
  const auto is_seen = [&](double behind_m) {
    return light.ratio_of({{robot.x + behind_m, robot.y}, 0.05, 0.05}).has_value();
  };
  EXPECT_FALSE(is_seen(0));
  EXPECT_FALSE(is_seen(0.235));
  EXPECT_TRUE(is_seen(0.25));
  EXPECT_TRUE(is_seen(-0.2)) << "it hides nothing before it but its own width";
}

TEST_F(MeasuredLayoutTest, IsNothingForAFixedFloor) {
  const Mission spot = built_in_mission("aggregation").value();
  EXPECT_EQ(measure_layout({}, spot).error().kind, ErrorKind::BadInput);
  EXPECT_THAT(measure_layout({}, mission).error().message, HasSubstr("there is no picture"));
}

TEST_F(MeasuredLayoutTest, SaysWhichPlaceIsNotInThePicture) {
  FloorPicture picture = picture_of(scene(), {});
  // Only the left part of what was seen.
  ColorImage& image = picture.image;
  const int kept = 280;
  ColorImage cut{kept, image.height, {}};
  for (int v = 0; v < image.height; ++v) {
    const auto row = image.bgr.begin() + static_cast<std::ptrdiff_t>(3) * v * image.width;
    cut.bgr.insert(cut.bgr.end(), row, row + static_cast<std::ptrdiff_t>(3) * kept);
  }
  image = cut;
  const std::vector<FloorPicture> pictures{picture};
  EXPECT_THAT(measure_layout(pictures, mission).error().message,
              HasSubstr("the patch at (0.75, -0.25) cannot be measured: it is in no picture"));
}

}  // namespace
}  // namespace swarmsmith
