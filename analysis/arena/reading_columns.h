#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/engine/readings.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Sensor readings of robots as columns of a table; docs/trajectories.md lists the columns.

/// The sensors in a list such as "ground_color,proximity". "all" means every sensor except the
/// lidar, whose 719 columns must be requested by name ("all,lidar"). For an unknown name, the error
/// lists the known ones.
Expected<Sensors> sensors_from_names(std::string_view list);

/// The names of the known sensors, in the order of their columns.
std::vector<std::string> sensor_names();

/// The colours of the five LEDs in one cell, in the order of `Leds`: "#000000 #000000 #ff0000 ...".
std::string leds_text(const Leds& leds);

/// Names and cells of the columns for some sensors.
class ReadingColumns {
 public:
  /// For a swarm of `robots` robots: each robot has a column for each other robot that it may see.
  /// The column names depend on the robot's sensors.
  ReadingColumns(Sensors sensors, int robots, const Robot& robot);

  const std::vector<std::string>& names() const { return names_; }

  /// Appends ",cell" for each column. Cells without a reading are empty (`readings` is null, or
  /// there are fewer neighbours than columns).
  void append_cells(std::string& line, const Readings* readings) const;

 private:
  Sensors sensors_;
  std::vector<std::string> names_;
  std::vector<std::size_t> widths_;  ///< number of columns of each sensor, in the sensors' order
};

}  // namespace swarmsmith
