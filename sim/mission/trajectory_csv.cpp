#include "sim/mission/trajectory_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <type_traits>
#include <vector>

#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 5> kRead = {"cycle", "robot", "x", "y", "theta"};
using Cells = std::vector<std::string>;

std::string line_place(std::size_t line) {
  return "line " + std::to_string(line);
}

/// Positions in the header of the columns to read.
using Places = std::array<std::size_t, kRead.size()>;

Expected<Places> find_columns(const Cells& names) {
  Places places{};
  for (std::size_t i = 0; i < kRead.size(); ++i) {
    const auto found = std::ranges::find(names, kRead[i]);
    if (found == names.end()) {
      return bad_input("a trajectory has the columns " + std::string(kTrajectoryColumns) +
                           "; there is no `" + std::string(kRead[i]) + "`",
                       line_place(1));
    }
    places[i] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

template <class Number>
Expected<Number> number_of(std::string_view cell, std::size_t column, std::size_t line) {
  Number value{};
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  bool good = error == std::errc() && stop == cell.data() + cell.size();
  if constexpr (std::is_floating_point_v<Number>) good = good && std::isfinite(value);
  if (good) return value;
  const char* const wanted = std::is_floating_point_v<Number> ? "a finite number" : "an integer";
  return bad_input("column " + std::string(kRead[column]) + " must be " + wanted + ", not `" +
                       std::string(cell) + "`",
                   line_place(line));
}

/// Takes rows in their order and checks that none is missing.
class Collector {
 public:
  Expected<void> add(int cycle, int robot, const Pose& pose, std::size_t line) {
    // The first row decides whether the file has the starts (cycle 0).
    if (rows_ == 0 && (cycle == 0 || cycle == 1)) cycle_ = cycle;
    const bool next_instant = robot == 0 && rows_ > 0 && cycle == cycle_ + 1;
    if (next_instant) {
      if (robots_ == 0) robots_ = robot_;
      if (robot_ != robots_) return incomplete(line);
      ++cycle_;
      robot_ = 0;
    }
    if (cycle != cycle_ || robot != robot_ || (robots_ > 0 && robot >= robots_)) {
      return bad_input("expected robot " + std::to_string(robot_) + " of cycle " +
                           std::to_string(cycle_) +
                           " (rows are in the order of cycles, from 0 or 1, and of robots, "
                           "from 0), found robot " +
                           std::to_string(robot) + " of cycle " + std::to_string(cycle),
                       line_place(line));
    }
    (cycle == 0 ? result_.starts : result_.trajectory.poses).push_back(pose);
    ++robot_;
    ++rows_;
    return {};
  }

  Expected<RecordedTrajectory> finish(std::size_t line) {
    if (robots_ == 0) robots_ = robot_;
    if (robot_ != robots_) return incomplete(line);
    result_.trajectory.robots = robots_;
    return std::move(result_);
  }

 private:
  Unexpected incomplete(std::size_t line) const {
    return bad_input("cycle " + std::to_string(cycle_) + " has " + counted(robot_, "robot") +
                         ", the one before it " + std::to_string(robots_),
                     line_place(line));
  }

  RecordedTrajectory result_;
  std::int64_t rows_ = 0;
  int cycle_ = 0;   ///< the cycle that is being read
  int robot_ = 0;   ///< the next robot of this cycle
  int robots_ = 0;  ///< number per cycle; 0 until the first cycle is complete
};

}  // namespace

void append_number(std::string& line, double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  line.append(buffer.data(), end);
}

void append_pose_cells(std::string& line, int cycle, int robot, const Pose& pose) {
  line += std::to_string(cycle) + ",";
  // A division, because 3 * 0.1 is not the double nearest to 0.3.
  append_number(line, static_cast<double>(cycle) / 10);
  line += "," + std::to_string(robot);
  for (const double value : {pose.x, pose.y, pose.theta}) {
    line += ',';
    append_number(line, value);
  }
}

Expected<RecordedTrajectory> parse_trajectory_csv(std::string_view text) {
  CsvReader reader(text);
  const Expected<Places> places = find_columns(reader.next().value_or(Cells()));
  if (!places) return Unexpected(places.error());
  Collector collector;
  std::size_t line = 1;
  while (!reader.at_end()) {
    line = reader.line();
    const Cells cells = reader.next().value_or(Cells());
    if (cells.size() <= std::ranges::max(*places)) {
      return bad_input("the line is too short", line_place(line));
    }
    const auto cycle = number_of<int>(cells[(*places)[0]], 0, line);
    if (!cycle) return Unexpected(cycle.error());
    const auto robot = number_of<int>(cells[(*places)[1]], 1, line);
    if (!robot) return Unexpected(robot.error());
    std::array<double, 3> pose{};
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const auto value = number_of<double>(cells[(*places)[2 + i]], 2 + i, line);
      if (!value) return Unexpected(value.error());
      pose[i] = *value;
    }
    const auto added = collector.add(*cycle, *robot, {pose[0], pose[1], pose[2]}, line);
    if (!added) return Unexpected(added.error());
  }
  return collector.finish(line);
}

}  // namespace swarmsmith
