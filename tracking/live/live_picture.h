#pragma once

#include <optional>

#include "sim/mission/mission.h"
#include "tracking/live/live_state.h"

namespace swarmsmith {

/// What is known beside the frames.
struct LiveScenery {
  std::optional<View> view;        ///< without it only tags are drawn
  std::optional<Mission> mission;  ///< its floor is drawn, and its robots' bodies
};

/// Draws a state over its frame.
void draw_live(ColorImage& image, const LiveScenery& scenery, const LiveState& state);

}  // namespace swarmsmith
