#include "sim/assessment/internal/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "sim/assessment/internal/statistics.h"

namespace swarmsmith::assessment {
namespace {

constexpr int kExploring = 0;

/// Exploration until the condition fires, then Stop for good.
Machine one_way(const Condition& condition) {
  return {{{Exploration{kTau}, {{condition, 1}}}, {Stop{}, {}}}};
}

/// The events of the three robots in one run, or in all runs.
struct FloorRun {
  int over = 0;        ///< tested cycles over the floor that satisfies the condition
  int read = 0;        ///< cycles of these in which the reading satisfied it
  int fired_over = 0;  ///< firings in these cycles
  int elsewhere = 0;   ///< firings after a reading that satisfied it over other floor
  int missed = 0;      ///< tested cycles in which it had to fire but did not
  int wrong = 0;       ///< firings without a reason

  bool is_tested() const { return fired_over > 0; }
  bool is_as_expected() const { return is_tested() && missed == 0 && wrong == 0; }
};

using FloorRuns = std::array<FloorRun, kConditionRuns>;

FloorRuns run_over_floor(const ConditionTest& test, const Condition& condition,
                         const Subject& subject) {
  FloorRuns runs;
  for_each_cycle(test, one_way(condition), subject, [&](const ObservedCycle& cycle) {
    FloorRun& run = runs[static_cast<std::size_t>(cycle.seed - 1)];
    const bool tested = cycle.state == kExploring && cycle.tested;
    const double probability =
        tested ? due_probability(test, condition, 1, *cycle.record.readings, subject.flavour) : 0;
    const bool due = probability > 0;
    const bool over = tested && (test.trigger == Trigger::Readings
                                     ? due
                                     : is_over_wanted(test, subject, cycle.record.pose));
    run.over += over ? 1 : 0;
    run.read += over && due ? 1 : 0;
    run.fired_over += over && due && cycle.fired ? 1 : 0;
    run.elsewhere += !over && due && cycle.fired ? 1 : 0;
    run.missed += probability >= 1 && !cycle.fired ? 1 : 0;
    run.wrong += !due && cycle.fired ? 1 : 0;
  });
  return runs;
}

FloorRun sum_of(const FloorRuns& runs) {
  FloorRun sum;
  for (const FloorRun& run : runs) {
    sum.over += run.over;
    sum.read += run.read;
    sum.fired_over += run.fired_over;
    sum.elsewhere += run.elsewhere;
    sum.missed += run.missed;
    sum.wrong += run.wrong;
  }
  return sum;
}

std::string text_of(Rgb color) {
  return fmt::format("{}, {}, {}", color.r, color.g, color.b);
}

/// Without noise, the wanted floor and no other floor of the arena must satisfy the condition by
/// the flavour's numbers; gives the error, as a sentence.
std::string misread_floor(const ConditionTest& test, const FloorModel& floor) {
  if (test.trigger == Trigger::Always || test.trigger == Trigger::Readings) return {};
  if (!satisfies(test, test.wanted, floor)) {
    return fmt::format("by the flavour's numbers the {} ({}) does not satisfy it", test.floor,
                       text_of(test.wanted));
  }
  std::vector<Rgb> colors = {test.arena.floor};
  for (const Patch& patch : test.arena.patches)
    colors.push_back(patch.color);
  for (const Rgb& color : colors) {
    if (color == test.wanted || !satisfies(test, color, floor)) continue;
    return fmt::format("by the flavour's numbers the floor {} also satisfies it", text_of(color));
  }
  return {};
}

/// Why the check fails, or another remark.
std::string note_about(const ConditionTest& test, const FloorRuns& runs, const FloorModel& floor) {
  std::string misread = misread_floor(test, floor);
  if (!misread.empty()) return misread;
  const FloorRun sum = sum_of(runs);
  if (sum.missed + sum.wrong > 0) {
    return fmt::format(
        "did not fire in {} cycles in which it should, fired in {} in which it should not",
        sum.missed, sum.wrong);
  }
  const auto untested = std::ranges::count_if(runs, std::not_fn(&FloorRun::is_tested));
  std::string note;
  if (untested > 0) {
    note = fmt::format("in {} of {} runs it did not fire over the {}; ", untested, kConditionRuns,
                       test.floor);
  }
  constexpr double kReliable = 0.9;
  if (sum.read < kReliable * sum.over) {
    note += fmt::format("the reading satisfied it in {} of {} tested cycles over the {}; ",
                        sum.read, sum.over, test.floor);
  }
  if (sum.elsewhere > 0) {
    note += fmt::format("{} of {} firings were over other floor, which the ground sensor misread; ",
                        sum.elsewhere, sum.elsewhere + sum.fired_over);
  }
  if (!note.empty()) note.erase(note.size() - 2);
  return note;
}

Check check_floor(const ConditionTest& test, const Condition& condition, const Subject& subject) {
  const FloorModel& floor = subject.flavour.floor;
  const FloorRuns runs = run_over_floor(test, condition, subject);
  std::vector<double> fired;
  for (const FloorRun& run : runs)
    fired.push_back(run.fired_over);
  const auto good = std::ranges::count_if(runs, &FloorRun::is_as_expected);
  return {.setting = test.floor + ", p = 1",
          .runs = kConditionRuns,
          .quantity = "robots_fired_over_the_floor",
          .values = fired,
          .passes = good == kConditionRuns && misread_floor(test, floor).empty(),
          .measured = fmt::format("{} of {} as expected", good, kConditionRuns),
          .expected = fmt::format("{} of {}", kConditionRuns, kConditionRuns),
          .note = note_about(test, runs, floor)};
}

/// With eta = 0 the sigmoid is one half for any number of neighbours; each robot fires once.
Check check_count(const ConditionTest& test, const Condition& condition, const Subject& subject) {
  std::array<std::array<int, kRobots>, kConditionRuns> tests{};
  for_each_cycle(test, one_way(condition), subject, [&](const ObservedCycle& cycle) {
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

Check check_condition(const ConditionTest& test, const Subject& subject) {
  const Condition condition =
      make_condition(test, *subject.flavour.find(test.module), {.beta = 1, .eta = 0, .xi = 1});
  const bool counts = is_of_neighbours(test);
  return counts ? check_count(test, condition, subject) : check_floor(test, condition, subject);
}

}  // namespace swarmsmith::assessment
