#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coordinator/design/plans.h"
#include "irace_core/experiment.h"
#include "storage/rows.h"

namespace swarmsmith {

/// How the elites are judged after the race, outside of its budget: who is tested, and on what. The
/// tests of one number are the same for all who are tested. Under further profiles the tests are
/// run again, on the same seeds, so that a design's drop is a paired difference; these runs are
/// numbered on from the tests.
class EliteTests {
 public:
  explicit EliteTests(const DesignPlan& plan);

  /// Of an iteration that ended, best first, by number.
  void add_elites(std::vector<std::int64_t> elites) { elites_.push_back(std::move(elites)); }
  /// Configurations that are tested in place of a race's elites: all of them.
  void test_all(std::vector<std::int64_t> given);

  /// The race is over: chooses who is tested and gives their runs, one candidate after the other.
  std::vector<Experiment> begin();
  /// The run of a candidate on a pair from 1, tested or not.
  Experiment run(std::int64_t candidate, std::int64_t pair) const;
  /// Of the run on a pair: Test, or Transfer under a further profile.
  Purpose purpose_of(std::int64_t pair) const;
  /// 0: the campaign's profile; else the number of a further one.
  std::int64_t profile_of(std::int64_t pair) const { return (pair - 1) / plan_.count; }
  /// The name of a further profile.
  const std::string& source_of(std::int64_t pair) const;
  /// The calls of a targetEvaluator on the runs, one test after the other. Their pairs are those of
  /// the tests; negative instances tell that they are test instances.
  std::vector<Experiment> calls() const;

  /// How many tests there are.
  std::int64_t count() const { return plan_.count; }
  /// How many pairs: the tests, and again under each further profile.
  std::int64_t pairs() const {
    return plan_.count * (1 + static_cast<std::int64_t>(plan_.profiles.size()));
  }
  /// Who is tested: the last iteration's elites, best first, then those of the others.
  const std::vector<std::int64_t>& tested() const { return tested_; }

 private:
  std::vector<std::int64_t> chosen() const;

  TestPlan plan_;
  std::uint64_t seed_ = 0;  ///< of the design
  std::int64_t n_instances_ = 0;
  double bound_ = 0;
  std::vector<std::vector<std::int64_t>> elites_;  ///< of each iteration, best first
  std::vector<std::int64_t> tested_;
};

}  // namespace swarmsmith
