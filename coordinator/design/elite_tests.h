#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coordinator/design/plans.h"
#include "irace_core/experiment.h"
#include "storage/rows.h"

namespace swarmsmith {

/// The tests of the elites after the race, outside its budget: which candidates are tested, and on
/// which pairs. Test n is the same for all candidates. Under further profiles, the tests are
/// repeated with the same seeds, so that a design's drop in performance is a paired difference; the
/// numbers of these runs follow those of the tests.
class EliteTests {
 public:
  explicit EliteTests(const DesignPlan& plan);

  /// The numbers of the elites of an iteration that has ended, best first.
  void add_elites(std::vector<std::int64_t> elites) { elites_.push_back(std::move(elites)); }
  /// Configurations to test instead of a race's elites: all of them.
  void test_all(std::vector<std::int64_t> given);

  /// The race is over: selects the candidates to test and returns their runs by candidate.
  std::vector<Experiment> begin();
  /// The run of a candidate on a pair (counted from 1), whether the candidate is tested or not.
  Experiment run(std::int64_t candidate, std::int64_t pair) const;
  /// The purpose of the run on a pair: Test, or Transfer under a further profile.
  Purpose purpose_of(std::int64_t pair) const;
  /// 0: the campaign's profile; otherwise the number of a further profile.
  std::int64_t profile_of(std::int64_t pair) const { return (pair - 1) / plan_.count; }
  /// The name of a further profile.
  const std::string& source_of(std::int64_t pair) const;
  /// The calls of a targetEvaluator for the test runs, one test after another. Their pairs are
  /// those of the tests; negative instances mark test instances.
  std::vector<Experiment> calls() const;

  /// The number of tests.
  std::int64_t count() const { return plan_.count; }
  /// The number of pairs: the tests, repeated under each further profile.
  std::int64_t pairs() const {
    return plan_.count * (1 + static_cast<std::int64_t>(plan_.profiles.size()));
  }
  /// The tested candidates: the last iteration's elites, best first, then those of the others.
  const std::vector<std::int64_t>& tested() const { return tested_; }

 private:
  std::vector<std::int64_t> chosen() const;

  TestPlan plan_;
  std::uint64_t seed_ = 0;  ///< the design's seed
  std::int64_t n_instances_ = 0;
  double bound_ = 0;
  std::vector<std::vector<std::int64_t>> elites_;  ///< of each iteration, best first
  std::vector<std::int64_t> tested_;
};

}  // namespace swarmsmith
