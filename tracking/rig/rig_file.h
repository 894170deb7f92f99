#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// A value, or everything that is wrong with a file, by line and column; E_CONFIG each.
template <class T>
using OrComplaints = tl::expected<T, std::vector<Error>>;

/// The arena file (docs/tracking.md) and the calibrations that it names, as far as they are there.
/// Two robots with one tag are E_DUPLICATE_ID.
OrComplaints<Rig> read_rig(const std::filesystem::path& file);
/// The same for a text; calibrations are looked for in the folder of `file`.
OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file);

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
