#include "tracking/app/watch_run.h"

#include "console/counter.h"
#include "console/sha256.h"
#include "tracking/app/run_checks.h"
#include "tracking/observing/observe.h"

namespace swarmsmith::cli {
namespace {

ObserveOptions observe_options(const RunPlan& plan) {
  ObserveOptions options;
  options.family = plan.rig.family;
  for (const ReferenceTag& reference : plan.rig.references) {
    options.references.insert(reference.tag);
    options.search.expected.insert(reference.tag);
    options.search.still.insert(reference.tag);
  }
  for (const RobotSetup& robot : plan.rig.robots)
    options.search.expected.insert(robot.tag);
  for (const int tag : other_tags(plan.whole_rig, plan.log))
    options.search.expected.insert(tag);
  // A tag that was never seen before is only found in a whole frame; the instant at which it comes
  // is what counts.
  if (plan.log.start.sync == RunStart::Sync::Shown) options.search.full_search_every_s = 0;
  return options;
}

}  // namespace

OrRefusal<Observations> watch_run(RunPlan& plan, Output& output) {
  const ObserveOptions options = observe_options(plan);
  std::vector<CameraObservations> cameras;
  for (std::size_t i = 0; i < plan.videos.size(); ++i) {
    PlannedVideo& video = plan.videos[i];
    auto sha256 = sha256_of_file(video.path.string());
    if (!sha256)
      return refused(
          error_of(IssueCode::VideoUnreadable, sha256.error().message, sha256.error().where));
    Counter watching(output, "watched", "frames of " + video.path.filename().string());
    auto seen = observe({plan.rig.cameras[i], *video.source, video.clock, *sha256}, options,
                        [&](std::int64_t done, std::int64_t of, const std::vector<Detection>&) {
                          watching.tell(done, of);
                        });
    if (!seen) return refused(seen.error());
    cameras.push_back(std::move(*seen));
  }
  return joined_observations(std::move(cameras));
}

}  // namespace swarmsmith::cli
