#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/sim/engine/reference_data.h"
#include "tests/sim/engine/reference_runs.h"

namespace swarmsmith {
namespace {

std::string text_of(const std::string& id) {
  for (const ReferenceMachine& machine : reference_machines()) {
    if (machine.id == id) return machine.text;
  }
  throw std::runtime_error("no machine " + id);
}

/// Of 600 runs without random draws (two machines, three missions, seeds 1..100), those with the
/// original's score. Means forgive a wrong wall or a wrong order of integration; this does not.
int equal_runs(ContactModel contacts) {
  const ReferenceScores scores = reference_scores();
  int equal = 0;
  for (const ReferenceMission& mission : kReferenceMissions) {
    ReferenceRuns runs(mission.ours);
    runs.profile.contacts = contacts;
    // The original prints six digits.
    const double tolerance = std::string(mission.theirs) == "grid" ? 0.6 : 0.01;
    for (const char* id : {"hG5", "r21"}) {
      const Machine machine = machine_of(text_of(id));
      for (const auto& [seed, score] : scores.at(mission.theirs).at(id)) {
        equal += std::fabs(runs.run(machine, seed).score - score) < tolerance ? 1 : 0;
      }
    }
  }
  std::printf("equal scores: %d of 600\n", equal);
  return equal;
}

TEST(SeedBySeed, TheExactSolverGivesTheOriginalsScores) {
  EXPECT_GE(equal_runs(ContactModel::Exact), 574);
}

TEST(SeedBySeed, Box2dGivesTheOriginalsScores) {
  EXPECT_GE(equal_runs(ContactModel::Box2d), 565);
}

}  // namespace
}  // namespace swarmsmith
