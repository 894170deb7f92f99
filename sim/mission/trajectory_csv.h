#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/trajectory.h"

namespace swarmsmith {

/// A trajectory as a table (docs/trajectories.md): one row per robot and instant, in the order of
/// the instants, and within an instant the robots 0, 1, ...; further columns may follow. A
/// simulator's recording and a camera's measurement have the same format.

/// The columns that every such table has: number of the instant in steps of 0.1 s (0 is the start),
/// its time, the robot, its pose in metres and radians.
inline constexpr std::string_view kTrajectoryColumns = "cycle,time_s,robot,x,y,theta";

/// End of line, as in all tables; `parse_trajectory_csv` also accepts CR LF.
inline constexpr std::string_view kCsvLineEnd = "\n";

/// Appends the cells of `kTrajectoryColumns`, without a comma or an end of line after them.
void append_pose_cells(std::string& line, int cycle, int robot, const Pose& pose);

/// Appends the shortest form that reads back to the same bits; `inf` and `-inf` for infinities.
void append_number(std::string& line, double value);

/// The content of such a table, without its further columns.
struct RecordedTrajectory {
  std::vector<Pose> starts;  ///< poses of instant 0; empty when the table begins with instant 1
  Trajectory trajectory;     ///< the instants from 1 on

  friend bool operator==(const RecordedTrajectory&, const RecordedTrajectory&) = default;
};

/// Reads the columns cycle, robot, x, y and theta, at any position; cells must not be quoted. The
/// instants must be complete: from 0 or 1 without a gap, each with all robots in order. `where` of
/// an error is "line 12".
Expected<RecordedTrajectory> parse_trajectory_csv(std::string_view text);

}  // namespace swarmsmith
