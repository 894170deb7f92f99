#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <map>
#include <memory>

#include "tracking/geometry/tag_pose.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith::film {

/// The apriltag library itself, so that the renderer is measured against a foreign hand and not
/// against our own conventions. Corners by tag, as OpenCV counts pixels.
inline std::map<int, TagCorners> found_by_library(const GrayImage& image, int decimate = 1) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                tag36h11_destroy);
  const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), family.get(), 1);
  detector->quad_decimate = static_cast<float>(decimate);
  detector->refine_edges = true;
  image_u8_t view{image.width, image.height, static_cast<int32_t>(image.stride),
                  const_cast<std::uint8_t*>(image.pixels)};
  zarray_t* found = apriltag_detector_detect(detector.get(), &view);
  std::map<int, TagCorners> corners;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found, i, static_cast<void*>(&detection));
    TagCorners& at = corners[detection->id];
    for (std::size_t c = 0; c < 4; ++c)
      at[c] = {detection->p[c][0] - 0.5, detection->p[c][1] - 0.5};
  }
  apriltag_detections_destroy(found);
  return corners;
}

}  // namespace swarmsmith::film
