#include "tests/sim/reference_run.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

constexpr double kPerception_m = 0.75;

std::uint8_t channel(const std::string& text) {
  return static_cast<std::uint8_t>(std::stoi(text));
}

RecordedTick tick_of(const std::vector<std::string>& row) {
  RecordedTick tick;
  tick.pose = {std::stod(row.at(2)), std::stod(row[3]), std::stod(row[4])};
  tick.command = {std::stod(row[5]) / 100, std::stod(row[6]) / 100};
  tick.state = std::stoi(row[7]);
  tick.floor = {channel(row[8]), channel(row[9]), channel(row[10])};
  tick.neighbours = std::stoi(row[11]);
  for (std::size_t i = 0; i < tick.proximity.size(); ++i) {
    const double reading = std::stod(row.at(12 + i));
    tick.proximity[i] = reading == 0 ? std::numeric_limits<double>::infinity() : reading;
  }
  return tick;
}

}  // namespace

std::string golden_text(const std::string& file) {
  return whole_file(SWARMSMITH_TEST_DATA "/argos/" + file);
}

std::vector<std::vector<std::string>> golden_rows(const std::string& file) {
  std::istringstream in(golden_text(file));
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<std::string>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      row.push_back(cell);
  }
  return rows;
}

RecordedRun recorded_run(const std::string& mission, const std::string& machine) {
  RecordedRun run;
  for (const auto& row : golden_rows("argos-fsms.csv")) {
    if (row.at(0) == machine) run.machine = row.at(1);
  }
  for (const auto& row : golden_rows("argos-traj-" + mission + "-" + machine + "-seed1.csv")) {
    const auto tick = static_cast<std::size_t>(std::stoul(row.at(0)));
    if (tick == run.ticks.size()) run.ticks.emplace_back();
    run.ticks.at(tick).push_back(tick_of(row));
  }
  return run;
}

RecordedSenses::RecordedSenses(const std::vector<RecordedTick>& tick, std::size_t robot)
    : tick_(&tick.at(robot)) {
  for (std::size_t other = 0; other < tick.size(); ++other) {
    const double dx = tick[other].pose.x - tick_->pose.x;
    const double dy = tick[other].pose.y - tick_->pose.y;
    const double distance = std::hypot(dx, dy);
    if (other == robot || distance >= kPerception_m) continue;
    const double bearing = std::atan2(dy, dx) - tick_->pose.theta;
    neighbours_.push_back({distance, std::cos(bearing), std::sin(bearing)});
  }
}

}  // namespace swarmsmith
