#include "sim/assessment/assessment.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/math.h"
#include "sim/assessment/internal/checks.h"
#include "sim/assessment/internal/condition_test.h"
#include "sim/assessment/internal/settings.h"
#include "sim/engine/fitting.h"
#include "sim/mission/footprint.h"

namespace swarmsmith::assessment {
namespace {

/// The profile with exactly one control cycle per instant that a recorder observes.
Profile with_nominal_clock(Profile profile) {
  profile.timing.least_period = 1;
  profile.timing.most_period = 1;
  profile.timing.jitter = 0;
  std::erase_if(profile.ranges,
                [](const FieldRange& range) { return range.field == "timing.jitter"; });
  return profile;
}

ModuleReport assess_condition(const ModuleSpec& spec, const Subject& subject) {
  ModuleReport report{.module = spec.module, .checks = {}, .rates = {}};
  for (const ConditionTest& test : tests_of(spec, subject.flavour)) {
    report.checks.push_back(check_condition(test, subject));
    std::vector<Rate> rates = rates_of(test, subject);
    // Of a condition on neighbours, the first rate is the one without any.
    const auto has_none = [](const Rate& rate) { return rate.trials == 0; };
    if (is_of_neighbours(test) && std::all_of(rates.begin() + 1, rates.end(), has_none)) {
      report.checks.back().passes = false;
      report.checks.back().note = kNoneSeen;
    }
    std::ranges::move(rates, std::back_inserter(report.rates));
  }
  return report;
}

}  // namespace

bool ModuleReport::passes() const {
  return std::ranges::all_of(checks, &Check::passes);
}

int Report::passed() const {
  return static_cast<int>(std::ranges::count_if(modules, &ModuleReport::passes));
}

bool Report::passes() const {
  return std::ranges::all_of(modules, &ModuleReport::passes);
}

std::optional<std::string> too_big(const Robot& robot) {
  const Footprint body(robot.body.outline, {});
  double reach_m = body.radius_m();
  for (const Point& corner : body.corners())
    reach_m = std::max(reach_m, hypot(corner.x, corner.y));
  const double room_m = pairs_of(robot).nearest_m;
  if (2 * reach_m < room_m) return std::nullopt;
  return fmt::format(
      "modules are assessed with robots that start {:.2g} m apart, so that they see each other, "
      "but the body of `{}` reaches {:.2g} m from its middle",
      room_m, robot.name, reach_m);
}

Report assess(const Subject& subject, const Progress& progress) {
  Report report;
  const Flavour flavour = fitted(subject.flavour, subject.robot);
  const auto runs = [](const ModuleSpec& spec) { return !is_external(spec.module); };
  const auto of = static_cast<int>(std::ranges::count_if(flavour.behaviours, runs) +
                                   std::ranges::count_if(flavour.conditions, runs));
  const auto add = [&](ModuleReport module) {
    report.modules.push_back(std::move(module));
    if (progress) progress(static_cast<int>(report.modules.size()), of);
  };
  for (const ModuleSpec& spec : flavour.behaviours) {
    if (runs(spec))
      add({.module = spec.module,
           .checks = check_behaviour(spec, {flavour, subject.profile, subject.robot}),
           .rates = {}});
  }
  const Profile nominal = with_nominal_clock(subject.profile);
  for (const ModuleSpec& spec : flavour.conditions)
    if (runs(spec)) add(assess_condition(spec, {flavour, nominal, subject.robot}));
  return report;
}

}  // namespace swarmsmith::assessment
