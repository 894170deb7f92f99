#include "sim/files/robot_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/plain_text.h"
#include "base/suggestion.h"
#include "base/text/document.h"
#include "base/text/whole_file.h"
#include "embedded/kEpuckRobot.h"
#include "embedded/kRvrRobot.h"
#include "sim/control/toml_kind.h"
#include "sim/engine/fitting.h"
#include "sim/files/internal/field_reader.h"
#include "sim/files/internal/field_writer.h"
#include "sim/files/mission_file.h"
#include "sim/mission/footprint.h"
#include "sim/robot/idle_fields.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kTable = "robot";  ///< of a robot in a text of its own

constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kRobotFiles = {
    {{"rvr", kRvrRobot}, {"epuck", kEpuckRobot}}};

Robot built_in_robot(std::string_view name) {
  auto robot = parse_robot(built_in_robot_text(name), std::string(name) + ".toml");
  SWARMSMITH_ASSERT(robot.has_value(), "the robots that the program carries can be read");
  return std::move(*robot);
}

/// Complains about a key of a device, or about the device if the key comes from the base.
void complain_of_key(TableReader& table, std::string_view device, std::string_view key,
                     const std::string& message) {
  if (auto inner = table.table(device)) {
    inner->complain(key, message);
  } else {
    table.complain(device, message);
  }
}

/// Walls and other bodies stop a robot at sub-steps, by impulses against those of its drive.
void check_drive(TableReader& table, const Robot& robot) {
  constexpr double kSubStep_s = 0.01;
  constexpr double kMostAcceleration_mps2 = 500;
  const double width_m = 2 * inradius_of(robot.body.outline);
  const double way_m = robot.drive.max_speed_mps * kSubStep_s;
  if (way_m > width_m) {
    complain_of_key(table, "drive", "max_speed",
                    "it would move " + number_text(way_m) + " m in " + number_text(kSubStep_s) +
                        " s, more than its own width of " + number_text(width_m) +
                        " m, and so through walls; `max_speed` may be up to " +
                        number_text(width_m / kSubStep_s) + " m/s for this body");
  }
  const double most_N = kMostAcceleration_mps2 * robot.body.mass_kg;
  if (robot.drive.max_force_N > most_N) {
    complain_of_key(table, "drive", "force",
                    "`force` is " + number_text(robot.drive.max_force_N) +
                        " N, which would push a robot of " + number_text(robot.body.mass_kg) +
                        " kg through walls; give up to " + number_text(most_N) +
                        " N, 500 times its mass");
  }
}

/// Checks for numbers that are within their limits, but impossible for a body of this size.
void check_measures(TableReader& table, const Robot& robot) {
  constexpr double kMostTimes = 1000;  ///< between the inertia of a plate and the robot's
  constexpr double kMostRadii = 3;
  constexpr double kNear_m = 0.5;  ///< the RVR's places on a small body are within it
  const double radius_m = circumradius_of(robot.body.outline);
  const double inertia = robot.body.inertia_kg_m2;
  const double plate = plate_inertia_of(robot.body);
  if (inertia != 0 && (inertia < plate / kMostTimes || inertia > plate * kMostTimes)) {
    complain_of_key(table, "body", "inertia",
                    "`inertia` is " + number_text(inertia) +
                        " kg m2, but a plate of this outline and mass has " + number_text(plate) +
                        "; give a value from a thousandth to a thousand times of that, or 0 for "
                        "the plate's");
  }
  const auto check_place = [&](std::string_view device, std::string_view key, double out_m) {
    if (out_m <= std::max(kNear_m, kMostRadii * radius_m)) return;
    complain_of_key(table, device, key,
                    "`" + std::string(key) + "` is " + number_text(out_m) +
                        " m from the centre, but the body ends " + number_text(radius_m) +
                        " m from it; at most 0.5 m, or three times the body's radius, is allowed");
  };
  check_place("proximity", "start", robot.proximity.start_m);
  // The RVR's is allowed: a robot has it if its file does not name `out`.
  if (robot.light.reading == LightRing::Reading::Strength && robot.light.out_m != 0 &&
      robot.light.out_m != LightRing{}.out_m) {
    complain_of_key(table, "light", "out",
                    "strengths of light are measured at the robot's centre, and `out` does nothing "
                    "here; leave it out, or use reading = \"lux\"");
  } else {
    check_place("light", "out", robot.light.out_m);
  }
  check_drive(table, robot);
  const NeighbourSensor& sensor = robot.neighbours;
  if (sensor.range_m > 0 && sensor.less_m > 0 && sensor.less_m >= sensor.range_m) {
    complain_of_key(table, "neighbours", "less",
                    "all distances would be 0 or less: `less` is " + number_text(sensor.less_m) +
                        " m, but `range` is " + number_text(sensor.range_m) +
                        " m; give a smaller `less`");
  }
}

/// Checks for errors that no single field shows.
void check_robot(TableReader& table, const Robot& robot) {
  const ProximityRing& ring = robot.proximity;
  const auto number = [](double value) { return number_text(value); };
  if (ring.rays_deg.empty()) table.complain("proximity", "a robot needs at least one ray");
  if (!ring.labels_deg.empty() && ring.labels_deg.size() != ring.rays_deg.size()) {
    table.complain("proximity", "the ring has " + counted(ring.rays_deg.size(), "ray") + " and " +
                                    counted(ring.labels_deg.size(), "label") +
                                    "; give each ray a label, or give no labels");
  }
  const double inradius_m = inradius_of(robot.body.outline);
  if (ring.start_m > 0 && ring.start_m < inradius_m) {
    table.complain("proximity", "rays would start inside of the body, " + number(ring.start_m) +
                                    " m from the centre; let them start at " + number(inradius_m) +
                                    " m or farther, or at 0 for the body's edge");
  }
  if (ring.reading == ProximityRing::Reading::Strength && ring.reach_m == 0) {
    table.complain("proximity", "a ring with reading = \"strength\" needs a `reach` and a `law`");
  }
  const GroundSensor& ground = robot.ground;
  if (ground.reading == GroundSensor::Reading::Vote) {
    const auto readings = static_cast<int>(ground.places.size()) * ground.vote_ticks;
    if (readings < 2) {
      table.complain("ground", "a vote needs two readings or more: more `points`, or more `ticks`");
    } else if (ground.vote_majority < 1 || ground.vote_majority >= readings) {
      table.complain("ground", "a vote of " + std::to_string(readings) +
                                   " readings needs a `majority` from 1 to " +
                                   std::to_string(readings - 1) + ", not " +
                                   std::to_string(ground.vote_majority));
    }
    if (ground.black_below > ground.white_above) {
      table.complain("ground", "`black_below` is above `white_above`; swap them");
    }
  } else if (ground.places.size() > 1) {
    table.complain("ground", "with reading = \"color\" there is one point, these are " +
                                 std::to_string(ground.places.size()));
  }
}

/// An error without a place belongs to the key.
void complain_of(TableReader& table, std::string_view key, const Error& error) {
  if (error.where.empty()) {
    table.complain(key, error.message);
  } else {
    table.complain_foreign(key, error);
  }
}

constexpr int kMostBases = 16;

/// `depth` is the number of files read so far, each as base of the one before.
RobotOrErrors robot_of_word(const std::string& word, const std::filesystem::path& folder,
                            int depth);

/// `depth` is the depth of the file with the table.
void read_base(TableReader& table, const std::filesystem::path* folder, int depth, Robot& robot) {
  if (const auto base = table.text("base")) {
    if (names_a_file(*base) && folder == nullptr) {
      table.complain("base", "a robot begins with a built-in one here: " + joined(robot_names()));
    } else if (depth >= kMostBases) {
      table.complain("base", "a chain of bases has more than " + std::to_string(kMostBases) +
                                 " files, or is a circle");
    } else if (auto found = robot_of_word(*base, folder == nullptr ? "" : *folder, depth + 1)) {
      robot = std::move(*found);
    } else {
      for (const Error& error : found.error())
        complain_of(table, "base", error);
    }
  }
}

/// Fields that have no effect on the robot may be present with the base's value. The robot then
/// gets the value of a robot without these fields, so that its text can be read back.
void settle_idle_fields(TableReader& table, const Robot& base, Robot& robot) {
  const auto settle = [&robot](const Robot& from) {
    IdleFields fields(robot);
    visit_robot_fields(from, fields);
    fields.compare();
    visit_robot_fields(robot, fields);
    return fields.found();
  };
  for (const IdleField& field : settle(base)) {
    if (!field.differs) continue;
    table.table(field.device)
        ->complain(field.key, "`" + field.key + "` is only for robots " +
                                  std::string(field.robots) +
                                  " and does nothing here; leave it out");
  }
  settle(Robot{});
}

void read_devices(TableReader& table, Robot& robot) {
  const std::size_t before = table.complaints();
  const Robot base = robot;
  FieldReader reader(table);
  visit_robot_fields(robot, reader);
  reader.finish();
  if (table.complaints() > before) return;
  check_robot(table, robot);
  check_measures(table, robot);
  settle_idle_fields(table, base, robot);
}

RobotOrErrors robot_of_text(std::string_view text, const std::filesystem::path& file, int depth) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  read_format(root);
  Robot robot;
  const std::filesystem::path folder = file.parent_path();
  read_base(root, &folder, depth, robot);
  robot.name = file.stem().string();
  if (!is_name(robot.name)) {
    root.complain("name",
                  "a robot gets its file's name, so this must consist of letters, digits, "
                  "`_`, `-` and `.`; it is \"" +
                      robot.name + "\"");
  }
  read_devices(root, robot);
  root.finish();
  if (!complaints.empty()) {
    return tl::unexpected(complaints_about(*document, TomlKind::Robot, file.string(), complaints));
  }
  return robot;
}

RobotOrErrors robot_of_word(const std::string& word, const std::filesystem::path& folder,
                            int depth) {
  if (!names_a_file(word)) {
    if (!built_in_robot_text(word).empty()) return built_in_robot(word);
    const std::vector<std::string> names = robot_names();
    return tl::unexpected(std::vector<Error>{
        {ErrorKind::NotFound, "there is no robot `" + word + "`" + did_you_mean(word, names) +
                                  "; built in are: " + joined(names) +
                                  "; a file of your own ends in .toml"}});
  }
  const auto text = read_file(folder / word, "robot");
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  auto robot = robot_of_text(*text, folder / word, depth);
  if (robot && !built_in_robot_text(robot->name).empty() && *robot != built_in_robot(robot->name)) {
    const std::string why = "a robot gets its file's name, but `" + robot->name +
                            "` is built in with other values; rename the file";
    return tl::unexpected(std::vector<Error>{{ErrorKind::BadInput, why, (folder / word).string()}});
  }
  return robot;
}

/// Whether a table has everything of a robot, as in the text of a store.
bool has_all_devices(const TableReader& table) {
  return !table.has("base") &&
         std::ranges::all_of(
             std::array{"body", "drive", "proximity", "light", "ground", "neighbours"},
             [&](const char* device) { return table.has(device); });
}

/// Refuses a user's robot that has the name of a built-in one and other values.
void check_own_name(TableReader& table, const Robot& robot) {
  if (built_in_robot_text(robot.name).empty() || robot == built_in_robot(robot.name)) return;
  table.complain("name", "`" + robot.name +
                             "` is built in with other values; give the robot another name, or "
                             "leave `name` out");
}

}  // namespace

std::vector<std::string> robot_names() {
  std::vector<std::string> names;
  names.reserve(kRobotFiles.size());
  for (const auto& [name, text] : kRobotFiles)
    names.emplace_back(name);
  return names;
}

std::string_view built_in_robot_text(std::string_view name) {
  for (const auto& [known, text] : kRobotFiles) {
    if (known == name) return text;
  }
  return {};
}

RobotOrErrors parse_robot(std::string_view text, const std::filesystem::path& file) {
  return robot_of_text(text, file, 0);
}

RobotOrErrors find_robot(const std::string& word, const std::filesystem::path& folder) {
  return robot_of_word(word, folder, 0);
}

Robot read_robot_table(TableReader& table, const std::filesystem::path* folder, Robot robot) {
  read_base(table, folder, 0, robot);
  const std::size_t before = table.complaints();
  if (table.has("name")) {
    robot.name = table.text("name").value_or("");
    check_name(table, robot.name, {});
  }
  const bool is_whole = has_all_devices(table);
  read_devices(table, robot);
  table.finish();
  if (table.complaints() == before && table.has("name") && !is_whole) check_own_name(table, robot);
  return robot;
}

void check_with_outline(TableReader& table, const Robot& robot) {
  check_robot(table, robot);
  check_measures(table, robot);
}

std::string own_robot_text(const Robot& robot) {
  return is_rvr(robot) ? "" : text_of(robot_sections(robot, std::string(kTable)));
}

Expected<Robot> parse_own_robot(std::string_view text) {
  if (text.empty()) return rvr();
  const auto document = parse_document(text, "");
  if (!document) return Unexpected(document.error());
  Complaints complaints("");
  TableReader root(*document, "", complaints);
  Robot robot;
  if (auto table = root.table(kTable)) {
    robot = read_robot_table(*table, nullptr, rvr());
  } else if (complaints.empty()) {
    root.complain(kTable, "a robot is a table `[robot]`");
  }
  root.finish();
  if (!complaints.empty()) return Unexpected(complaints.take().front());
  return robot;
}

std::vector<Section> robot_sections(const Robot& robot, const std::string& header) {
  std::vector<Section> sections;
  FieldWriter writer(sections, header);
  writer.add("name", quoted_text(robot.name));
  visit_robot_fields(robot, writer);
  writer.drop_empty();
  return sections;
}

}  // namespace swarmsmith
