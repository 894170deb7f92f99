#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "tracking/rig/issue.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// A value, or everything that is wrong with a file, by line and column; E_CONFIG each.
template <class T>
using OrComplaints = tl::expected<T, std::vector<Error>>;

/// The arena file (docs/tracking.md) and the calibrations that it names, as far as they are there;
/// whether they belong together, `misfits` says. Two robots with one tag are E_DUPLICATE_ID.
OrComplaints<Rig> read_rig(const std::filesystem::path& file);
/// The same for a text; calibrations are looked for in the folder of `file`.
OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file);

/// What a calibration that an arena file names is of.
enum class CalibrationKind { Camera, Place, Offset };
std::string_view name_of(CalibrationKind kind);  ///< "camera", "place", "offset": as in stores

/// The text of a calibration of a camera or robot, whose file the arena file names; nothing when it
/// is not there.
using FindCalibration = std::function<Expected<std::optional<std::string>>(
    CalibrationKind kind, const std::string& subject, const std::string& file)>;
/// The same with calibrations from elsewhere: a store keeps them with its runs.
OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file,
                            const FindCalibration& find);

/// Calibrations that do not belong to what the arena file says now, each an E_CALIB_QUALITY with
/// what to do again: a place that was solved with another camera calibration, an offset of another
/// robot, tag, edge or height. E_CONFIG: a tag that is not below a camera.
std::vector<Error> misfits(const Rig& rig);

/// What makes the place of a camera doubtful, though it can be used. E_EXTRINSICS: the floor tags
/// that its file holds do not lie where it sees them, so that the file was changed.
/// W_SURVEY_CHANGED: the arena file has floor tags elsewhere now.
std::vector<Issue> doubts_of_place(const Rig& rig, const CameraSetup& camera);

/// The run log (docs/tracking.md); files that it names are relative to its folder.
OrComplaints<RunLog> read_run_log(const std::filesystem::path& file);
OrComplaints<RunLog> parse_run_log(std::string_view text, const std::filesystem::path& file);
/// The log, whole, with the mission in it: what a store keeps. Reads back to the same bits.
std::string run_log_text(const RunLog& log);

/// Calibrations as TOML files with comments; they read back to the same bits. Errors name line and
/// column, and E_CALIB_QUALITY what cannot be (a folding lens, a rotation that is none).
std::string calibration_text(const CameraCalibration& calibration);
std::string calibration_text(const PlaceCalibration& calibration);
std::string calibration_text(const OffsetCalibration& calibration);
OrComplaints<CameraCalibration> parse_camera_calibration(std::string_view text,
                                                         const std::string& file);
OrComplaints<PlaceCalibration> parse_place_calibration(std::string_view text,
                                                       const std::string& file);
OrComplaints<OffsetCalibration> parse_offset_calibration(std::string_view text,
                                                         const std::string& file);

}  // namespace swarmsmith
