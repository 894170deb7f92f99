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

/// The rig: the cameras, surveyed floor tags and tagged robots of an arena, as the arena file
/// describes them, and the calibrations that the arena file names, each in its own file
/// (docs/tracking.md).

/// A tag that lies on the floor at a surveyed position.
struct ReferenceTag {
  int tag = 0;
  Pose pose;  ///< position of its centre, and direction of its x axis
  double edge_m = 0;

  friend bool operator==(const ReferenceTag&, const ReferenceTag&) = default;
};

/// The tag's corners on the floor, in the order of TagCorners.
std::array<Point, 4> corners_of(const ReferenceTag& tag);
/// How well the corners were seen where they should be: sum of the squared errors, in pixels.
double squares_off(const View& view, const ReferenceTag& tag, const TagCorners& seen);

/// The moment of the exposure to which a frame's time stamp refers.
enum class StampedAt { Start, Middle, End };

/// A camera over the arena.
struct CameraSetup {
  std::string name;
  std::string model_file;  ///< file of its CameraCalibration, relative to the arena file
  std::string place_file;  ///< file of its PlaceCalibration
  StampedAt stamped_at = StampedAt::Middle;
  double exposure_s = 0;
  double readout_s = 0;         ///< time from the first row to the last; 0 for a global shutter
  double least_height_m = 0.5;  ///< limits of the height at which it may hang
  double most_height_m = 20;
  double time_error_s = 0.005;  ///< one sigma of its time stamps against the run's clock

  friend bool operator==(const CameraSetup&, const CameraSetup&) = default;
};

struct RobotSetup {
  std::string name;
  int tag = 0;
  double edge_m = 0;              ///< edge of the tag's black border
  double height_m = 0;            ///< height of the tag's plane above the floor
  std::string offset_file;        ///< file of its OffsetCalibration; may be empty
  double height_error_m = 0.001;  ///< one sigma
  /// The robot's other tags, each as if it were its only tag, with the robot's name and offset
  /// file.
  std::vector<RobotSetup> more_tags = {};

  friend bool operator==(const RobotSetup&, const RobotSetup&) = default;
};

/// A copy of the robot for each of its tags, the first tag first.
std::vector<RobotSetup> each_tag(const RobotSetup& robot);
std::vector<RobotSetup> each_tag(std::span<const RobotSetup> robots);
/// The tag numbers as text: "tag 1", "tags 1, 11".
std::string tags_text(const RobotSetup& robot);

/// A calibration file, with a digest of its text and the date when it was made.
struct CalibrationFile {
  std::string file;    ///< its name in the arena file
  std::string text;    ///< the whole file
  std::string sha256;  ///< of the text
  std::string made;    ///< "2026-11-21T14:03:00Z"
};

/// The lens of a camera, and the quality of its calibration.
struct CameraCalibration {
  CameraModel model;
  double rms_px = 0;
  double worst_view_px = 0;
  int views = 0;                 ///< number of views that were used
  int views_dropped = 0;         ///< number of views that were dropped as outliers
  double coverage = 0;           ///< share of the frame that the hull of the corners covers, 0 to 1
  std::vector<ImagePoint> hull;  ///< hull of the corners; empty in files that did not keep it
  double focal_sigma_px = 0;     ///< standard deviation of f from the fit; 0 if not known (fisheye)
  std::string board;             ///< its description on the command line
  std::string made;
};

/// The place of a camera, and the quality of its calibration.
struct PlaceCalibration {
  CameraPlace place;
  double rms_px = 0;
  double worst_left_out_m = 0;  ///< largest leave-one-tag-out error on the floor
  int worst_tag = 0;
  double coverage = 0;  ///< share of the arena that the hull of the tags covers
  struct Seen {
    ReferenceTag tag;
    TagCorners corners;     ///< medians over the frames
    double rms_px = 0;      ///< reprojection error
    double left_out_m = 0;  ///< its error on the floor when the place is solved without it
  };
  std::vector<Seen> tags;
  std::string camera_sha256;  ///< digest of the lens calibration that was used
  std::string made;
};

/// The position and direction of a tag on its robot.
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
  double drift_m_s = 0;  ///< speed of the centre during the spin
  double turned_rad = 0;
  int samples = 0;
  std::string made;
  std::vector<OffsetCalibration> more_tags = {};  ///< the robot's other tags, from the same films
};

/// The part of a robot's calibration for one of its tags; null if there is none for this tag.
const OffsetCalibration* of_tag(const OffsetCalibration& calibration, int tag);

/// The contents of an arena file and of the calibrations that it names, read and checked.
struct Rig {
  std::string file;  ///< the arena file's name
  std::string family = "tag36h11";
  std::vector<CameraSetup> cameras;  ///< at least one
  std::vector<ReferenceTag> references;
  std::vector<RobotSetup> robots;  ///< in the order of the robots in a score
  double survey_error_m = 0.002;   ///< one sigma of the floor tags' frame against the arena
  double tilt_error_rad = 0.5 * 0.017453292519943295;  ///< one sigma of how far a robot leans
  /// By the file name in the setups; only files that exist.
  std::map<std::string, CalibrationFile> files;
  std::map<std::string, CameraCalibration> models;
  std::map<std::string, PlaceCalibration> places;
  std::map<std::string, OffsetCalibration> offsets;

  /// The camera with this name, or the only camera if the name is empty. Null if there is none.
  const CameraSetup* setup_of(const std::string& camera) const;
  /// Nothing if a calibration is missing.
  std::optional<View> view_of(const CameraSetup& camera) const;
  /// The offset of one of the entries of `each_tag`.
  std::optional<TagOffset> offset_of(const RobotSetup& robot) const;
};

}  // namespace swarmsmith
