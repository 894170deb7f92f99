#include "sim/files/robot_file.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// The robot in a [robot] table that `robot_sections` has written.
Robot robot_in(const std::string& text) {
  const auto document = parse_document(text, "printed.toml");
  require(document.has_value(), "what is printed is TOML");
  Complaints complaints("printed.toml");
  TableReader root(*document, "", complaints);
  auto table = root.table("robot");
  require(table.has_value(), "the robot is in its table");
  Robot robot = read_robot_table(*table, nullptr, rvr());
  require(complaints.empty(), "what is printed can be read");
  return robot;
}

}  // namespace

/// Robots in a folder that is not there, so that no base is a file: refused with reasons and
/// places, or read to one whose text reads back as the same.
void run(std::string_view input) {
  const auto robot = parse_robot(input, "/no-such-folder/mine.toml");
  if (!robot) {
    return require_reasons(robot.error());
  }
  require(robot_in(text_of(robot_sections(*robot, "robot"))) == *robot,
          "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
