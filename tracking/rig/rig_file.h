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

/// A value, or all errors of a file with line and column, each an E_CONFIG.
template <class T>
using OrComplaints = tl::expected<T, std::vector<Error>>;

/// Reads the arena file (docs/tracking.md) and those of its calibrations that exist. `misfits`
/// checks that they belong together. Two robots with the same tag are an E_DUPLICATE_ID.
OrComplaints<Rig> read_rig(const std::filesystem::path& file);
/// The same for the text of an arena file; calibrations are looked for in the folder of `file`.
OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file);

/// The kinds of calibration that an arena file names.
enum class CalibrationKind { Camera, Place, Offset };
std::string_view name_of(CalibrationKind kind);  ///< "camera", "place", "offset": as in stores

/// Finds the text of a calibration file that the arena file names, by the name of its camera or
/// robot; nothing if there is no such file.
using FindCalibration = std::function<Expected<std::optional<std::string>>(
    CalibrationKind kind, const std::string& subject, const std::string& file)>;
/// The same with calibrations from another source, such as a store, which keeps them with its runs.
OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file,
                            const FindCalibration& find);

/// Calibrations that do not fit the current arena file, each as an E_CALIB_QUALITY that says which
/// one to repeat: a place that was solved with another lens calibration, or an offset for another
/// robot, tag, edge or height. A tag that is not below a camera is an E_CONFIG.
std::vector<Error> misfits(const Rig& rig);
/// The same of the place of one camera.
std::vector<Error> misfits_of_place(const Rig& rig, const CameraSetup& camera);

/// Reasons to doubt the place of a camera, although it can be used. E_EXTRINSICS: the place does
/// not fit the floor tags in its own file, so the file was edited. W_SURVEY_CHANGED: the arena file
/// now has other positions for these floor tags.
std::vector<Issue> doubts_of_place(const Rig& rig, const CameraSetup& camera);

/// The name of a run from the name of its film or log: without the ending, and with `_` in place of
/// letters that a name may not have.
std::string run_name_of(const std::filesystem::path& file);

/// Reads the run log (docs/tracking.md); file names in it are relative to its folder.
OrComplaints<RunLog> read_run_log(const std::filesystem::path& file);
OrComplaints<RunLog> parse_run_log(std::string_view text, const std::filesystem::path& file);
/// The complete log as text, including the mission, as a store keeps it. Reading it gives exactly
/// the same values.
std::string run_log_text(const RunLog& log);

/// Calibrations as TOML files with comments; reading them gives exactly the same values. Errors
/// have line and column; impossible values (a lens model that folds, a matrix that is not a
/// rotation) are an E_CALIB_QUALITY.
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
