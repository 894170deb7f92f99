#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

/// The picture as JPEG, `quality` 1 to 100.
std::vector<std::uint8_t> jpeg_of(const ColorImage& image, int quality);

}  // namespace swarmsmith
