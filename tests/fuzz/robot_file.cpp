#include "sim/files/robot_file.h"

#include "tests/fuzz/printed_table.h"

namespace swarmsmith::fuzz {

/// Robots in a folder that is not there, so that no base is a file: refused with reasons and
/// places, or read to one whose text reads back as the same.
void run(std::string_view input) {
  const auto robot = parse_robot(input, "/no-such-folder/mine.toml");
  if (!robot) return require_reasons(robot.error());
  const Robot again = read_printed(text_of(robot_sections(*robot, "robot")), [](TableReader& root) {
    auto table = root.table("robot");
    require(table.has_value(), "the robot is in its table");
    return read_robot_table(*table, nullptr, rvr());
  });
  require(again == *robot, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
