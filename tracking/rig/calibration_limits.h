#pragma once

#include <string>
#include <vector>

#include "tracking/rig/rig.h"

namespace swarmsmith {

/// What a calibration must fulfil before a score may rest on it (tracking facts, sections 2, 3 and
/// 5; the defaults are theirs). Who makes a calibration and who reads its file ask here alike.

struct CameraLimits {
  int least_views = 10;
  /// Reprojection as an angle of rays, since a pixel of a large picture is a small thing: 1.25 mm
  /// on a floor 2.5 m below. Corners are not found better than `least_px` in small pictures.
  double rms_rad = 0.0005;
  double good_rms_rad = 0.0003;  ///< above it a note says so
  double least_px = 0.2;
  /// Of the frame by the corners' hull. What counts is the part that the arena fills, which is
  /// asked for where the camera's place is known (lens_reach.h); files without a hull need all of
  /// it.
  double least_coverage = 0.3;
  double good_coverage = 0.7;
  double aspect = 0.02;        ///< of fx / fy about 1
  double principal = 0.10;     ///< of the principal point from the middle, over width and height
  double focal_sigma = 0.005;  ///< standard deviation of f over f, above it a note says so
};

struct PlaceLimits {
  int least_tags = 4;
  /// Reprojection on the floor: what a tape is off by (Rig::survey_error_m). Corners and lenses of
  /// small pictures are not better than `least_px`.
  double rms_m = 0.002;
  double least_px = 0.3;
  double good_share = 0.5;      ///< of the limit; above it a note says so
  double left_out_m = 0.005;    ///< leave-one-tag-out error on the floor
  double least_coverage = 0.5;  ///< of the arena by the tags' hull
  double least_height_m = 0.5;  ///< of the camera
  double most_height_m = 20;
};

struct OffsetLimits {
  int least_samples = 60;
  double least_turn_rad = 5.235987755982989;  ///< 300 degrees
  double rms_m = 0.002;
  double sigma_m = 0.0005;       ///< of the offset, per axis
  double most_offset_m = 0.135;  ///< the robot's radius
  double drift_m_s = 0.005;      ///< of the centre
};

/// Everything that makes a calibration unfit, each with value, limit and what to do:
/// E_CALIB_QUALITY; E_REF_TAGS and E_EXTRINSICS; E_SPIN_QUALITY. Empty: it is fit.
std::vector<Error> faults_of(const CameraCalibration& calibration, const CameraLimits& limits = {});
std::vector<Error> faults_of(const PlaceCalibration& calibration, const PlaceLimits& limits = {});
std::vector<Error> faults_of(const OffsetCalibration& calibration, const OffsetLimits& limits = {});

/// What a person should know of one that is fit, a sentence each.
std::vector<std::string> cautions_of(const CameraCalibration& calibration,
                                     const CameraLimits& limits = {});
std::vector<std::string> cautions_of(const PlaceCalibration& calibration,
                                     const PlaceLimits& limits = {});
std::vector<std::string> cautions_of(const OffsetCalibration& calibration);

/// The RMS reprojection that a lens may have, pixels of its pictures.
double rms_limit_px(const CameraModel& model, const CameraLimits& limits = {});

/// The RMS reprojection that a place may have, pixels; and how many pixels a metre of floor has, by
/// the floor tags. 0 without tags.
double rms_limit_px(const PlaceCalibration& calibration, const PlaceLimits& limits = {});
double pixels_per_metre(const PlaceCalibration& calibration);

/// What pixels are on a floor, for people: "1.20 mm on a floor 2.5 m below"; "0.80 mm on the
/// floor", empty without tags.
std::string on_the_floor(double pixels, const CameraModel& model);
std::string on_the_floor(double pixels, const PlaceCalibration& calibration);

/// A length as people read it: "3.2 mm".
std::string millimetres(double metres);

}  // namespace swarmsmith
