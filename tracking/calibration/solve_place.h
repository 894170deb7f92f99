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

/// A surveyed floor tag and where the camera sees its corners.
struct SeenTag {
  ReferenceTag tag;
  TagCorners corners{};

  friend bool operator==(const SeenTag&, const SeenTag&) = default;
};

/// Medians, corner by corner, of what was seen of each floor tag in several looks; tags that were
/// not surveyed, and those in less than a quarter of the looks, are left out. By tag.
struct TagLook {
  int tag = 0;
  TagCorners corners{};
};
std::vector<SeenTag> median_of_looks(const std::vector<std::vector<TagLook>>& looks,
                                     std::span<const ReferenceTag> survey);

/// A place that fits, without a judgement.
struct PlaceFit {
  CameraPlace place;
  double rms_px = 0;  ///< reprojection over all corners
};

/// Where a camera hangs that sees the floor tags so: SQPNP and both planar solutions (IPPE) as
/// starts, each refined by Levenberg and Marquardt on all corners in pixels of the distorted image;
/// of those above the floor the one with the least error. Nothing when none leads anywhere; two
/// tags at least.
std::optional<PlaceFit> fit_place(std::span<const SeenTag> seen, const CameraModel& camera);

/// What a place is solved from.
struct PlaceQuestion {
  std::vector<SeenTag> seen;
  std::vector<ReferenceTag> survey;  ///< all, seen or not
  CameraModel camera;
  std::vector<Point> arena;  ///< corners of its walls
  PlaceLimits limits;
};

/// A camera's place with all checks of tracking facts, section 3, but without date and digest.
/// E_REF_TAGS with the ids seen and missing: fewer than four tags, in one line, or over less than
/// half of that part of the arena which the camera sees. E_EXTRINSICS: they do not fit, with the
/// worst tag and its error; of the tags that may be surveyed wrongly the one is named without which
/// the others fit best.
Expected<PlaceCalibration> solve_place(const PlaceQuestion& question);

/// The same question again, from a calibration's medians with the survey and camera of now. Tags
/// that are not in the survey any more are left out.
PlaceQuestion question_again(const PlaceCalibration& old, PlaceQuestion now);

}  // namespace swarmsmith
