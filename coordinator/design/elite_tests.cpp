#include "coordinator/design/elite_tests.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

/// As the seeds of irace's pairs (irace facts, 4).
constexpr std::int64_t kLargestSeed = 2'147'483'647;

}  // namespace

EliteTests::EliteTests(const DesignPlan& plan)
    : plan_(plan.tests),
      seed_(static_cast<std::uint64_t>(plan.row.seed)),
      n_instances_(plan.scenario.n_instances),
      bound_(plan.scenario.bound_max) {}

void EliteTests::test_all(std::vector<std::int64_t> given) {
  plan_.elites = static_cast<std::int64_t>(given.size());
  elites_.push_back(std::move(given));
}

/// The seeds of tests come from a separate random stream, so that they coincide with pairs of the
/// race only by chance.
Experiment EliteTests::run(std::int64_t candidate, std::int64_t pair) const {
  SWARMSMITH_ASSERT(plan_.count > 0 && pair >= 1, "tests count from 1");
  SWARMSMITH_ASSERT(plan_.on_test_instances || n_instances_ >= 1, "a test is on an instance");
  // The seed depends on the test alone: all candidates, and all profiles, meet the same random
  // numbers, so their differences are paired.
  const std::int64_t test = (pair - 1) % plan_.count + 1;
  Rng rng = Rng(seed_).split("test", static_cast<std::uint64_t>(test));
  return {.configuration = candidate,
          .pair = pair,
          .instance = plan_.on_test_instances ? test : (test - 1) % n_instances_ + 1,
          .seed = rng.uniform_int(1, kLargestSeed),
          .bound = bound_};
}

Purpose EliteTests::purpose_of(std::int64_t pair) const {
  return pair <= plan_.count ? Purpose::Test : Purpose::Transfer;
}

const std::string& EliteTests::source_of(std::int64_t pair) const {
  SWARMSMITH_ASSERT(pair > plan_.count && pair <= pairs(), "a run under a further profile");
  return plan_.profiles[static_cast<std::size_t>(profile_of(pair) - 1)];
}

std::vector<Experiment> EliteTests::begin() {
  tested_ = chosen();
  std::vector<Experiment> runs;
  for (const std::int64_t candidate : tested_) {
    for (std::int64_t pair = 1; pair <= pairs(); ++pair)
      runs.push_back(run(candidate, pair));
  }
  return runs;
}

std::vector<Experiment> EliteTests::calls() const {
  std::vector<Experiment> calls;
  for (std::int64_t test = 1; test <= plan_.count; ++test) {
    for (const std::int64_t candidate : tested_) {
      Experiment call = run(candidate, test);
      call.instance = -call.instance;
      // Calls are not runs of the target, so no bound of time applies to them.
      call.bound = 0;
      call.is_evaluation = true;
      calls.push_back(call);
    }
  }
  return calls;
}

std::vector<std::int64_t> EliteTests::chosen() const {
  std::vector<std::int64_t> numbers;
  const auto add = [&](const std::vector<std::int64_t>& elites) {
    // Irace facts, 15: testNbElites and testIterationElites; each configuration is tested once.
    const auto most = std::min(elites.size(), static_cast<std::size_t>(plan_.elites));
    for (std::size_t i = 0; i < most; ++i) {
      if (std::ranges::find(numbers, elites[i]) == numbers.end()) numbers.push_back(elites[i]);
    }
  };
  if (elites_.empty()) return numbers;
  // First, so that the best candidate of the whole run is the first one tested.
  add(elites_.back());
  if (!plan_.every_iteration) return numbers;
  for (const auto& elites : elites_)
    add(elites);
  return numbers;
}

}  // namespace swarmsmith
