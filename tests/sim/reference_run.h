#pragma once

#include <string>
#include <vector>

#include "sim/control/reference_model.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// Rows of a file of tests/golden/argos, its header left out. Throws when there is no such file.
std::vector<std::vector<std::string>> golden_rows(const std::string& file);

/// The whole text of a file of tests/golden/argos.
std::string golden_text(const std::string& file);

/// One robot in one tick of a recorded run of the original simulator.
struct RecordedTick {
  Pose pose;
  Command command;  ///< computed in this tick
  int state = 0;    ///< after this tick's transition test
  Rgb floor;
  int neighbours = 0;
  std::array<double, kProximitySensors>
      proximity{};  ///< +infinity where the file has 0, nothing hit
};

/// ticks[t][robot]; t = 0 is the start and has no readings.
struct RecordedRun {
  std::string machine;  ///< text of its grammar
  std::vector<std::vector<RecordedTick>> ticks;
};

/// `mission`, `machine` and seed 1 as in the file's name.
RecordedRun recorded_run(const std::string& mission, const std::string& machine);

/// What the robot sees in a tick: recorded readings, neighbours from the recorded poses.
class RecordedSenses final : public Senses {
 public:
  RecordedSenses(const std::vector<RecordedTick>& tick, std::size_t robot);

  ProximityReadings proximity() override { return tick_->proximity; }
  const Rgb& ground_color() override { return tick_->floor; }
  std::span<const Neighbour> neighbours() override { return neighbours_; }
  LightReadings light() override { return light_; }
  double time_s() override { return 0; }

 private:
  const RecordedTick* tick_;
  std::vector<Neighbour> neighbours_;
  std::array<double, kProximitySensors> light_{};
};

}  // namespace swarmsmith
