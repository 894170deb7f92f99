#include "sim/control/internal/module_kinds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_control.h"
#include "sim/control/machine_text.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/not_empty.h"

// What holds for each behaviour and condition in the lists, also for those to come.

namespace swarmsmith {
namespace {

/// Watermelon with all other modules behind its own.
const Flavour& with_all() {
  static const Flavour kAll = [] {
    Flavour flavour = watermelon();
    flavour.name = "with-all";
    for (const Module module : all_modules()) {
      if (flavour.find(module) != nullptr) continue;
      auto& table = is_behaviour(module) ? flavour.behaviours : flavour.conditions;
      table.push_back({.module = module,
                       .id = std::string(id_of(module)),
                       .number = static_cast<int>(table.size()),
                       .parameters = parameters_of_kind(module)});
    }
    return flavour;
  }();
  return kAll;
}

/// Those that are built in, and one that has every module.
std::vector<const Flavour*> flavours() {
  std::vector<const Flavour*> all(all_flavours().begin(), all_flavours().end());
  all.push_back(&with_all());
  return all;
}

/// A flavour that has the module.
const Flavour& flavour_with(Module module) {
  for (const Flavour* flavour : flavours())
    if (flavour->find(module) != nullptr) return *flavour;
  ADD_FAILURE() << id_of(module) << " is in no flavour";
  return watermelon();
}

/// Parameters that differ from each other and from those by default where their ranges let them.
std::vector<double> some_values(const ModuleSpec& spec) {
  std::vector<double> values;
  for (const ParameterSpec& parameter : spec.parameters) {
    const double part = 0.25 * static_cast<double>(values.size() + 1);
    const double value = parameter.low + part * (parameter.high - parameter.low);
    values.push_back(parameter.type == ParameterSpec::Type::Real ? value : std::floor(value));
  }
  return values;
}

/// Readings that differ in all that a sensor can tell; the floor is the same for ten of them.
FakeSenses some_senses(int number) {
  FakeSenses senses;
  const auto channel = [number](int shift) {
    return static_cast<std::uint8_t>((number / 10 >> shift & 1) * 255);
  };
  senses.floor = {channel(0), channel(1), channel(2)};
  Rng rng(static_cast<std::uint64_t>(number));
  for (double& distance : senses.distances)
    if (rng.bernoulli(0.3)) distance = rng.uniform(kBlindZone_m, kProximityRange_m);
  for (double& lux : senses.lux)
    if (rng.bernoulli(0.3)) lux = rng.uniform(0, kMostLight_lux);
  for (int i = 0; i < number % 4; ++i)
    senses.neighbour(rng.uniform(0.2, 0.7), rng.uniform(-180, 180));
  return senses;
}

constexpr int kReadings = 400;

/// Nothing but what it says it uses, and the time.
void expect_asked(const FakeSenses& senses, const UsedSenses& used, Module module) {
  EXPECT_TRUE(used.proximity || senses.proximity_asked == 0) << id_of(module);
  EXPECT_TRUE(used.ground_color || senses.ground_asked == 0) << id_of(module);
  EXPECT_TRUE(used.neighbours || senses.neighbours_asked == 0) << id_of(module);
  EXPECT_TRUE(used.light || senses.light_asked == 0) << id_of(module);
}

TEST(Modules, HaveNamesThatReadBack) {
  std::set<std::string_view> ids;
  for (const Module module : not_empty(all_modules())) {
    EXPECT_EQ(module_from_id(id_of(module)), module);
    EXPECT_FALSE(label_of(module).empty()) << id_of(module);
    ids.insert(id_of(module));
  }
  EXPECT_EQ(ids.size(), all_modules().size());
  EXPECT_EQ(module_from_id("Exploration"), std::nullopt);
}

TEST(Modules, HaveOneNumberInAFlavour) {
  for (const Flavour* flavour : not_empty(flavours())) {
    for (const auto* modules : {&flavour->behaviours, &flavour->conditions}) {
      for (std::size_t i = 0; i < not_empty(*modules).size(); ++i)
        EXPECT_EQ((*modules)[i].number, i) << flavour->name << " " << id_of((*modules)[i].module);
    }
  }
}

TEST(Modules, AreMadeOfTheirParametersAndGiveThemBack) {
  for (const Module module : not_empty(all_modules())) {
    const std::vector<double> values = some_values(*flavour_with(module).find(module));
    std::vector<double> too_many = values;
    too_many.push_back(1);
    if (static_cast<std::size_t>(module) < kFirstModule<Condition>) {
      const Behaviour behaviour = make_behaviour(module, values);
      EXPECT_EQ(module_of(behaviour), module);
      EXPECT_EQ(parameters_of(behaviour), values);
      EXPECT_THROW(make_behaviour(module, too_many), std::invalid_argument);
      EXPECT_THROW(make_condition(module, values), std::invalid_argument);
    } else {
      const Condition condition = make_condition(module, values);
      EXPECT_EQ(module_of(condition), module);
      EXPECT_EQ(parameters_of(condition), values);
      EXPECT_THROW(make_condition(module, too_many), std::invalid_argument);
      EXPECT_THROW(make_behaviour(module, values), std::invalid_argument);
    }
  }
}

TEST(Modules, AreReadFromTextsThatTheyAreIn) {
  for (const Flavour* flavour : not_empty(flavours())) {
    for (const ModuleSpec& condition : flavour->conditions) {
      for (const ModuleSpec& behaviour : flavour->behaviours) {
        const Machine machine{{{make_behaviour(behaviour.module, some_values(behaviour)),
                                {{make_condition(condition.module, some_values(condition)), 1}}},
                               {Stop{}, {}}}};
        EXPECT_EQ(parse_machine(print_machine(machine, *flavour), *flavour).value(), machine);
      }
    }
  }
}

TEST(Modules, ABehaviourAsksForWhatItUsesAlone) {
  for (const Flavour* flavour : not_empty(flavours())) {
    for (const ModuleSpec& spec : flavour->behaviours) {
      const Behaviour behaviour = make_behaviour(spec.module, some_values(spec));
      const UsedSenses used = senses_used_by(behaviour, *flavour);
      Rng rng(1);
      BehaviourMemory memory;
      for (int i = 0; i < kReadings; ++i) {
        FakeSenses senses = some_senses(i);
        act(behaviour, senses, *flavour, memory, rng);
        expect_asked(senses, used, spec.module);
      }
    }
  }
}

TEST(Modules, AConditionAsksForWhatItUsesAlone) {
  for (const Flavour* flavour : not_empty(flavours())) {
    for (const ModuleSpec& spec : flavour->conditions) {
      const Condition condition = make_condition(spec.module, some_values(spec));
      for (int i = 0; i < kReadings; ++i) {
        FakeSenses senses = some_senses(i);
        const double probability = enabling_probability(condition, senses, *flavour);
        EXPECT_TRUE(0 <= probability && probability <= 1) << id_of(spec.module);
        EXPECT_EQ(senses.time_asked, 0) << id_of(spec.module);
        expect_asked(senses, senses_used_by(condition), spec.module);
      }
    }
  }
}

/// What a running machine remembers of a condition is what the condition says, whatever changes
/// from one cycle to the next while something else stays.
TEST(Modules, ARunningMachineTakesATransitionAsOftenAsItsConditionSays) {
  for (const Flavour* flavour : not_empty(flavours())) {
    for (const ModuleSpec& spec : flavour->conditions) {
      std::vector<double> values;
      for (const ParameterSpec& parameter : spec.parameters)
        values.push_back(parameter.name == "beta" ? 1 : parameter.high);
      const Condition condition = make_condition(spec.module, values);
      const Machine machine{{{Stop{}, {{condition, 1}}}, {Stop{}, {{condition, 0}}}}};
      MachineControl control(machine, *flavour, Rng(1));
      int sure = 0;
      for (int i = 0; i < kReadings; ++i) {
        FakeSenses entering = some_senses(i);
        const int before = control.state();
        control.step(entering);  // may be the first cycle of a state, which tests nothing
        if (control.state() != before) continue;
        FakeSenses senses = some_senses(i);
        const double probability = enabling_probability(condition, senses, *flavour);
        control.step(senses);
        constexpr double kSurely = 1e-9;  // sigmoids are never 0 or 1
        if (probability > kSurely && probability < 1 - kSurely) continue;
        ++sure;
        EXPECT_EQ(control.state() != before, probability > 0.5) << id_of(spec.module) << " " << i;
      }
      EXPECT_GT(sure, 0) << id_of(spec.module);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
