#include "tracking/live/live_picture.h"

#include <fmt/format.h>

namespace swarmsmith {

void draw_live(ColorImage& image, const LiveScenery& scenery, const LiveState& state) {
  if (scenery.view.has_value()) {
    if (scenery.mission.has_value()) draw_floor(image, *scenery.view, *scenery.mission, {});
    std::vector<OverlayRobot> robots;
    for (const LiveRobot& robot : state.robots)
      if (robot.pose.has_value())
        robots.push_back({robot.name, *robot.pose, robot.height_m,
                          robot.is_seen ? CycleKind::Measured : CycleKind::Missing, robot.trail});
    draw_robots(image, *scenery.view,
                scenery.mission.has_value() ? scenery.mission->body : Mission{}.body, robots);
  }
  draw_tags(image, state.tags);
  draw_words(image, {{fmt::format("{:.1f} s  {:.0f} frames/s  delay {:.0f} ms", state.time_s,
                                  state.frames_per_s, 1000 * state.delay_s)},
                     state.issues});
}

}  // namespace swarmsmith
