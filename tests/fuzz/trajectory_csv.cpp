#include "sim/mission/trajectory_csv.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// Written as the recordings are, with the columns that every table has.
std::string text_of(const RecordedTrajectory& recorded) {
  std::string text = std::string(kTrajectoryColumns) + std::string(kCsvLineEnd);
  const auto add = [&text](int cycle, int robot, const Pose& pose) {
    append_pose_cells(text, cycle, robot, pose);
    text += kCsvLineEnd;
  };
  int robot = 0;
  for (const Pose& pose : recorded.starts)
    add(0, robot++, pose);
  const auto robots = static_cast<std::size_t>(recorded.trajectory.robots);
  for (std::size_t i = 0; i < recorded.trajectory.poses.size(); ++i) {
    add(static_cast<int>(1 + i / robots), static_cast<int>(i % robots),
        recorded.trajectory.poses[i]);
  }
  return text;
}

}  // namespace

/// Recordings are refused with a line and a reason, or read to one that reads back as the same.
void run(std::string_view input) {
  const auto recorded = parse_trajectory_csv(input);
  if (!recorded) return require_reasons({recorded.error()});
  const auto again = parse_trajectory_csv(text_of(*recorded));
  require(again.has_value() && *again == *recorded, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
