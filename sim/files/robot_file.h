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

/// Robots as TOML (docs/robots.md). The built-in ones are files, too, which the program carries:
/// `rvr` (the thesis') and `epuck` (the DEMIURGE project's).

std::vector<std::string> robot_names();

/// The file of a built-in robot, comments included; empty for an unknown name.
std::string_view built_in_robot_text(std::string_view name);

/// A robot, or everything that is wrong with its file: `where` is file:line:column.
using RobotOrErrors = tl::expected<Robot, std::vector<Error>>;

/// `word` is the name of a built-in robot, or a file: what ends in .toml, or has a slash; relative
/// to `folder`.
RobotOrErrors find_robot(const std::string& word, const std::filesystem::path& folder);

/// A robot as the text of a file, which gives its name as for profiles and is not read.
RobotOrErrors parse_robot(std::string_view text, const std::filesystem::path& file);

/// The keys of a robot in a table of another file: a `base` in place of `robot`, which may be a
/// file where `folder` is given, a `name`, and what is other than the base's. What is wrong goes to
/// the table's complaints.
Robot read_robot_table(TableReader& table, const std::filesystem::path* folder, Robot robot);

/// Complains of what does not go together in a robot whose outline a mission has changed; an RVR
/// keeps its devices with any outline.
void check_with_outline(TableReader& table, const Robot& robot);

/// All fields as lines; `header` is the name of the table they are in, "mission.robot".
std::vector<Section> robot_sections(const Robot& robot, const std::string& header);

}  // namespace swarmsmith
