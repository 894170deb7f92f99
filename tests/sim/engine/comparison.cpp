#include "tests/sim/engine/comparison.h"

#include <cmath>

namespace swarmsmith {
namespace {

/// 99.5 % quantile of the standard normal distribution.
constexpr double kZ99 = 2.5758293035489004;

/// The original prints six digits.
bool equal(double ours, double theirs, const ReferenceRuns& runs) {
  return std::fabs(ours - theirs) < (runs.mission.name == "grid_exploration" ? 0.6 : 0.01);
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) {
    double rank = 0.5;
    for (const double other : values)
      rank += other < value ? 1 : other == value ? 0.5 : 0;
    result.push_back(rank);
  }
  return result;
}

ReferenceRuns runs_of(const ReferenceMission& mission, ContactModel contacts) {
  ReferenceRuns runs(mission.ours);
  runs.profile.contacts = contacts;
  return runs;
}

}  // namespace

Comparison compare(const std::vector<double>& ours, const std::vector<double>& theirs) {
  Comparison result;
  const auto n = static_cast<double>(ours.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    result.ours += ours[i] / n;
    result.theirs += theirs.at(i) / n;
  }
  result.difference = result.ours - result.theirs;
  double squares = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double rest = ours[i] - theirs[i] - result.difference;
    squares += rest * rest;
  }
  const double error = std::sqrt(squares / (n - 1) / n);
  result.half_width = kZ99 * error;
  result.z = error > 0 ? result.difference / error : 0;
  return result;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ra = ranks(a);
  const std::vector<double> rb = ranks(b);
  const double mean = (static_cast<double>(a.size()) + 1) / 2;
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (ra[i] - mean) * (rb[i] - mean);
    aa += (ra[i] - mean) * (ra[i] - mean);
    bb += (rb[i] - mean) * (rb[i] - mean);
  }
  return ab / std::sqrt(aa * bb);
}

MachineComparison compare_machine(const ReferenceRuns& runs, const ReferenceMachine& machine,
                                  const std::map<int, double>& scores, int streams) {
  MachineComparison result{.id = machine.id, .scores = {}, .ours = {}, .theirs = {}};
  const Machine parsed = machine_of(machine.text);
  int equal_pairs = 0;
  for (const auto& [seed, theirs] : scores) {
    double sum = 0;
    for (int stream = 0; stream < streams; ++stream) {
      const double ours = runs.run(parsed, seed, stream).score;
      equal_pairs += equal(ours, theirs, runs) ? 1 : 0;
      sum += ours;
    }
    result.ours.push_back(sum / streams);
    result.theirs.push_back(theirs);
  }
  result.scores = compare(result.ours, result.theirs);
  result.equal_share = equal_pairs / (static_cast<double>(scores.size()) * streams);
  return result;
}

MissionComparison compare_reference_machines(const ReferenceMission& mission, ContactModel contacts,
                                             int streams) {
  const ReferenceScores scores = reference_scores();
  const ReferenceRuns runs = runs_of(mission, contacts);
  MissionComparison result{.machines = {}};
  std::vector<double> our_means;
  std::vector<double> their_means;
  for (const ReferenceMachine& machine : reference_machines()) {
    result.machines.push_back(
        compare_machine(runs, machine, scores.at(mission.theirs).at(machine.id), streams));
    const Comparison& row = result.machines.back().scores;
    result.misses += row.holds_zero() ? 0 : 1;
    result.mean_z2 += row.z * row.z;
    our_means.push_back(row.ours);
    their_means.push_back(row.theirs);
  }
  result.mean_z2 /= static_cast<double>(result.machines.size());
  result.rank_correlation = rank_correlation(our_means, their_means);
  return result;
}

DesignsComparison compare_thesis_designs(const ReferenceMission& mission, ContactModel contacts,
                                         int streams) {
  const ReferenceScores scores = thesis_scores();
  const ReferenceRuns runs = runs_of(mission, contacts);
  DesignsComparison result{.designs = {}, .all = {}};
  for (const ReferenceMachine& design : thesis_designs()) {
    const auto of_mission = scores.find(mission.theirs);
    if (of_mission == scores.end() || !of_mission->second.contains(design.id)) continue;
    result.designs.push_back(
        compare_machine(runs, design, of_mission->second.at(design.id), streams));
  }
  // By seed, over the ten designs: designs share the starts of a seed.
  const std::size_t seeds = result.designs.at(0).ours.size();
  std::vector<double> ours(seeds);
  std::vector<double> theirs(seeds);
  const auto n = static_cast<double>(result.designs.size());
  for (const MachineComparison& design : result.designs) {
    for (std::size_t i = 0; i < seeds; ++i) {
      ours[i] += design.ours.at(i) / n;
      theirs[i] += design.theirs.at(i) / n;
    }
  }
  result.all = compare(ours, theirs);
  return result;
}

int seed_exact_runs(ContactModel contacts) {
  const ReferenceScores scores = reference_scores();
  int equal_runs = 0;
  for (const ReferenceMission& mission : kReferenceMissions) {
    const ReferenceRuns runs = runs_of(mission, contacts);
    for (const ReferenceMachine& machine : reference_machines()) {
      if (machine.id != "hG5" && machine.id != "r21") continue;
      const Machine parsed = machine_of(machine.text);
      for (const auto& [seed, score] : scores.at(mission.theirs).at(machine.id))
        equal_runs += equal(runs.run(parsed, seed).score, score, runs) ? 1 : 0;
    }
  }
  return equal_runs;
}

}  // namespace swarmsmith
