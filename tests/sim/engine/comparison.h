#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/sim/engine/reference_data.h"
#include "tests/sim/engine/reference_runs.h"

namespace swarmsmith {

/// Ours beside the original's, paired by seed: what the fidelity tests assert and docs/fidelity.md
/// shows.

/// Difference of paired means.
struct Comparison {
  double ours = 0;
  double theirs = 0;
  double difference = 0;
  double half_width = 0;  ///< of the 99 % interval of the difference
  double z = 0;

  bool holds_zero() const { return difference <= half_width && -difference <= half_width; }
};
Comparison compare(const std::vector<double>& ours, const std::vector<double>& theirs);

/// Rank correlation after Spearman; equal values share their mean rank.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// One machine on one mission.
struct MachineComparison {
  std::string id;
  Comparison scores;
  double equal_share = 0;      ///< of the pairs, those with the original's score
  std::vector<double> ours;    ///< by seed, mean of the streams
  std::vector<double> theirs;  ///< by seed
};

/// `scores` are the original's by seed; ours are averaged over `streams` of control draws a seed.
MachineComparison compare_machine(const ReferenceRuns& runs, const ReferenceMachine& machine,
                                  const std::map<int, double>& scores, int streams);

/// The twenty machines on one mission.
struct MissionComparison {
  std::vector<MachineComparison> machines;
  int misses = 0;  ///< intervals that do not hold 0
  double mean_z2 = 0;
  double rank_correlation = 0;  ///< of the machines' means
};
MissionComparison compare_reference_machines(const ReferenceMission& mission, ContactModel contacts,
                                             int streams);

/// The thesis' ten designs of one mission; `all` pairs the seeds' means over the ten.
struct DesignsComparison {
  std::vector<MachineComparison> designs;
  Comparison all;
};
DesignsComparison compare_thesis_designs(const ReferenceMission& mission, ContactModel contacts,
                                         int streams);

/// Of 600 runs without random draws (hG5 and r21, three missions, seeds 1 to 100), those with the
/// original's score. Means forgive a wrong wall or a wrong order of integration; this does not.
int seed_exact_runs(ContactModel contacts);

}  // namespace swarmsmith
