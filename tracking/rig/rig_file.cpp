#include "tracking/rig/rig_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/math.h"
#include "base/text/sha256.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/read_place.h"
#include "sim/mission/polygon.h"
#include "tracking/geometry/tag_family.h"
#include "tracking/rig/internal/config_errors.h"
#include "tracking/rig/internal/rig_limits.h"

namespace swarmsmith {
namespace {

/// Limits of a frame's exposure and readout; frames of a second are far too slow for tracking.
constexpr Limits<double> kFrameTime{0, 1};
/// Limits of one sigma of a manual measurement.
constexpr Limits<double> kLengthError{0, 0.1};
constexpr Limits<double> kTiltError{0, 20};

/// The state while an arena file is read.
struct Reading {
  Rig rig;
  int tags_of_family = 0;
  std::vector<std::pair<int, std::string>> tags;  ///< tags in use, and their owners
};

void read_family(TableReader& root, Reading& reading) {
  std::vector<std::string> names;
  for (const TagFamily& family : known_tag_families())
    names.emplace_back(family.name);
  if (const auto family = root.choice("family", names)) reading.rig.family = *family;
  for (const TagFamily& family : known_tag_families()) {
    if (family.name == reading.rig.family) reading.tags_of_family = family.tags;
  }
}

/// Reads the number of a tag, which may have only one owner.
int read_tag(TableReader& table, Reading& reading, const std::string& owner) {
  if (!table.has("tag")) table.complain("tag", table.name() + " needs a `tag`, its number");
  const auto tag = table.integer("tag", {0, reading.tags_of_family - 1});
  if (!tag) return -1;
  const int number = static_cast<int>(*tag);
  for (const auto& [taken, by] : reading.tags) {
    if (taken != number) continue;
    table.complain("tag", "E_DUPLICATE_ID: tag " + std::to_string(number) + " is on " + by +
                              " and on " + owner +
                              "; each robot and each place on the floor needs its own tag");
  }
  reading.tags.emplace_back(number, owner);
  return number;
}

CameraSetup read_camera(TableReader& table, const std::vector<std::string>& taken) {
  static const std::vector<std::string> kStamps = {"start", "middle", "end"};
  CameraSetup camera;
  camera.name = table.text("name").value_or("");
  check_name(table, camera.name, taken);
  const std::string example = camera.name.empty() ? "ceiling" : camera.name;
  camera.model_file = need_text(table, "model", example + ".camera.toml");
  camera.place_file = need_text(table, "place", example + ".place.toml");
  if (const auto stamp = table.choice("stamp", kStamps)) {
    const auto at = std::ranges::find(kStamps, *stamp) - kStamps.begin();
    camera.stamped_at = static_cast<StampedAt>(at);
  }
  camera.exposure_s = table.seconds("exposure", kFrameTime).value_or(0);
  camera.readout_s = table.seconds("readout", kFrameTime).value_or(0);
  camera.time_error_s = table.seconds("time_error", kFrameTime).value_or(camera.time_error_s);
  if (const auto height = table.interval("height", "a range of metres, such as [0.5, 20]")) {
    const bool good = height->least >= kCameraHeight.least && height->most <= kCameraHeight.most &&
                      height->least < height->most;
    if (good) {
      camera.least_height_m = height->least;
      camera.most_height_m = height->most;
    } else {
      table.complain("height", "`height` must be [least, most] in metres, within 0.05 to 100");
    }
  }
  table.finish();
  return camera;
}

ReferenceTag read_reference(TableReader& table, Reading& reading) {
  ReferenceTag reference;
  const Point place = need_point(table);
  reference.tag = read_tag(table, reading, "the floor at " + point_text(place));
  reference.pose = {place.x, place.y, read_heading(table)};
  reference.edge_m = need(table, "edge", kTagEdge);
  table.finish();
  return reference;
}

/// Reads the values that a robot has for each of its tags.
void read_tag_of(TableReader& table, Reading& reading, RobotSetup& robot) {
  robot.tag = read_tag(table, reading, "robot \"" + robot.name + "\"");
  robot.edge_m = need(table, "edge", kTagEdge);
  robot.height_m = need(table, "height", kTagHeight);
  const auto lowest =
      std::ranges::min_element(reading.rig.cameras, {}, &CameraSetup::least_height_m);
  const double least =
      lowest == reading.rig.cameras.end() ? CameraSetup{}.least_height_m : lowest->least_height_m;
  if (table.has("height") && robot.height_m >= least && robot.height_m < kTagHeight.most) {
    table.complain("height", "`height` must be below the camera, whose `height` begins at " +
                                 number_text(least) + " m; this is " + number_text(robot.height_m));
  }
  robot.height_error_m = table.number("height_error", kLengthError).value_or(robot.height_error_m);
}

RobotSetup read_robot(TableReader& table, Reading& reading, const std::vector<std::string>& taken) {
  RobotSetup robot;
  robot.name = table.text("name").value_or("");
  check_name(table, robot.name, taken);
  read_tag_of(table, reading, robot);
  robot.offset_file = table.text("offset").value_or("");
  for (TableReader& more : table.tables("more_tags")) {
    RobotSetup tag{.name = robot.name, .offset_file = robot.offset_file};
    read_tag_of(more, reading, tag);
    more.finish();
    robot.more_tags.push_back(std::move(tag));
  }
  table.finish();
  return robot;
}

/// Reads a calibration that `table` names under `key`, if it exists: its file goes into the rig,
/// and its contents into `into`.
template <class Calibration, class Parse>
void read_calibration(TableReader& table, std::string_view key, const std::string& file,
                      const Expected<std::optional<std::string>>& text, const Parse& parse,
                      Rig& rig, std::map<std::string, Calibration>& into) {
  if (file.empty() || into.contains(file)) return;
  if (!text) return table.complain(key, to_string(text.error()));
  if (!*text) return;
  auto calibration = parse(**text, file);
  if (!calibration) {
    for (Error& error : config_errors(std::move(calibration.error())))
      table.complain_foreign(key, std::move(error));
    return;
  }
  rig.files[file] = {file, **text, sha256_of(**text), calibration->made};
  into[file] = std::move(*calibration);
}

void read_cameras(TableReader& root, Reading& reading, const FindCalibration& find) {
  std::vector<std::string> names;
  Rig& rig = reading.rig;
  for (TableReader& table : root.tables("camera")) {
    const CameraSetup camera = read_camera(table, names);
    names.push_back(camera.name);
    read_calibration(table, "model", camera.model_file,
                     find(CalibrationKind::Camera, camera.name, camera.model_file),
                     parse_camera_calibration, rig, rig.models);
    read_calibration(table, "place", camera.place_file,
                     find(CalibrationKind::Place, camera.name, camera.place_file),
                     parse_place_calibration, rig, rig.places);
    rig.cameras.push_back(camera);
  }
  if (!root.has("camera")) {
    root.complain("camera",
                  "the file has no [[camera]]; `swarmsmith track init` writes a file "
                  "to begin with");
  }
}

void read_robots(TableReader& root, Reading& reading, const FindCalibration& find) {
  std::vector<std::string> names;
  Rig& rig = reading.rig;
  for (TableReader& table : root.tables("robot")) {
    const RobotSetup robot = read_robot(table, reading, names);
    names.push_back(robot.name);
    read_calibration(table, "offset", robot.offset_file,
                     find(CalibrationKind::Offset, robot.name, robot.offset_file),
                     parse_offset_calibration, rig, rig.offsets);
    rig.robots.push_back(robot);
  }
}

}  // namespace

std::string_view name_of(CalibrationKind kind) {
  static constexpr std::array<std::string_view, 3> kNames = {"camera", "place", "offset"};
  return kNames.at(static_cast<std::size_t>(kind));
}

OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file,
                            const FindCalibration& find) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(config_errors({document.error()}));
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  Reading reading;
  reading.rig.file = file.filename().string();
  read_format(root);
  read_family(root, reading);
  Rig& rig = reading.rig;
  rig.survey_error_m = root.number("survey_error", kLengthError).value_or(rig.survey_error_m);
  if (const auto tilt = root.number("tilt_error", kTiltError))
    rig.tilt_error_rad = *tilt * kPi / 180;
  read_cameras(root, reading, find);
  for (TableReader& table : root.tables("reference"))
    reading.rig.references.push_back(read_reference(table, reading));
  read_robots(root, reading, find);
  root.finish();
  if (!complaints.empty()) return tl::unexpected(config_errors(complaints.take()));
  return std::move(reading.rig);
}

OrComplaints<Rig> parse_rig(std::string_view text, const std::filesystem::path& file) {
  return parse_rig(text, file,
                   [&](CalibrationKind kind, const std::string&,
                       const std::string& name) -> Expected<std::optional<std::string>> {
                     auto found = read_file(file.parent_path() / name,
                                            std::string(name_of(kind)) + " calibration");
                     if (found) return std::move(*found);
                     if (found.error().kind == ErrorKind::NotFound) return std::nullopt;
                     return Unexpected(std::move(found.error()));
                   });
}

OrComplaints<Rig> read_rig(const std::filesystem::path& file) {
  const auto text = read_file(file, "arena");
  if (!text) return tl::unexpected(config_errors({text.error()}));
  return parse_rig(*text, file);
}

}  // namespace swarmsmith
