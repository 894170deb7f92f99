#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/engine/readings.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Readings of robots as columns of a table; docs/trajectories.md lists them.

/// The sensors of a list such as "ground_color,proximity"; "all" is every one but the lidar, whose
/// 719 columns must be asked for by name ("all,lidar"). An unknown name is an error that lists the
/// known ones.
Expected<Sensors> sensors_from_names(std::string_view list);

/// The names of the known sensors, in the order of their columns.
std::vector<std::string> sensor_names();

/// What the five LEDs show, "#000000 #000000 #ff0000 ...": one cell, in the order of `Leds`.
std::string leds_text(const Leds& leds);

/// Names and cells of the columns of some sensors.
class ReadingColumns {
 public:
  /// A swarm of so many robots: each has a column for each other one that it may see. Names say
  /// what the robot's sensors give.
  ReadingColumns(Sensors sensors, int robots, const Robot& robot);

  const std::vector<std::string>& names() const { return names_; }

  /// Appends ",cell" for each column; empty cells where there is no reading (`readings` null, or
  /// fewer neighbours than columns).
  void append_cells(std::string& line, const Readings* readings) const;

 private:
  Sensors sensors_;
  std::vector<std::string> names_;
  std::vector<std::size_t> widths_;  ///< columns of each sensor, in their order
};

}  // namespace swarmsmith
