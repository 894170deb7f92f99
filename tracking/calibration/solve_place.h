#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "sim/mission/arena.h"
#include "tracking/geometry/view.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// A surveyed floor tag, and the corners that the camera sees.
struct SeenTag {
  ReferenceTag tag;
  TagCorners corners{};

  friend bool operator==(const SeenTag&, const SeenTag&) = default;
};

/// The corners of each floor tag as medians over several looks, corner by corner, in order of tag
/// number. Tags that were not surveyed, or that are in less than a quarter of the looks, are left
/// out.
struct TagLook {
  int tag = 0;
  TagCorners corners{};
};
std::vector<SeenTag> median_of_looks(const std::vector<std::vector<TagLook>>& looks,
                                     std::span<const ReferenceTag> survey);

/// The best place, without a check of its quality.
struct PlaceFit {
  CameraPlace place;
  double rms_px = 0;  ///< reprojection error over all corners
};

/// Finds the place of a camera from the floor tags that it sees. SQPNP and both planar solutions
/// (IPPE) are starting points; each is refined with the Levenberg-Marquardt method on all corners
/// in pixels of the distorted image. Of the solutions above the floor, the one with the smallest
/// error is returned. Nothing if there is none. Needs at least two tags.
std::optional<PlaceFit> fit_place(std::span<const SeenTag> seen, const CameraModel& camera);

/// The input for solving a place.
struct PlaceQuestion {
  std::vector<SeenTag> seen;
  std::vector<ReferenceTag> survey;  ///< all floor tags, seen or not
  CameraModel camera;
  std::vector<Point> arena;  ///< corners of the arena's walls
  PlaceLimits limits;
};

/// A camera's place with all checks of tracking facts, section 3, but without date and digest.
/// E_REF_TAGS with the numbers of seen and missing tags if there are fewer than four tags, if they
/// are on one line, or if they cover less than half of the part of the arena that the camera sees.
/// E_EXTRINSICS with the worst tag and its error if they do not fit; if a tag may be surveyed
/// wrongly, this is the tag without which the others fit best.
Expected<PlaceCalibration> solve_place(const PlaceQuestion& question);

/// The input to solve an old calibration's place again: its medians, with the current survey and
/// camera. Tags that are no longer in the survey are left out.
PlaceQuestion question_again(const PlaceCalibration& old, PlaceQuestion now);

}  // namespace swarmsmith
