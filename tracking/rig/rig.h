#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/geometry/tag_pose.h"
#include "tracking/geometry/view.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {

/// The rig: cameras, surveyed floor tags and tagged robots of an arena, as the arena file says it,
/// and the calibrations that it names, each a file of its own (docs/tracking.md).

/// A tag that lies on the floor at a surveyed place.
struct ReferenceTag {
  int tag = 0;
  Pose pose;  ///< of its middle; heading of its x axis
  double edge_m = 0;

  friend bool operator==(const ReferenceTag&, const ReferenceTag&) = default;
};

/// The tag's corners on the floor, in the order of TagCorners.
std::array<Point, 4> corners_of(const ReferenceTag& tag);
/// How far its corners are from where they should be seen: sum of the squares, pixels.
double squares_off(const View& view, const ReferenceTag& tag, const TagCorners& seen);

/// What a time stamp of a frame means.
enum class StampedAt { Start, Middle, End };  ///< of its exposure

/// A camera over the arena.
struct CameraSetup {
  std::string name;
  std::string model_file;  ///< of its CameraCalibration, relative to the arena file
  std::string place_file;  ///< of its PlaceCalibration
  StampedAt stamped_at = StampedAt::Middle;
  double exposure_s = 0;
  double readout_s = 0;         ///< first row to last; 0 for a global shutter
  double least_height_m = 0.5;  ///< that it may hang at
  double most_height_m = 20;
  double time_error_s = 0.005;  ///< one sigma of its stamps against the run's clock

  friend bool operator==(const CameraSetup&, const CameraSetup&) = default;
};

struct RobotSetup {
  std::string name;
  int tag = 0;
  double edge_m = 0;              ///< of the tag's black border
  double height_m = 0;            ///< of the tag's plane above the floor
  std::string offset_file;        ///< of its OffsetCalibration; empty: none
  double height_error_m = 0.001;  ///< one sigma
  /// That it carries besides, each as if the robot carried it alone: its name, its file.
  std::vector<RobotSetup> more_tags = {};

  friend bool operator==(const RobotSetup&, const RobotSetup&) = default;
};

/// The robot once for each tag that it carries, its first one first.
std::vector<RobotSetup> each_tag(const RobotSetup& robot);
std::vector<RobotSetup> each_tag(std::span<const RobotSetup> robots);
/// "tag 1", "tags 1, 11".
std::string tags_text(const RobotSetup& robot);

/// A file that a program made, with a digest of its text and the date from which it holds.
struct CalibrationFile {
  std::string file;    ///< as the arena file names it
  std::string text;    ///< the whole file
  std::string sha256;  ///< of the text
  std::string made;    ///< "2026-11-21T14:03:00Z"
};

/// Intrinsics and how well they were found.
struct CameraCalibration {
  CameraModel model;
  double rms_px = 0;
  double worst_view_px = 0;
  int views = 0;                 ///< used
  int views_dropped = 0;         ///< as outliers
  double coverage = 0;           ///< of the frame by the hull of the corners, 0 to 1
  std::vector<ImagePoint> hull;  ///< of the corners; empty in files that did not keep it
  double focal_sigma_px = 0;     ///< standard deviation of f by the fit; 0: not known (fisheye)
  std::string board;             ///< as it was described
  std::string made;
};

/// Where a camera hangs and how well that was found.
struct PlaceCalibration {
  CameraPlace place;
  double rms_px = 0;
  double worst_left_out_m = 0;  ///< largest leave-one-tag-out error on the floor
  int worst_tag = 0;
  double coverage = 0;  ///< of the arena by the hull of the tags
  struct Seen {
    ReferenceTag tag;
    TagCorners corners;     ///< medians
    double rms_px = 0;      ///< reprojection
    double left_out_m = 0;  ///< floor error when solved without it
  };
  std::vector<Seen> tags;
  std::string camera_sha256;  ///< of the intrinsics it was solved with
  std::string made;
};

/// Where a robot's tag sits on it.
struct OffsetCalibration {
  std::string robot;
  int tag = 0;
  double edge_m = 0;
  double height_m = 0;
  TagOffset offset;
  bool has_yaw = false;  ///< a straight run was filmed
  double rms_m = 0;
  double sigma_x_m = 0;
  double sigma_y_m = 0;
  double drift_m_s = 0;  ///< of the centre, while it span
  double turned_rad = 0;
  int samples = 0;
  std::string made;
  std::vector<OffsetCalibration> more_tags = {};  ///< of the same robot, found at the same time
};

/// What the calibration of a robot says of one of its tags; null when it has none of that tag.
const OffsetCalibration* of_tag(const OffsetCalibration& calibration, int tag);

/// The arena file, with the calibrations that it names, all read and checked.
struct Rig {
  std::string file;  ///< the arena file's name
  std::string family = "tag36h11";
  std::vector<CameraSetup> cameras;  ///< at least one
  std::vector<ReferenceTag> references;
  std::vector<RobotSetup> robots;  ///< in the order of the score's robots
  double survey_error_m = 0.002;   ///< one sigma of the floor tags' frame against the arena
  double tilt_error_rad = 0.5 * 0.017453292519943295;  ///< one sigma of a robot's lean
  /// By the file's name in the setups; only those that exist.
  std::map<std::string, CalibrationFile> files;
  std::map<std::string, CameraCalibration> models;
  std::map<std::string, PlaceCalibration> places;
  std::map<std::string, OffsetCalibration> offsets;

  /// The camera of that name; empty: the only one. Null when there is none.
  const CameraSetup* setup_of(const std::string& camera) const;
  /// Nothing when a calibration is missing.
  std::optional<View> view_of(const CameraSetup& camera) const;
  /// Of one of `each_tag`.
  std::optional<TagOffset> offset_of(const RobotSetup& robot) const;
};

}  // namespace swarmsmith
