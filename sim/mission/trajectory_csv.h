#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/mission/trajectory.h"

namespace swarmsmith {

/// A trajectory as a table (docs/trajectories.md): one row a robot and instant, in the order of the
/// instants, in each the robots 0, 1, ...; further columns may follow. A simulator's recording and
/// a camera's measurement have the same form.

/// The columns that every such table has: instant of 0.1 s (0 is the start), its time, the robot,
/// its pose in metres and radians.
inline constexpr std::string_view kTrajectoryColumns = "cycle,time_s,robot,x,y,theta";

/// End of lines, as in all tables; `parse_trajectory_csv` takes CR LF as well.
inline constexpr std::string_view kCsvLineEnd = "\n";

/// Appends the cells of `kTrajectoryColumns`, without a comma or an end of line behind them.
void append_pose_cells(std::string& line, int cycle, int robot, const Pose& pose);

/// Appends the shortest form that reads back to the same bits; `inf` and `-inf` for infinities.
void append_number(std::string& line, double value);

/// What such a table holds, its further columns left out.
struct RecordedTrajectory {
  std::vector<Pose> starts;  ///< poses of instant 0; empty when the table begins with instant 1
  Trajectory trajectory;     ///< the instants from 1 on

  friend bool operator==(const RecordedTrajectory&, const RecordedTrajectory&) = default;
};

/// Reads the columns cycle, robot, x, y and theta, wherever they stand; cells are not quoted. The
/// instants must be complete: from 0 or 1 on without a gap, in each all robots in order. `where`
/// of an error is "line 12".
Expected<RecordedTrajectory> parse_trajectory_csv(std::string_view text);

}  // namespace swarmsmith
