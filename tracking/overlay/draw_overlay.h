#pragma once

#include <string>
#include <vector>

#include "tracking/geometry/tag_pose.h"
#include "tracking/geometry/view.h"
#include "tracking/overlay/overlay_run.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A tag that was found in the frame.
struct OverlayTag {
  int tag = 0;
  TagCorners corners{};
  enum class Kind { Robot, Reference, Unknown } kind = Kind::Robot;
};

/// Lines of text in the upper left corner of the picture, and warnings in the lower left corner.
struct OverlayWords {
  std::vector<std::string> lines;
  std::vector<std::string> warnings;
};

/// Draw walls, obstacles, patches and tiles on the floor as the camera sees them, including the
/// distortion of the lens; robots at the height of their tags, with a cross at their centre on the
/// floor, which is the position used by scores; trails on the floor; tags where they were found. A
/// robot whose pose was not measured at this time is drawn hollow.
void draw_floor(ColorImage& image, const View& view, const Mission& mission,
                const std::vector<double>& tile_ages_s);
void draw_robots(ColorImage& image, const View& view, const Outline& body,
                 const std::vector<OverlayRobot>& robots);
void draw_tags(ColorImage& image, const std::vector<OverlayTag>& tags);
void draw_words(ColorImage& image, const OverlayWords& words);

/// Draws all of these.
void draw_overlay(ColorImage& image, const View& view, const Mission& mission,
                  const OverlayMoment& moment, const std::vector<OverlayTag>& tags);

}  // namespace swarmsmith
