#include "tracking/app/watch_run.h"

#include <algorithm>
#include <utility>

#include "base/text/sha256.h"
#include "console/counter.h"
#include "tracking/app/run_checks.h"
#include "tracking/observing/observe.h"
#include "tracking/scoring/measured_layout.h"
#include "tracking/scoring/run_patches.h"

namespace swarmsmith {
namespace {

ObserveOptions observe_options(const RunPlan& plan) {
  ObserveOptions options;
  options.family = plan.rig.family;
  for (const ReferenceTag& reference : plan.rig.references) {
    options.references.insert(reference.tag);
    options.search.expected.insert(reference.tag);
    options.search.still.insert(reference.tag);
  }
  for (const RobotSetup& robot : each_tag(plan.rig.robots))
    options.search.expected.insert(robot.tag);
  for (const int tag : other_tags(plan.whole_rig, plan.log))
    options.search.expected.insert(tag);
  // A tag that was never seen is found only in a search of the whole frame, and here the time when
  // it appears is needed.
  if (plan.log.start.sync == RunStart::Sync::Shown) options.search.full_search_every_s = 0;
  return options;
}

/// The positions of the robots in a frame whose tags are seen.
std::vector<Point> robots_in(const std::vector<Detection>& seen, const Rig& rig, const View& view) {
  const std::vector<RobotSetup> tags = each_tag(rig.robots);
  std::vector<Point> robots;
  for (const Detection& detection : seen) {
    const auto robot = std::ranges::find(tags, detection.tag, &RobotSetup::tag);
    if (robot == tags.end()) continue;
    const TagPose tag = tag_pose(view, detection.corners, robot->edge_m, robot->height_m);
    robots.push_back(robot_pose(tag.pose, rig.offset_of(*robot).value_or(TagOffset{})).position());
  }
  return robots;
}

/// Takes pictures of the floor from a video, spread over its length; at most twice kPictures if its
/// length is unknown.
class FloorPictures {
 public:
  FloorPictures(const RunPlan& plan, std::vector<FloorPicture>& into) : plan_(plan), into_(into) {}

  void look(std::size_t camera, std::int64_t frame, std::int64_t of,
            const std::vector<Detection>& seen) {
    if (plan_.log.layout.source != RunLayout::Source::Measured) return;
    const std::int64_t step = of > 0 ? std::max<std::int64_t>(of / kPictures, 1) : kFramesApart;
    if ((frame - 1) % step != 0 || (frame - 1) / step >= 2 * kPictures) return;
    const View view = *plan_.rig.view_of(plan_.rig.cameras[camera]);
    into_.push_back({view, plan_.videos[camera].source->color(), robots_in(seen, plan_.rig, view)});
  }

 private:
  static constexpr std::int64_t kPictures = 12;
  static constexpr std::int64_t kFramesApart = 150;

  const RunPlan& plan_;
  std::vector<FloorPicture>& into_;
};

/// Measures the layout from the pictures, and adds it to the log.
OrRefusal<void> measure(const std::vector<FloorPicture>& pictures, RunLog& log) {
  if (log.layout.source != RunLayout::Source::Measured) return {};
  const auto layout = measure_layout(pictures, log.mission);
  if (!layout) return refused(layout.error());
  for (const Patch& patch : layout->patches(log.mission.arena))
    log.layout.patches.push_back({centre_of(patch), patch.color});
  return {};
}

}  // namespace

Expected<std::string> sha256_of_source(const std::string& word) {
  const std::string file = file_of_source(word);
  auto sha256 = sha256_of_file(file);
  if (!sha256 || file == word) return sha256;
  // Two topics of one bag are films of two cameras, so the topic is a part of the digest.
  return sha256_of(*sha256 + "  " + word.substr(file.size()) + "\n");
}

OrRefusal<AnalysedRun> watch_run(RunPlan& plan, Output& output) {
  const ObserveOptions options = observe_options(plan);
  std::vector<CameraObservations> cameras;
  std::vector<FloorPicture> pictures;
  FloorPictures floor(plan, pictures);
  for (std::size_t i = 0; i < plan.videos.size(); ++i) {
    PlannedVideo& video = plan.videos[i];
    auto sha256 = sha256_of_source(video.path.string());
    if (!sha256)
      return refused(
          error_of(IssueCode::VideoUnreadable, sha256.error().message, sha256.error().where));
    Counter watching(
        output, "watched",
        "frames of " +
            std::filesystem::path(file_of_source(video.path.string())).filename().string());
    auto seen =
        observe({plan.rig.cameras[i], *video.source, video.clock, *sha256}, options,
                [&](std::int64_t done, std::int64_t of, const std::vector<Detection>& detections) {
                  watching.tell(done, of);
                  floor.look(i, done, of, detections);
                });
    if (!seen) return refused(seen.error());
    cameras.push_back(std::move(*seen));
  }
  if (auto measured = measure(pictures, plan.log); !measured) {
    return tl::unexpected(std::move(measured.error()));
  }
  Observations observations = joined_observations(std::move(cameras));
  observations.logs = plan.robots.logs;
  observations.issues.insert(observations.issues.end(), plan.robots.issues.begin(),
                             plan.robots.issues.end());
  return analyse(std::move(observations), plan.whole_rig, plan.log, plan.takes_tags_for_centres);
}

}  // namespace swarmsmith
