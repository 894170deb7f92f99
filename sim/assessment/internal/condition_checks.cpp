#include "sim/assessment/internal/condition_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/assessment/internal/statistics.h"

namespace swarmsmith::assessment {
namespace {

constexpr int kExploring = 0;

/// Exploration until the condition fires, then Stop for good.
Machine one_way(const Condition& condition) {
  return {{{Exploration{kTau}, {{condition, 1}}}, {Stop{}, {}}}};
}

/// What happened in one run.
struct FloorRun {
  int fired = 0;   ///< robots whose condition fired when it had to
  int missed = 0;  ///< tested cycles in which it had to fire, and did not
  int wrong = 0;   ///< firings without a reason
};

/// What happened in all runs.
struct FloorRuns {
  std::array<FloorRun, kConditionRuns> runs;
  int met = 0;        ///< tested cycles of exploring robots over the floor that is waited for
  int elsewhere = 0;  ///< firings over another floor, by a reading that satisfied
};

FloorRuns run_over_floor(const ConditionTest& test, const Machine& machine, const Flavour& flavour,
                         const Profile& profile) {
  FloorRuns all;
  for_each_cycle(test, machine, flavour, profile, [&](const ObservedCycle& cycle) {
    FloorRun& run = all.runs[static_cast<std::size_t>(cycle.seed - 1)];
    const bool exploring = cycle.state == kExploring && cycle.tested;
    const bool due =
        exploring && satisfies(test, cycle.record.readings->ground_color, flavour.floor);
    const Point place = ground_sensor_place(cycle.record.pose);
    const bool over = exploring && floor_at(test.arena, place) == test.wanted;
    run.fired += due && cycle.fired ? 1 : 0;
    run.missed += due && !cycle.fired ? 1 : 0;
    run.wrong += !due && cycle.fired ? 1 : 0;
    all.met += over ? 1 : 0;
    all.elsewhere += due && cycle.fired && !over ? 1 : 0;
  });
  return all;
}

std::string text_of(Rgb color) {
  return fmt::format("{}, {}, {}", color.r, color.g, color.b);
}

/// Without noise, the flavour must take the wanted floor and no other of the arena for what the
/// condition waits for; what it does not, as a sentence.
std::string misread_floor(const ConditionTest& test, const FloorModel& floor) {
  if (test.trigger == Trigger::Always) return {};
  if (!satisfies(test, test.wanted, floor)) {
    return fmt::format("the flavour's numbers do not take the {} ({}) for it", test.floor,
                       text_of(test.wanted));
  }
  std::vector<Rgb> colors = {test.arena.floor};
  for (const Patch& patch : test.arena.patches)
    colors.push_back(patch.color);
  for (const Rgb& color : colors) {
    if (color == test.wanted || !satisfies(test, color, floor)) continue;
    return fmt::format("the flavour's numbers also take the floor {} for it", text_of(color));
  }
  return {};
}

/// Why it fails, or what else a person should know.
std::string note_about(const ConditionTest& test, const FloorRuns& all, const FloorModel& floor) {
  std::string misread = misread_floor(test, floor);
  if (!misread.empty()) return misread;
  FloorRun sum;
  int untested = 0;
  for (const FloorRun& run : all.runs) {
    sum.fired += run.fired;
    sum.missed += run.missed;
    sum.wrong += run.wrong;
    untested += run.fired + run.missed == 0 ? 1 : 0;
  }
  if (sum.missed + sum.wrong > 0) {
    return fmt::format("did not fire in {} cycles in which it had to, fired in {} without a reason",
                       sum.missed, sum.wrong);
  }
  if (untested > 0) {
    const std::string found =
        fmt::format("in {} of {} runs no reading satisfied it", untested, kConditionRuns);
    if (all.met == 0) return found + ", since no robot came to the " + test.floor;
    return fmt::format(
        "{}; robots were over the {} in {} tested cycles: the ground sensor of the profile reads "
        "it as something else",
        found, test.floor, all.met);
  }
  if (all.elsewhere == 0) return {};
  return fmt::format(
      "{} of {} firings were not over the {}: the ground sensor of the profile "
      "reads other floor for it now and then",
      all.elsewhere, sum.fired, test.floor);
}

Check check_floor(const ConditionTest& test, const Machine& machine, const Flavour& flavour,
                  const Profile& profile) {
  const FloorRuns all = run_over_floor(test, machine, flavour, profile);
  std::vector<double> fired;
  int good = 0;
  for (const FloorRun& run : all.runs) {
    fired.push_back(run.fired);
    good += run.fired > 0 && run.missed == 0 && run.wrong == 0 ? 1 : 0;
  }
  return {.setting = test.floor + ", p = 1",
          .runs = kConditionRuns,
          .quantity = "robots_fired",
          .values = fired,
          .passes = good == kConditionRuns && misread_floor(test, flavour.floor).empty(),
          .measured = fmt::format("{} of {} as expected", good, kConditionRuns),
          .expected = fmt::format("{} of {}", kConditionRuns, kConditionRuns),
          .note = note_about(test, all, flavour.floor)};
}

/// With eta = 0 the sigmoid is one half whatever the number of neighbours: one firing a robot.
Check check_count(const ConditionTest& test, const Machine& machine, const Flavour& flavour,
                  const Profile& profile) {
  std::array<std::array<int, kRobots>, kConditionRuns> tests{};
  for_each_cycle(test, machine, flavour, profile, [&](const ObservedCycle& cycle) {
    if (cycle.state != kExploring || !cycle.tested) return;
    ++tests[static_cast<std::size_t>(cycle.seed - 1)][static_cast<std::size_t>(cycle.robot)];
  });
  std::vector<double> waits;
  for (const auto& run : tests)
    waits.insert(waits.end(), run.begin(), run.end());
  const double chi_square = geometric_chi_square(waits);
  return {.setting = "eta = 0, xi = 1",
          .runs = kConditionRuns,
          .quantity = "tested_cycle_that_fired",
          .values = waits,
          .passes = chi_square <= kChiSquare3At1Percent,
          .measured = fmt::format("chi-square {:.2f}", chi_square),
          .expected = fmt::format("at most {:.2f}", kChiSquare3At1Percent),
          .note = {}};
}

}  // namespace

Check check_condition(const ConditionTest& test, const Flavour& flavour, const Profile& profile) {
  const Machine machine =
      one_way(make_condition(test, *flavour.find(test.module), {.beta = 1, .eta = 0, .xi = 1}));
  const bool counts =
      test.trigger == Trigger::Neighbours || test.trigger == Trigger::NeighboursInverted;
  return counts ? check_count(test, machine, flavour, profile)
                : check_floor(test, machine, flavour, profile);
}

}  // namespace swarmsmith::assessment
