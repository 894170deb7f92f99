#include "coordinator/campaign/machine_space.h"

#include "sim/control/machine_text.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

Method method_of(const std::string& flavour, const std::string& more = "") {
  const std::string text = "name = \"m\"\nflavour = \"" + flavour + "\"\n" + more;
  return parsed(FileText{.method = text, .race = "max_experiments = 100000\n"}.text()).methods[0];
}

MachineSpace space_of(const Method& method, int digits = 2) {
  auto space = MachineSpace::make(method, **find_flavour(method.flavour), digits);
  EXPECT_TRUE(space) << to_string(space.error());
  return std::move(*space);
}

std::vector<std::string> names_of(const ParameterSpace& space) {
  std::vector<std::string> names;
  for (const Parameter& parameter : space.parameters())
    names.push_back(parameter.name);
  return names;
}

TEST(MachineSpace, OfWatermelonHasTheOneHundredAndFortyNineParametersOfTheOriginalInItsOrder) {
  for (const char* flavour : {"watermelon", "watermelon-argos3"}) {
    const MachineSpace machines = space_of(method_of(flavour));
    const auto names = names_of(machines.parameters());
    ASSERT_EQ(names.size(), 149U);
    EXPECT_EQ(machines.parameters().variable_count(), 149);
    const std::vector<std::string> first(names.begin(), names.begin() + 14);
    EXPECT_THAT(first,
                ElementsAre("NumStates", "S0", "RWM0", "ATT0", "REP0", "NumConnections0", "N0x0",
                            "C0x0", "P0x0", "B0x0", "W0x0", "BI0x0", "WI0x0", "L0x0"));
    EXPECT_EQ(names.back(), "L3x3");
  }
}

TEST(MachineSpace, OfChocolateIsWatermelonsWithoutLabels) {
  const MachineSpace machines = space_of(method_of("chocolate"));
  const ParameterSpace& space = machines.parameters();
  auto names = names_of(space_of(method_of("watermelon")).parameters());
  std::erase_if(names, [](const std::string& name) { return name.front() == 'L'; });
  EXPECT_EQ(names.size(), 133U);
  EXPECT_EQ(names_of(space), names);
  EXPECT_EQ(std::get<Categorical>(space[*space.index_of("S2")].domain).values,
            (std::vector<std::string>{"exploration", "stop", "phototaxis", "anti_phototaxis",
                                      "attraction", "repulsion"}));
  EXPECT_EQ(std::get<Categorical>(space[*space.index_of("C2x1")].domain).values.size(), 6U);
  const auto& xi = std::get<Integer>(space[*space.index_of("B0x0")].domain);
  EXPECT_EQ(std::get<double>(xi.lower), 0);
  EXPECT_EQ(std::get<double>(xi.upper), 10);
  // tau and alpha belong to one behaviour each; the phototaxes have nothing to choose.
  Rng rng(5);
  for (int i = 0; i < 200; ++i) {
    const Configuration configuration = random_configuration(space, rng);
    const std::size_t behaviour = configuration.choice(*space.index_of("S0"));
    EXPECT_EQ(configuration.is_active(*space.index_of("RWM0")), behaviour == 0);
    EXPECT_EQ(configuration.is_active(*space.index_of("ATT0")), behaviour == 4);
    EXPECT_EQ(configuration.is_active(*space.index_of("REP0")), behaviour == 5);
  }
}

class Flavours : public testing::TestWithParam<std::string> {};

TEST_P(Flavours, MakeMachinesWhosePrintedTextReadsBackToTheSameMachine) {
  const Flavour& flavour = **find_flavour(GetParam());
  const MachineSpace machines = space_of(method_of(GetParam()));
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    const Configuration configuration = random_configuration(machines.parameters(), rng);
    ASSERT_TRUE(machines.parameters().check(configuration));
    const Machine machine = machines.to_machine(configuration);
    const auto again = value_of(parse_machine(print_machine(machine, flavour), flavour));
    EXPECT_EQ(again, machine);
  }
}

TEST_P(Flavours, UseEachActiveParameterOnceInTheMachine) {
  const Flavour& flavour = **find_flavour(GetParam());
  const MachineSpace machines = space_of(method_of(GetParam()));
  Rng rng(11);
  for (int i = 0; i < 200; ++i) {
    const Configuration configuration = random_configuration(machines.parameters(), rng);
    std::size_t active = 0;
    for (std::size_t p = 0; p < configuration.size(); ++p)
      active += configuration.is_active(p);
    // Each switch of the text is one active parameter of the space.
    const std::string text = print_machine(machines.to_machine(configuration), flavour);
    std::size_t switches = 0;
    for (auto at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) {
      ++switches;
    }
    EXPECT_EQ(active, switches) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Flavours,
                         testing::Values("watermelon", "watermelon-argos3", "chocolate"),
                         [](const auto& flavour) {
                           std::string name = flavour.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(MachineSpace, ReadsTransitionTargetsAmongTheOtherStates) {
  const MachineSpace machines = space_of(method_of("watermelon"));
  const ParameterSpace& space = machines.parameters();
  Configuration configuration(space.size());
  const auto set = [&](const char* name, double value) {
    configuration.set(*space.index_of(name), value);
  };
  set("NumStates", 2);
  set("S0", 0);
  set("RWM0", 20);
  set("NumConnections0", 1);
  set("N0x0", 0);
  set("C0x0", 0);
  set("P0x0", 1);
  set("S1", 1);
  set("NumConnections1", 1);
  set("N1x0", 0);
  set("C1x0", 6);
  set("P1x0", 0.25);
  set("L1x0", 2);
  ASSERT_TRUE(space.check(configuration));
  const Machine machine = machines.to_machine(configuration);
  EXPECT_EQ(machine.states[0].transitions, (std::vector<Transition>{{BlackFloor{1}, 1}}));
  EXPECT_EQ(machine.states[1].transitions,
            (std::vector<Transition>{{ColorDetection{0.25, ColorLabel::Red}, 0}}));
  EXPECT_EQ(parameters_json(space, configuration),
            R"({"NumStates":2,"S0":"exploration","RWM0":20,"NumConnections0":1,"N0x0":0,)"
            R"("C0x0":"black_floor","P0x0":1,"S1":"stop","NumConnections1":1,"N1x0":0,)"
            R"("C1x0":"color_detection","P1x0":0.25,"L1x0":2})");
  EXPECT_EQ(modules_json(machine, watermelon()),
            R"({"exploration":1,"stop":1,"black_floor":1,"color_detection":1})");
  EXPECT_EQ(transition_count(machine), 2);
}

TEST(MachineSpace, LeavesOutWhatTheMethodDoesNotUse) {
  const Method method = method_of("watermelon",
                                  "max_states = 2\nmax_transitions = 1\n"
                                  "behaviours = [\"exploration\", \"stop\"]\n"
                                  "conditions = [\"black_floor\", \"color_detection\"]\n");
  const MachineSpace machines = space_of(method);
  EXPECT_THAT(names_of(machines.parameters()),
              ElementsAre("NumStates", "S0", "RWM0", "C0x0", "P0x0", "L0x0", "S1", "RWM1", "C1x0",
                          "P1x0", "L1x0"));
  Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const auto configuration = random_configuration(machines.parameters(), rng);
    const Machine machine = machines.to_machine(configuration);
    EXPECT_EQ(check(machine, watermelon()), std::nullopt);
    EXPECT_EQ(transition_count(machine), machine.states.size() == 2 ? 2 : 0);
  }
}

TEST(MachineSpace, OfOneStateHasNoTransitions) {
  const MachineSpace machines = space_of(method_of("watermelon", "max_states = 1\n"));
  EXPECT_THAT(names_of(machines.parameters()), ElementsAre("S0", "RWM0", "ATT0", "REP0"));
}

TEST(MachineSpace, GivesAModuleWithARangeOfItsOwnAParameterOfItsOwn) {
  const MachineSpace machines =
      space_of(method_of("watermelon",
                         "max_states = 2\nmax_transitions = 1\n"
                         "conditions = [\"black_floor\", \"gray_floor\", \"white_floor\"]\n"
                         "parameters.gray_floor.beta = { real = [0.5, 1] }\n"
                         "parameters.exploration.tau = { int = [1, 50] }\n"));
  const ParameterSpace& space = machines.parameters();
  ASSERT_TRUE(space.index_of("P_gray_floor0x0"));
  ASSERT_TRUE(space.index_of("P0x0"));
  const auto& tau = std::get<Integer>(space[*space.index_of("RWM0")].domain);
  EXPECT_EQ(std::get<double>(tau.upper), 50);
  EXPECT_EQ(space[*space.index_of("P_gray_floor0x0")].switch_text, "--p0x0 ");
}

TEST(MachineSpace, RefusesARangeThatTheDigitsCannotHold) {
  const Method method =
      method_of("watermelon", "parameters.attraction.alpha = { real = [1.25, 5] }\n");
  EXPECT_TRUE(MachineSpace::make(method, watermelon(), 2));
  EXPECT_FALSE(MachineSpace::make(method, watermelon(), 1));
}

}  // namespace
}  // namespace swarmsmith
