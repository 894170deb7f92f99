#include "tracking/rig/calibration_limits.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/plain_text.h"
#include "sim/mission/footprint.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;

/// Collects errors.
class Faults {
 public:
  /// Callers write `wrong` so that it is true for NaN.
  void add_if(bool wrong, IssueCode code, std::string text) {
    if (wrong) errors_.push_back(error_of(code, std::move(text), ""));
  }
  std::vector<Error> take() { return std::move(errors_); }

 private:
  std::vector<Error> errors_;
};

/// An assumed height, since the camera may not be mounted yet.
constexpr double kFloor_m = 2.5;

/// The error on the floor in brackets: " (0.80 mm on the floor)".
std::string in_brackets(double pixels, const PlaceCalibration& calibration) {
  const std::string text = on_the_floor(pixels, calibration);
  return text.empty() ? text : " (" + text + ")";
}

}  // namespace

std::string on_the_floor(double pixels, const CameraModel& model) {
  return fmt::format("{} on a floor {} m below", millimetres(kFloor_m * pixels / model.fx),
                     kFloor_m);
}

std::string on_the_floor(double pixels, const PlaceCalibration& calibration) {
  const double scale = pixels_per_metre(calibration);
  return scale > 0 ? millimetres(pixels / scale) + " on the floor" : "";
}

std::string millimetres(double metres) {
  return fmt::format("{:.2f} mm", metres * 1000);
}

double rms_limit_px(const CameraModel& model, const CameraLimits& limits) {
  return std::max(limits.least_px, limits.rms_rad * std::min(model.fx, model.fy));
}

double pixels_per_metre(const PlaceCalibration& calibration) {
  double pixels = 0;
  double metres = 0;
  for (const PlaceCalibration::Seen& seen : calibration.tags) {
    for (std::size_t i = 0; i < seen.corners.size(); ++i) {
      const ImagePoint& from = seen.corners.at(i);
      const ImagePoint& to = seen.corners.at((i + 1) % seen.corners.size());
      pixels += std::hypot(to.u - from.u, to.v - from.v);
      metres += seen.tag.edge_m;
    }
  }
  return metres > 0 ? pixels / metres : 0;
}

double rms_limit_px(const PlaceCalibration& calibration, const PlaceLimits& limits) {
  return std::max(limits.least_px, limits.rms_m * pixels_per_metre(calibration));
}

std::vector<Error> faults_of(const CameraCalibration& calibration, const CameraLimits& limits) {
  constexpr IssueCode kCode = IssueCode::CalibrationQuality;
  const CameraModel& model = calibration.model;
  Faults faults;
  faults.add_if(calibration.views < limits.least_views, kCode,
                fmt::format("{}, at least {} are needed; take more pictures of the "
                            "board, 15 or more, from differing sides",
                            counted(calibration.views, "usable view"), limits.least_views));
  const double most_px = rms_limit_px(model, limits);
  faults.add_if(!(calibration.rms_px <= most_px), kCode,
                fmt::format("RMS reprojection {:.3f} px, limit {:.2f} px ({}; limit {}); is the "
                            "board flat, its square measured, the focus locked, every picture "
                            "sharp? A lens of over 100 degrees needs --lens fisheye",
                            calibration.rms_px, most_px, on_the_floor(calibration.rms_px, model),
                            millimetres(kFloor_m * most_px / model.fx)));
  const double least = calibration.hull.empty() ? limits.good_coverage : limits.least_coverage;
  faults.add_if(!(calibration.coverage >= least), kCode,
                fmt::format("the corners' hull covers {:.0f} % of the frame, at least {:.0f} % is "
                            "needed; bring the board into the corners of the picture, too",
                            calibration.coverage * 100, least * 100));
  const double aspect = std::abs(model.fx / model.fy - 1);
  faults.add_if(!(aspect <= limits.aspect), kCode,
                fmt::format("fx {:.1f} and fy {:.1f} differ by {:.1f} %, limit {:.0f} %; take "
                            "views that tilt the board up to 40 degrees about both axes, at the "
                            "size of picture that the runs will have",
                            model.fx, model.fy, aspect * 100, limits.aspect * 100));
  const double off_u = std::abs(model.cx - (model.size.width - 1) / 2.0) / model.size.width;
  const double off_v = std::abs(model.cy - (model.size.height - 1) / 2.0) / model.size.height;
  faults.add_if(
      !(std::max(off_u, off_v) <= limits.principal), kCode,
      fmt::format("principal point ({:.1f}, {:.1f}) is {:.0f} % off the middle, limit "
                  "{:.0f} %; take more tilted views, and pictures that were not cropped",
                  model.cx, model.cy, std::max(off_u, off_v) * 100, limits.principal * 100));
  faults.add_if(!is_monotonic(model), kCode,
                "the lens model folds within the frame; take views with the board in the corners "
                "of the picture, or --lens fisheye for a lens of over 100 degrees");
  return faults.take();
}

std::vector<std::string> cautions_of(const CameraCalibration& calibration,
                                     const CameraLimits& limits) {
  std::vector<std::string> cautions;
  const double good_px = std::max(limits.least_px / 2, limits.good_rms_rad * calibration.model.fx);
  if (calibration.rms_px > good_px) {
    cautions.push_back(fmt::format(
        "RMS {:.3f} px ({}) is above {:.2f} px ({}): the board may not be flat, or pictures "
        "are blurred",
        calibration.rms_px, on_the_floor(calibration.rms_px, calibration.model), good_px,
        on_the_floor(good_px, calibration.model)));
  }
  if (calibration.coverage < limits.good_coverage) {
    cautions.push_back(fmt::format(
        "the corners' hull covers {:.0f} % of the frame: the arena must lie within it, which "
        "`calibrate arena` asks for; {:.0f} % are safe",
        calibration.coverage * 100, limits.good_coverage * 100));
  }
  const double focal = std::max(calibration.model.fx, calibration.model.fy);
  if (calibration.focal_sigma_px > limits.focal_sigma * focal) {
    cautions.push_back(
        fmt::format("focal length is only known to {:.1f} px ({:.2f} %): add views "
                    "that tilt the board by 20 to 40 degrees",
                    calibration.focal_sigma_px, calibration.focal_sigma_px / focal * 100));
  }
  if (calibration.views < 15) {
    cautions.push_back(fmt::format("{} views; 15 or more are better", calibration.views));
  }
  return cautions;
}

std::vector<Error> faults_of(const PlaceCalibration& calibration, const PlaceLimits& limits) {
  Faults faults;
  const auto tags = static_cast<int>(calibration.tags.size());
  faults.add_if(
      tags < limits.least_tags, IssueCode::ReferenceTags,
      fmt::format("{}, at least {} are needed", counted(tags, "floor tag"), limits.least_tags));
  faults.add_if(!(calibration.coverage >= limits.least_coverage), IssueCode::ReferenceTags,
                fmt::format("the floor tags' hull covers {:.0f} % of the arena, at least {:.0f} % "
                            "is needed, else positions are extrapolated; spread the tags to the "
                            "walls",
                            calibration.coverage * 100, limits.least_coverage * 100));
  const auto tag = std::ranges::find(calibration.tags, calibration.worst_tag,
                                     [](const auto& seen) { return seen.tag.tag; });
  const double off = tag == calibration.tags.end() ? calibration.worst_left_out_m : tag->left_out_m;
  const std::string worst = fmt::format("worst is tag {}, {} off where the others put it",
                                        calibration.worst_tag, millimetres(off));
  const double most_px = rms_limit_px(calibration, limits);
  if (!(calibration.rms_px <= most_px)) {
    faults.add_if(
        true, IssueCode::Extrinsics,
        fmt::format("floor tags fit with RMS {:.3f} px{}, limit {:.2f} px{}; {}: survey it "
                    "again (x, y, angle), and check that the camera's calibration is of "
                    "this focus and zoom",
                    calibration.rms_px, in_brackets(calibration.rms_px, calibration), most_px,
                    in_brackets(most_px, calibration), worst));
  } else {
    faults.add_if(!(calibration.worst_left_out_m <= limits.left_out_m), IssueCode::Extrinsics,
                  fmt::format("{}, limit {} (RMS {:.3f} px{}); survey it again (x, y, angle)",
                              worst, millimetres(limits.left_out_m), calibration.rms_px,
                              in_brackets(calibration.rms_px, calibration)));
  }
  const double height = calibration.place.centre().z;
  faults.add_if(!(height >= limits.least_height_m && height <= limits.most_height_m),
                IssueCode::Extrinsics,
                fmt::format("the camera would hang {:.3f} m above the floor, allowed is {} to {} "
                            "m; check `edge` and the places of the floor tags (metres), and "
                            "`height` of the camera",
                            height, limits.least_height_m, limits.most_height_m));
  return faults.take();
}

std::vector<std::string> cautions_of(const PlaceCalibration& calibration,
                                     const PlaceLimits& limits) {
  const double good_px = limits.good_share * rms_limit_px(calibration, limits);
  if (calibration.rms_px <= good_px) return {};
  return {
      fmt::format("RMS {:.3f} px{} is above {:.2f} px{}; good ones have 0.05 px: survey tag {} "
                  "again",
                  calibration.rms_px, in_brackets(calibration.rms_px, calibration), good_px,
                  in_brackets(good_px, calibration), calibration.worst_tag)};
}

double most_offset_of(const Outline& body) {
  if (body == Outline(BoxOutline{kBodySide_m, kBodySide_m})) return OffsetLimits{}.most_offset_m;
  return circumradius_of(body);
}

std::vector<Error> faults_of(const OffsetCalibration& calibration, const OffsetLimits& limits) {
  constexpr IssueCode kCode = IssueCode::SpinQuality;
  Faults faults;
  faults.add_if(calibration.samples < limits.least_samples, kCode,
                fmt::format("{}, at least {} are needed; film a longer spin, two "
                            "turns or more",
                            counted(calibration.samples, "usable sample"), limits.least_samples));
  faults.add_if(!(calibration.turned_rad >= limits.least_turn_rad), kCode,
                fmt::format("it turned by {:.0f} degrees, at least {:.0f} are needed; film two "
                            "turns or more",
                            calibration.turned_rad / kDegree, limits.least_turn_rad / kDegree));
  faults.add_if(!(calibration.rms_m <= limits.rms_m), kCode,
                fmt::format("the tag is {} RMS off a circle, limit {}; let the robot turn on the "
                            "spot, slowly and alone, with its tag fixed firmly",
                            millimetres(calibration.rms_m), millimetres(limits.rms_m)));
  const double sigma = std::max(calibration.sigma_x_m, calibration.sigma_y_m);
  faults.add_if(!(sigma <= limits.sigma_m), kCode,
                fmt::format("the offset is known to {} only, limit {}; film more turns",
                            millimetres(sigma), millimetres(limits.sigma_m)));
  const double length = std::hypot(calibration.offset.x_m, calibration.offset.y_m);
  faults.add_if(!(length <= limits.most_offset_m), kCode,
                fmt::format("the tag would sit {} from the centre, more than the robot's radius of "
                            "{}; does the robot turn on the spot, and not in a curve?",
                            millimetres(length), millimetres(limits.most_offset_m)));
  faults.add_if(!(std::abs(calibration.drift_m_s) <= limits.drift_m_s), kCode,
                fmt::format("the centre crept at {}/s, limit {}/s; turn on level ground, both "
                            "treads equally fast",
                            millimetres(calibration.drift_m_s), millimetres(limits.drift_m_s)));
  std::vector<Error> all = faults.take();
  for (const OffsetCalibration& tag : calibration.more_tags) {
    for (Error& fault : faults_of(tag, limits)) {
      fault.message += fmt::format(" (tag {})", tag.tag);
      all.push_back(std::move(fault));
    }
  }
  return all;
}

std::vector<std::string> cautions_of(const OffsetCalibration& calibration) {
  std::vector<std::string> cautions{
      "a spin shows the centre of rotation, which is taken for the centre of the tread base, the "
      "robot's origin in the simulator; where the treads slip unequally the two differ"};
  if (!calibration.has_yaw) {
    cautions.emplace_back(
        "headings are those of the tag: film a straight run (--straight) to have the robot's; "
        "scores of positions do not need it");
  }
  return cautions;
}

}  // namespace swarmsmith
