#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Robots as TOML (docs/robots.md). The built-in robots are such files, too, embedded in the
/// program: `rvr` (the robot of the thesis) and `epuck` (the robot of the DEMIURGE project).

std::vector<std::string> robot_names();

/// The file of a built-in robot, comments included; empty for an unknown name.
std::string_view built_in_robot_text(std::string_view name);

/// A robot, or all errors in its file; `where` of each is file:line:column.
using RobotOrErrors = tl::expected<Robot, std::vector<Error>>;

/// `word` is the name of a built-in robot or a file: a word that ends in .toml or contains a slash
/// is a file, relative to `folder`.
RobotOrErrors find_robot(const std::string& word, const std::filesystem::path& folder);

/// Parses a robot from the text of a file. `file` gives the names as for profiles; it is not
/// opened.
RobotOrErrors parse_robot(std::string_view text, const std::filesystem::path& file);

/// Reads the keys of a robot from a table of another file: a `base` that replaces `robot` and may
/// be a file if `folder` is given, a `name`, and the fields that differ from the base. Errors are
/// added to the table's complaints.
Robot read_robot_table(TableReader& table, const std::filesystem::path* folder, Robot robot);

/// Checks a robot whose outline was changed by a mission: whether its devices fit the outline.
void check_with_outline(TableReader& table, const Robot& robot);

/// The text that carries a robot in messages and logs: all its fields, or nothing for an RVR, with
/// any outline. An error names no file.
std::string own_robot_text(const Robot& robot);
Expected<Robot> parse_own_robot(std::string_view text);

/// All fields as lines; `header` is the name of the table that holds them, such as "mission.robot".
std::vector<Section> robot_sections(const Robot& robot, const std::string& header);

}  // namespace swarmsmith
