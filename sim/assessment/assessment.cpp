#include "sim/assessment/assessment.h"

#include <algorithm>

#include "sim/assessment/internal/checks.h"
#include "sim/assessment/internal/condition_test.h"

namespace swarmsmith::assessment {
namespace {

/// A control cycle for each instant that a recorder sees.
Profile with_nominal_clock(Profile profile) {
  profile.timing.least_period = 1;
  profile.timing.most_period = 1;
  profile.timing.jitter = 0;
  return profile;
}

ModuleReport assess_condition(const ModuleSpec& spec, const Flavour& flavour,
                              const Profile& profile) {
  ModuleReport report{.module = spec.module, .checks = {}, .rates = {}};
  for (const ConditionTest& test : tests_of(spec, flavour)) {
    report.checks.push_back(check_condition(test, flavour, profile));
    std::ranges::move(rates_of(test, flavour, profile), std::back_inserter(report.rates));
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

Report assess(const Flavour& flavour, const Profile& profile, const Progress& progress) {
  Report report;
  const auto runs = [](const ModuleSpec& spec) { return !is_external(spec.module); };
  const auto of = static_cast<int>(std::ranges::count_if(flavour.behaviours, runs) +
                                   std::ranges::count_if(flavour.conditions, runs));
  const auto add = [&](ModuleReport module) {
    report.modules.push_back(std::move(module));
    if (progress) progress(static_cast<int>(report.modules.size()), of);
  };
  for (const ModuleSpec& spec : flavour.behaviours) {
    if (runs(spec))
      add({.module = spec.module, .checks = check_behaviour(spec, flavour, profile), .rates = {}});
  }
  const Profile nominal = with_nominal_clock(profile);
  for (const ModuleSpec& spec : flavour.conditions)
    if (runs(spec)) add(assess_condition(spec, flavour, nominal));
  return report;
}

}  // namespace swarmsmith::assessment
