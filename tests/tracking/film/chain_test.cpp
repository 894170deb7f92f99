#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/math.h"
#include "tests/support/film/commands.h"
#include "tests/support/film/schedule.h"
#include "tests/support/long_runs.h"
#include "tracking/detection/tag_search.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith::film {
namespace {

/// A filmed run with calibrations that are true, so that what is measured is detection, geometry
/// and motion alone.
struct Chain {
  LabWish lab;
  RunWish run;
  double rate_hz = 15;
  double before_s = 0.5;
};

Rig true_rig(const Lab& lab, const Shooting& shooting) {
  Rig rig;
  const LabCamera& camera = lab.cameras.front();
  CameraSetup setup;
  setup.name = camera.name;
  setup.model_file = "model";
  setup.place_file = "place";
  setup.exposure_s = shooting.exposure_s;
  setup.readout_s = shooting.readout_s;
  rig.cameras.push_back(setup);
  rig.models["model"].model = camera.view.camera;
  rig.places["place"].place = camera.view.place;
  for (const FilmedTag& tag : lab.references)
    rig.references.push_back({tag.tag, tag.pose, tag.edge_m});
  for (const LabRobot& robot : lab.robots) {
    rig.robots.push_back({robot.name, robot.tag, robot.edge_m, robot.height_m, robot.name});
    OffsetCalibration offset;
    offset.robot = robot.name;
    offset.tag = robot.tag;
    offset.edge_m = robot.edge_m;
    offset.height_m = robot.height_m;
    offset.offset = robot.offset;
    offset.has_yaw = true;
    rig.offsets[robot.name] = offset;
  }
  return rig;
}

/// How far the tracked cycles are from the simulator's.
struct Error {
  double rms_mm = 0;
  double max_mm = 0;
  double heading_rms_deg = 0;
  double found = 0;  ///< share of tags in frames
};

struct Tracked {
  RecordedRun truth;
  TrackedRun run;
  Error error;
};

Error error_of(const RecordedRun& truth, const TrackedRun& run) {
  Error error;
  double squares = 0;
  double turns = 0;
  const std::size_t count = truth.trajectory.poses.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Pose& is = run.trajectory.poses.at(i);
    const Pose& was = truth.trajectory.poses[i];
    const double mm = 1000 * std::hypot(is.x - was.x, is.y - was.y);
    squares += mm * mm;
    error.max_mm = std::max(error.max_mm, mm);
    turns += std::pow(wrap_angle(is.theta - was.theta) * 57.29577951, 2);
  }
  error.rms_mm = std::sqrt(squares / static_cast<double>(count));
  error.heading_rms_deg = std::sqrt(turns / static_cast<double>(count));
  return error;
}

Tracked tracked(const Chain& chain, const std::function<void(Rig&, TrackOptions&)>& change = {}) {
  Tracked result;
  result.truth = *record_run(chain.run, SWARMSMITH_TEST_DATA "/argos/argos-thesis-designs.csv");
  const Lab lab = lab_of(chain.lab.lab);
  const Shooting shooting = shooting_of(chain.lab, lab.cameras.front().view);
  Scene scene = empty_scene(lab);
  scene.arena = arena_of(result.truth.mission, result.truth.instance);
  for (std::size_t i = 0; i < result.truth.poses.size(); ++i)
    scene.robots.push_back(filmed(lab.robots[i], Path(result.truth.poses[i])));
  const VirtualCamera camera(scene, shooting, 1);
  Schedule schedule;
  schedule.from_s = -chain.before_s;
  schedule.until_s = result.truth.mission.cycles * 0.1 + 0.4;
  schedule.rate_hz = chain.rate_hz;
  schedule.clock_ahead_s = chain.before_s;

  TagSearchOptions search;
  for (const LabRobot& robot : lab.robots)
    search.expected.insert(robot.tag);
  for (const FilmedTag& tag : lab.references)
    search.expected.insert(tag.tag);
  TagSearch finder(*TagDetector::of_family("tag36h11"), search);
  Observations seen;
  CameraRecord record;
  record.camera = lab.cameras.front().name;
  record.size = lab.size;
  const auto frames = frames_of(schedule, Rng(1));
  const std::set<int> robots{1, 2, 3};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const ColorImage image = camera.picture(frames[i].true_s, frames[i].picture);
    const std::vector<std::uint8_t> gray = gray_of(image);
    record.frame_times.push_back(frames[i].stamp_s);
    for (const Detection& found :
         finder.find(as_gray_image(gray, {image.width, image.height}), frames[i].stamp_s)) {
      if (!robots.contains(found.tag)) continue;
      double row = 0;
      for (const ImagePoint& corner : found.corners)
        row += corner.v / 4;
      seen.sightings.push_back({0, static_cast<std::int64_t>(i),
                                frames[i].stamp_s + row / image.height * shooting.readout_s,
                                found.tag, found.corners, found.hamming, found.margin});
    }
  }
  record.frames = static_cast<std::int64_t>(frames.size());
  seen.cameras.push_back(record);

  Rig rig = true_rig(lab, shooting);
  TrackOptions options;
  options.span = {{chain.before_s}, result.truth.mission.cycles};
  if (change) change(rig, options);
  const auto run = track_run(seen, rig, result.truth.mission.arena, options);
  if (!run) throw std::runtime_error(to_string(run.error()));
  result.run = *run;
  result.error = error_of(result.truth, result.run);
  result.error.found =
      static_cast<double>(seen.sightings.size()) / (3.0 * static_cast<double>(frames.size()));
  std::printf("centre rms %.2f max %.2f mm, heading rms %.2f deg, found %.2f %%\n",
              result.error.rms_mm, result.error.max_mm, result.error.heading_rms_deg,
              100 * result.error.found);
  return result;
}

Chain short_run(const std::string& mission, const std::string& machine) {
  Chain chain;
  chain.run.mission = mission;
  chain.run.machine = machine;
  chain.run.seed = 7;
  chain.run.seconds = times(3, 8);
  return chain;
}

void expect_accurate(const Error& error, double rms_mm) {
  EXPECT_LE(error.rms_mm, rms_mm);
  EXPECT_LE(error.max_mm, 2.5 * rms_mm);
  EXPECT_LE(error.heading_rms_deg, 0.5);
  EXPECT_GE(error.found, 0.99);
}

TEST(ChainTest, TypicalFramesAreWithinTheTargets) {
  expect_accurate(tracked(short_run("grid_exploration", "tG5")).error, 2);
}

TEST(ChainTest, PseudoRealityIsToo) {
  Chain chain = short_run("aggregation", "tA4");
  chain.run.profile = "pseudo-reality";
  expect_accurate(tracked(chain).error, 2);
}

TEST(ChainTest, RowsOfARollingShutterAreTakenAtTheirTime) {
  Chain chain = short_run("grid_exploration", "tG5");
  chain.lab.readout_s = 0.030;
  chain.lab.exposure_s = 0.008;
  expect_accurate(tracked(chain).error, 2);
}

TEST(ChainTest, DarkAndNoisy) {
  Chain chain = short_run("color_selection", "tC1");
  chain.lab.gain = 0.5;
  chain.lab.noise = 4;
  expect_accurate(tracked(chain).error, 2);
}

TEST(ChainTest, WithoutHeightAndOffsetTheErrorOfTheThesisAppears) {
  const Chain chain = short_run("grid_exploration", "tG5");
  const auto no_height = tracked(chain, [](Rig&, TrackOptions& options) {
    options.corrects_height = false;
    options.limits.scale_tolerance = 1;
    options.limits.residual_m = 1;
  });
  EXPECT_GT(no_height.error.rms_mm, 25);
  const auto no_offset = tracked(chain, [](Rig& rig, TrackOptions& options) {
    rig.offsets.clear();
    options.takes_tags_for_centres = true;
  });
  EXPECT_GT(no_offset.error.rms_mm, 40);
}

}  // namespace
}  // namespace swarmsmith::film
