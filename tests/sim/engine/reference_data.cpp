#include "tests/sim/engine/reference_data.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim/mission/instance_csv.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using Row = std::vector<std::string>;

template <class T>
T value_of(Expected<T> value) {
  if (!value) throw std::runtime_error(to_string(value.error()));
  return std::move(*value);
}

std::string text_of(const std::string& file) {
  return whole_file(SWARMSMITH_TEST_DATA "/argos/" + file);
}

/// Rows of a comma-separated file without its header. No field of these files is quoted.
std::vector<Row> rows_of(const std::string& file) {
  std::istringstream in(text_of(file));
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
      row.push_back(field);
  }
  return rows;
}

ReferenceScores scores_of(const std::string& file) {
  ReferenceScores scores;
  for (const Row& row : rows_of(file)) {
    const double sign = row[0] == "grid" ? -1 : 1;
    scores[row[0]][row[1]][std::stoi(row[2])] = sign * std::stod(row[3]);
  }
  return scores;
}

std::uint8_t channel(const std::string& text) {
  return static_cast<std::uint8_t>(std::stoi(text));
}

}  // namespace

LoggedRun logged_run(const std::string& name) {
  LoggedRun run;
  for (const Row& row : rows_of("argos-traj-" + name + ".csv")) {
    const auto tick = static_cast<std::size_t>(std::stoul(row.at(0)));
    if (tick == run.size()) run.emplace_back();
    LoggedTick& logged = run.at(tick).at(std::stoul(row[1]));
    logged.pose = {std::stod(row[2]), std::stod(row[3]), std::stod(row[4])};
    logged.left_cmps = std::stod(row[5]);
    logged.right_cmps = std::stod(row[6]);
    logged.floor = {channel(row[8]), channel(row[9]), channel(row[10])};
    logged.neighbours = std::stoi(row[11]);
    for (std::size_t i = 0; i < logged.proximity.size(); ++i) {
      logged.proximity[i] = std::stod(row.at(12 + i));
    }
  }
  return run;
}

std::vector<ReferenceMachine> reference_machines() {
  std::vector<ReferenceMachine> machines;
  for (const Row& row : rows_of("argos-fsms.csv"))
    machines.push_back({row.at(0), "", row.at(1)});
  return machines;
}

std::vector<ReferenceMachine> thesis_designs() {
  std::vector<ReferenceMachine> machines;
  for (const Row& row : rows_of("argos-thesis-designs.csv")) {
    machines.push_back({row.at(0), row.at(1), row.at(2)});
  }
  return machines;
}

ReferenceScores reference_scores() {
  return scores_of("argos-scores.csv");
}

ReferenceScores thesis_scores() {
  return scores_of("argos-thesis-scores.csv");
}

std::vector<Instance> reference_instances(const Mission& mission) {
  const ExplicitInstances given = {value_of(parse_starts_csv(text_of("argos-starts.csv"))),
                                   value_of(parse_patches_csv(text_of("argos-patches.csv")))};
  std::vector<Instance> instances;
  for (int seed = 1; seed <= 100; ++seed) {
    instances.push_back(value_of(instance_of(mission, seed, given)));
  }
  return instances;
}

}  // namespace swarmsmith
