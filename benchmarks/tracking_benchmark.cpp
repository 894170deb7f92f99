// CPU time to search for tags in a frame of 1080p, compared with the plain detector on the whole
// frame, on pictures of the tests' virtual camera; and the share of tags that is found.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "sim/mission/mission.h"
#include "tests/support/film/virtual_camera.h"
#include "tests/support/temporary_folder.h"
#include "tracking/detection/tag_search.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

constexpr double kFrame_s = 1.0 / 60;
constexpr int kPictures = 30;

/// The lens with which the tracking facts were measured, at a height of 2.7 m, tilted by about 3
/// degrees.
View ceiling_view() {
  const CameraModel lens{
      {1920, 1080}, Lens::Pinhole, 1015, 1015, 959.5, 539.5, {-0.285, 0.08, 0.0005, -0.0003, 0}};
  return {lens, film::looking_at({0.12, -0.08, 2.7}, {0, 0})};
}

film::Scene scene_of(int robots) {
  film::Scene scene;
  scene.arena = built_in_mission("aggregation").value().arena;
  for (int i = 0; i < 6; ++i) {
    const double angle = (15 + 60 * i) * std::numbers::pi / 180;
    scene.tags.push_back({100 + i, {1.08 * std::cos(angle), 1.08 * std::sin(angle), 0}});
  }
  // In rows of five; all drive in circles in step at 0.3 m/s, so that no tag is ever covered.
  constexpr double kApart_m = 0.42;
  constexpr double kRadius_m = 0.12;
  constexpr double kTurn_rad_s = 0.3 / kRadius_m;
  const int columns = std::min(robots, 5);
  const int rows = (robots + columns - 1) / columns;
  for (int i = 0; i < robots; ++i) {
    const double x = kApart_m * (i % columns - (columns - 1) / 2.0);
    const double y = kApart_m * (i / columns - (rows - 1) / 2.0);
    std::vector<Pose> poses;
    for (int step = 0; step <= 10; ++step) {
      const double turned = kTurn_rad_s * 0.1 * step;
      poses.push_back(
          {x + kRadius_m * std::cos(turned), y + kRadius_m * std::sin(turned), turned + i});
    }
    film::FilmedRobot robot;
    robot.tag = i + 1;
    robot.path = film::Path(poses);
    scene.robots.push_back(robot);
  }
  return scene;
}

/// Half a second of a run, with the true positions of the robots' tags.
struct Clip {
  ImageSize size;
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<std::vector<TagCorners>> truth;
};

Clip filmed(int robots, const film::Shooting& shooting) {
  const film::VirtualCamera camera(scene_of(robots), shooting, 7);
  Clip clip{shooting.view.camera.size, {}, {}};
  for (int i = 0; i < kPictures; ++i) {
    clip.pictures.push_back(film::gray_of(camera.picture(i * kFrame_s, i)));
    clip.truth.emplace_back();
    for (std::size_t robot = 0; robot < camera.scene().robots.size(); ++robot)
      clip.truth.back().push_back(camera.corners_of_robot(robot, i * kFrame_s));
  }
  return clip;
}

double cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Counts of visible and of found tags, and the errors of their corners.
struct Tally {
  double visible = 0;
  double found = 0;
  double corner_px = 0;
  double strays = 0;

  void add(const std::vector<Detection>& seen, const std::vector<TagCorners>& truth) {
    constexpr double kSamePlace_px = 5;
    visible += static_cast<double>(truth.size());
    for (const Detection& each : seen) {
      if (each.tag >= 100) continue;
      const auto robot = static_cast<std::size_t>(each.tag - 1);
      double worst_px = 2 * kSamePlace_px;
      if (robot < truth.size()) {
        worst_px = 0;
        for (std::size_t i = 0; i < 4; ++i)
          worst_px = std::max(worst_px, std::hypot(each.corners[i].u - truth[robot][i].u,
                                                   each.corners[i].v - truth[robot][i].v));
      }
      if (worst_px > kSamePlace_px) {
        ++strays;
        continue;
      }
      ++found;
      corner_px += worst_px;
    }
  }
};

/// Plays the clip forwards and backwards, one frame per iteration. Every tenth frame is also
/// searched as a whole at half size, and every thirtieth at full size, so that noise of the machine
/// affects all searches.
void search(benchmark::State& state, const film::Shooting& shooting) {
  const auto robots = static_cast<int>(state.range(0));
  const Clip clip = filmed(robots, shooting);
  TagSearchOptions options;
  for (int i = 1; i <= robots; ++i)
    options.expected.insert(i);
  for (int i = 100; i < 106; ++i) {
    options.expected.insert(i);
    options.still.insert(i);
  }
  TagSearch search(TagDetector::of_family("tag36h11").value(), options);
  TagDetector plain = TagDetector::of_family("tag36h11").value();
  Tally followed;
  Tally half;
  Tally full;
  double search_s = 0;
  double half_s = 0;
  double full_s = 0;
  int frames = 0;
  int halves = 0;
  int fulls = 0;
  for (auto _ : state) {
    const int turn = frames % (2 * kPictures - 2);
    const auto at = static_cast<std::size_t>(turn < kPictures ? turn : 2 * kPictures - 2 - turn);
    const GrayImage image = film::as_gray_image(clip.pictures[at], clip.size);
    double begin = cpu_s();
    const std::vector<Detection> seen = search.find(image, frames * kFrame_s);
    const double spent_s = cpu_s() - begin;
    state.SetIterationTime(spent_s);
    search_s += spent_s;
    followed.add(seen, clip.truth[at]);
    if (frames % 10 == 0) {
      begin = cpu_s();
      const std::vector<Detection> found = plain.find(image, 2);
      half_s += cpu_s() - begin;
      half.add(found, clip.truth[at]);
      ++halves;
    }
    if (frames % 30 == 0) {
      begin = cpu_s();
      const std::vector<Detection> found = plain.find(image, 1);
      full_s += cpu_s() - begin;
      full.add(found, clip.truth[at]);
      ++fulls;
    }
    ++frames;
  }
  state.counters["ms"] = 1000 * search_s / frames;
  state.counters["frames_per_s"] = frames / search_s;
  state.counters["ms_whole_2"] = 1000 * half_s / halves;
  state.counters["ms_whole_1"] = 1000 * full_s / fulls;
  state.counters["ratio_2"] = (search_s / frames) / (half_s / halves);
  state.counters["ratio_1"] = (search_s / frames) / (full_s / fulls);
  state.counters["wholes"] = static_cast<double>(search.full_searches());
  state.counters["found_pct"] = 100 * followed.found / followed.visible;
  state.counters["found_pct_2"] = 100 * half.found / half.visible;
  state.counters["found_pct_1"] = 100 * full.found / full.visible;
  state.counters["strays"] = followed.strays;
  state.counters["corner_px"] = followed.corner_px / followed.found;
}

film::Shooting typical() {
  film::Shooting shooting;
  shooting.view = ceiling_view();
  shooting.exposure_s = 0.004;
  return shooting;
}

film::Shooting dim() {
  film::Shooting shooting = typical();
  shooting.gain = 0.4;
  shooting.noise = 4;
  return shooting;
}

film::Shooting dark() {
  film::Shooting shooting = typical();
  shooting.gain = 0.2;
  shooting.noise = 4;
  return shooting;
}

film::Shooting out_of_focus() {
  film::Shooting shooting = typical();
  shooting.blur_px = 2.4;
  return shooting;
}

film::Shooting blurred() {
  film::Shooting shooting = typical();
  shooting.blur_px = 1.6;
  return shooting;
}

film::Shooting noisy() {
  film::Shooting shooting = typical();
  shooting.noise = 8;
  return shooting;
}

film::Shooting smeared() {
  film::Shooting shooting = typical();
  shooting.exposure_s = 0.016;
  return shooting;
}

/// Decodes half a second with 20 robots again and again; the codec's own threads count.
void decode(benchmark::State& state, const char* codec) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.mkv";
  const film::VirtualCamera camera(scene_of(20), typical(), 7);
  VideoOptions options;
  options.codec = codec;
  options.frame_rate = 1 / kFrame_s;
  VideoWriter writer = VideoWriter::open(file, {1920, 1080}, options).value();
  bool written = true;
  for (int i = 0; i < kPictures; ++i)
    written = writer.write(camera.picture(i * kFrame_s, i), i * kFrame_s).has_value() && written;
  if (!writer.finish().has_value() || !written) return state.SkipWithError("cannot write a video");
  double frames = 0;
  double spent_s = 0;
  for (auto _ : state) {
    const double begin = cpu_s();
    const auto source = FrameSource::open(file).value();
    while (source->next().value())
      benchmark::DoNotOptimize(source->frame().gray.pixels[0]);
    const double took_s = cpu_s() - begin;
    state.SetIterationTime(took_s);
    spent_s += took_s;
    frames += kPictures;
  }
  state.counters["ms"] = 1000 * spent_s / frames;
}
BENCHMARK_CAPTURE(decode, h264, "h264")
    ->Iterations(4)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(decode, mjpeg, "mjpeg")
    ->Iterations(4)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

constexpr int kFrames = 360;
BENCHMARK_CAPTURE(search, typical, typical())
    ->Arg(3)
    ->Arg(10)
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, dim, dim())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, out_of_focus, out_of_focus())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, dark, dark())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, blurred, blurred())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, noisy, noisy())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, exposed_for_16_ms, smeared())
    ->Arg(20)
    ->Iterations(kFrames)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmsmith
