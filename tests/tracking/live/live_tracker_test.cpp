#include "tracking/live/live_tracker.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/checks.h"
#include "tests/support/film/virtual_camera.h"
#include "tests/support/overhead_camera.h"

namespace swarmsmith {
namespace {

constexpr ImageSize kSize{960, 540};
constexpr TagOffset kOffset{0.03, -0.05, 0.14};

View view_from_above() {
  return {{kSize, Lens::Pinhole, 560, 560, 479.5, 269.5, {-0.285, 0.08, 0.0005, -0.0003, 0}},
          film::looking_at({0.12, -0.08, 2.7}, {0, 0})};
}

/// A robot that drives along x at 0.3 m/s and one that is covered from 1 s on, over two floor tags.
film::Scene scene() {
  film::Scene scene;
  scene.arena = built_in_mission("aggregation").value().arena;
  scene.tags = {{100, {0.6, 0.8, 0}}, {101, {-0.6, 0.8, 0}}};
  std::vector<Pose> drive;
  for (int i = 0; i <= 40; ++i)
    drive.push_back({-0.6 + 0.03 * i, 0.1, 0});
  film::FilmedRobot first;
  first.tag = 1;
  first.offset = kOffset;
  first.path = film::Path(drive);
  film::FilmedRobot second = first;
  second.tag = 2;
  second.path = film::Path({{0.3, -0.5, 2}});
  scene.robots = {first, second};
  scene.arms = {{{1.2, -0.9}, {0.2, -0.45}, 0.2, 0.5, 1.0, 10}};
  return scene;
}

Rig rig() {
  Rig rig;
  rig.cameras = {{"ceiling", "c.camera.toml", "c.place.toml", StampedAt::Middle, 0, 0}};
  rig.references = {{100, {0.6, 0.8, 0}, 0.1}, {101, {-0.6, 0.8, 0}, 0.1}};
  rig.robots = {{"rvr1", 1, 0.1, 0.2, "rvr1.offset.toml"},
                {"rvr2", 2, 0.1, 0.2, "rvr2.offset.toml"}};
  rig.models["c.camera.toml"].model = view_from_above().camera;
  rig.places["c.place.toml"].place = view_from_above().place;
  rig.offsets["rvr1.offset.toml"].offset = kOffset;
  rig.offsets["rvr2.offset.toml"].offset = kOffset;
  return rig;
}

/// States of so many frames, 10 a second.
std::vector<LiveState> states(const Rig& of, int frames, film::Scene filmed = scene()) {
  film::Shooting shooting;
  shooting.view = view_from_above();
  static const auto lens =
      std::make_shared<const film::LensMap>(film::lens_map_of(shooting.view.camera));
  const film::VirtualCamera camera(std::move(filmed), shooting, lens, 3);
  LiveTracker tracker = LiveTracker::of(of, of.cameras.at(0), camera.scene().arena).value();
  std::vector<LiveState> all;
  for (int i = 0; i < frames; ++i) {
    const std::vector<std::uint8_t> gray = film::gray_of(camera.picture(0.1 * i, i));
    all.push_back(tracker.look_at(film::as_gray_image(gray, kSize), i, 0.1 * i));
  }
  return all;
}

TEST(LiveTrackerTest, RobotsAreWhereTheyAre) {
  const std::vector<LiveState> all = states(rig(), 24);
  for (int i = 0; i < 24; ++i) {
    const LiveRobot& robot = all[static_cast<std::size_t>(i)].robots[0];
    ASSERT_TRUE(robot.is_seen) << i;
    EXPECT_NEAR(robot.pose->x, -0.6 + 0.03 * i, 0.003);
    EXPECT_NEAR(robot.pose->y, 0.1, 0.003);
    EXPECT_NEAR(robot.pose->theta, 0, 0.02);
  }
  EXPECT_NEAR(all[20].frames_per_s, 10, 1e-9);
  EXPECT_EQ(all[20].references_seen, 2);
  EXPECT_EQ(all[20].robots[0].trail.size(), 21U);
}

TEST(LiveTrackerTest, SaysForHowLongARobotIsNotSeen) {
  const std::vector<LiveState> all = states(rig(), 18);
  EXPECT_TRUE(all[5].issues.empty()) << all[5].issues.front();
  EXPECT_FALSE(all[17].robots[1].is_seen);
  EXPECT_NEAR(all[17].robots[1].pose->x, 0.3, 0.003) << "the last known place";
  EXPECT_THAT(all[17].issues, Contains("rvr2 (tag 2) has not been seen for 0.8 s"));
}

TEST(LiveTrackerTest, SeesThatTheCameraMoved) {
  Rig calibrated = rig();
  PlaceCalibration& place = calibrated.places["c.place.toml"];
  for (const ReferenceTag& tag : calibrated.references)
    place.tags.push_back({tag, seen_corners(view_from_above(), tag.pose, tag.edge_m, 0), 0, 0});
  const LiveState still = states(calibrated, 6).back();
  ASSERT_TRUE(still.camera_shift_px.has_value());
  EXPECT_LT(*still.camera_shift_px, 0.3);
  EXPECT_TRUE(still.issues.empty()) << still.issues.front();
  for (PlaceCalibration::Seen& seen : place.tags) {
    for (ImagePoint& corner : seen.corners)
      corner.u -= 3;
  }
  const LiveState moved = states(calibrated, 6).back();
  EXPECT_NEAR(moved.camera_shift_px.value(), 3, 0.3);
  EXPECT_THAT(moved.issues, Contains(HasSubstr("the camera moved: its floor tags are 3.")));
  EXPECT_THAT(live_state_json(moved), HasSubstr("\"camera_shift_px\":3."));
}

TEST(LiveTrackerTest, SaysWhatIsWrong) {
  Rig wrong = rig();
  wrong.robots.push_back({"rvr3", 3, 0.1, 0.2, ""});
  wrong.robots[0].edge_m = 0.09;
  wrong.offsets.erase("rvr2.offset.toml");
  film::Scene filmed = scene();
  filmed.tags.push_back({100, {0, 0.9, 0}});
  filmed.tags.push_back({33, {-0.9, -0.2, 0}});
  const LiveState state = states(wrong, 1, filmed).front();
  EXPECT_THAT(state.issues, Contains("rvr3 (tag 3) has not been seen yet"));
  EXPECT_THAT(state.issues, Contains(HasSubstr("rvr1 (tag 1): the tag looks 11 % too large")));
  EXPECT_THAT(state.issues, Contains(HasSubstr("rvr2 (tag 2) has no offset calibration")));
  EXPECT_THAT(state.issues, Contains("tag 100 is visible more than once"));
  EXPECT_THAT(state.issues, Contains("tag 33 does not belong to a robot"));
  EXPECT_THAT(state.issues, Not(Contains(HasSubstr("outside"))));
}

TEST(LiveTrackerTest, ACameraWithoutCalibrationShowsTags) {
  Rig bare = rig();
  bare.places.clear();
  const LiveState state = states(bare, 1).front();
  EXPECT_EQ(state.tags.size(), 4U);
  EXPECT_FALSE(state.robots[0].pose.has_value());
  EXPECT_TRUE(state.robots[0].is_seen);
  EXPECT_THAT(state.issues, Contains("camera ceiling is not calibrated: only tags are shown"));
  Rig other = rig();
  other.models["c.camera.toml"].model.size = {1280, 720};
  EXPECT_THAT(states(other, 1).front().issues, Contains(HasSubstr("is for 1280 x 720 pixels")));
}

TEST(LiveStateTest, IsJsonAndALine) {
  LiveState state;
  state.time_s = 12.43;
  state.frames_per_s = 29.97;
  state.delay_s = 0.0081;
  state.most_delay_s = 0.0142;
  state.dropped = 2;
  state.robots = {{"rvr \"1\"", 1, 0.2, Pose{0.5, -0.25, 1}, 12.43, true, {}},
                  {"bad\xff", 2, 0.2, {}, {}, false, {}}};
  state.issues = {"bad (tag 2) has not been seen yet", "tag 33 does not belong to a robot"};
  const auto json = nlohmann::json::parse(live_state_json(state));
  EXPECT_EQ(json["robots"][0]["name"], "rvr \"1\"");
  EXPECT_EQ(json["robots"][0]["x"], 0.5);
  EXPECT_FALSE(json["robots"][1].contains("x"));
  EXPECT_TRUE(json["robots"][1]["last_seen_s"].is_null());
  EXPECT_EQ(json["issues"].size(), 2U);
  EXPECT_EQ(live_state_line(state),
            "12.4 s, 30.0 frames/s, delay 8 ms (at most 14), robots 1 of 2, dropped 2; bad (tag 2) "
            "has not been seen yet and 1 more");
}

}  // namespace
}  // namespace swarmsmith
