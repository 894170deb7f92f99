#pragma once

#include <string>
#include <vector>

#include "sim/mission/solid.h"
#include "tracking/rig/rig.h"

namespace swarmsmith {

/// The limits that a calibration must keep before a score may be based on it (tracking facts,
/// sections 2, 3 and 5, which give the default values). The programs that make calibrations and the
/// programs that read calibration files both use these functions.

struct CameraLimits {
  int least_views = 10;
  /// Limit of the RMS reprojection error as an angle of rays, because a pixel of a large picture
  /// covers less of the floor: 0.0005 rad is 1.25 mm on a floor 2.5 m below. In small pictures
  /// corners cannot be found more precisely than `least_px`, so the limit in pixels is never below
  /// it.
  double rms_rad = 0.0005;
  double good_rms_rad = 0.0003;  ///< a larger error causes a note
  double least_px = 0.2;
  /// Share of the frame that the hull of the corners covers. The hull must cover the part of the
  /// frame that shows the arena; this is checked once the camera's place is known (lens_reach.h). A
  /// file without a hull needs `good_coverage`.
  double least_coverage = 0.3;
  double good_coverage = 0.7;
  double aspect = 0.02;        ///< largest difference of fx / fy from 1
  double principal = 0.10;     ///< principal point's offset from the middle, over width and height
  double focal_sigma = 0.005;  ///< standard deviation of f divided by f; a larger one causes a note
};

struct PlaceLimits {
  int least_tags = 4;
  /// Limit of the RMS reprojection error on the floor: the error of a survey with a tape
  /// (Rig::survey_error_m). In small pictures corners and lenses are not more precise than
  /// `least_px`.
  double rms_m = 0.002;
  double least_px = 0.3;
  double good_share = 0.5;      ///< share of the limit; a larger error causes a note
  double left_out_m = 0.005;    ///< leave-one-tag-out error on the floor
  double least_coverage = 0.5;  ///< share of the arena that the hull of the tags covers
  double least_height_m = 0.5;  ///< height of the camera above the floor
  double most_height_m = 20;
};

struct OffsetLimits {
  int least_samples = 60;
  double least_turn_rad = 5.235987755982989;  ///< 300 degrees
  double rms_m = 0.002;
  double sigma_m = 0.0005;       ///< standard error of the offset, per axis
  double most_offset_m = 0.135;  ///< the RVR's radius
  double drift_m_s = 0.005;      ///< speed at which the centre moves during the spin
};

/// The largest distance of a tag from the centre of such a robot: as far as its body reaches.
double most_offset_of(const Outline& body);

/// All reasons why a calibration cannot be used, each with its value, its limit and advice:
/// E_CALIB_QUALITY for cameras; E_REF_TAGS and E_EXTRINSICS for places; E_SPIN_QUALITY for offsets.
/// Empty if the calibration is usable.
std::vector<Error> faults_of(const CameraCalibration& calibration, const CameraLimits& limits = {});
std::vector<Error> faults_of(const PlaceCalibration& calibration, const PlaceLimits& limits = {});
std::vector<Error> faults_of(const OffsetCalibration& calibration, const OffsetLimits& limits = {});

/// Notes for a person about a usable calibration, one sentence each.
std::vector<std::string> cautions_of(const CameraCalibration& calibration,
                                     const CameraLimits& limits = {});
std::vector<std::string> cautions_of(const PlaceCalibration& calibration,
                                     const PlaceLimits& limits = {});
std::vector<std::string> cautions_of(const OffsetCalibration& calibration);

/// The largest RMS reprojection error that a lens calibration may have, in pixels of its pictures.
double rms_limit_px(const CameraModel& model, const CameraLimits& limits = {});

/// The largest RMS reprojection error that a place calibration may have, in pixels; and the number
/// of pixels in a metre of floor, measured at the floor tags (0 without tags).
double rms_limit_px(const PlaceCalibration& calibration, const PlaceLimits& limits = {});
double pixels_per_metre(const PlaceCalibration& calibration);

/// The length on the floor of a number of pixels, as text: "1.20 mm on a floor 2.5 m below"; for a
/// place calibration "0.80 mm on the floor", or empty if it has no tags.
std::string on_the_floor(double pixels, const CameraModel& model);
std::string on_the_floor(double pixels, const PlaceCalibration& calibration);

/// A length as text: "3.2 mm".
std::string millimetres(double metres);

}  // namespace swarmsmith
