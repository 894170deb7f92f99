#include "sim/control/machine_text.h"

#include <rapidcheck.h>

#include <stdexcept>

#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

Machine parsed(std::string_view text) {
  return value_of(parse_machine(text, watermelon()));
}

TEST(MachineText, ReadsTheExampleOfTheGrammar) {
  const Machine machine = parsed(
      "--nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 0 --p0x0 1.0 "
      "--s1 1 --n1 1 --n1x0 0 --c1x0 1 --p1x0 0.1");
  const Machine expected{
      {{Exploration{20}, {{BlackFloor{1.0}, 1}}}, {Stop{}, {{GrayFloor{0.1}, 0}}}}};
  EXPECT_EQ(machine, expected);
}

TEST(MachineText, HasAMegabyteAtMost) {
  const std::string machine = "--nstates 1 --s0 1";
  const std::string longest = machine + std::string((1U << 20U) - machine.size(), ' ');
  EXPECT_TRUE(parse_controller(longest, watermelon()));
  EXPECT_EQ(why_not(parse_controller(longest + " ", watermelon())).message,
            "control software has at most 1048576 characters, but this text has 1048577");
}

TEST(MachineText, ReadsEveryModule) {
  const Machine machine = parsed(
      "--nstates 4 --s0 2 --att0 1.48 --n0 4 "
      "--n0x0 0 --c0x0 3 --p0x0 8 --w0x0 9.83 --n0x1 1 --c0x1 4 --p0x1 0 --w0x1 0 "
      "--n0x2 2 --c0x2 6 --p0x2 0.75 --l0x2 3 --n0x3 0 --c0x3 2 --p0x3 0.94 "
      "--s1 3 --rep1 5 --s2 1 --n2 1 --n2x0 1 --c2x0 5 --p2x0 0 --s3 0 --rwm3 100");
  EXPECT_EQ(machine.states[0].behaviour, Behaviour(Attraction{1.48}));
  const std::vector<Transition> transitions = {{NeighbourCount{.eta = 9.83, .xi = 8}, 1},
                                               {InvertedNeighbourCount{.eta = 0, .xi = 0}, 2},
                                               {ColorDetection{0.75, ColorLabel::Yellow}, 3},
                                               {WhiteFloor{0.94}, 1}};
  EXPECT_EQ(machine.states[0].transitions, transitions);
  EXPECT_EQ(machine.states[1], (State{Repulsion{5}, {}}));
  EXPECT_EQ(machine.states[2], (State{Stop{}, {{FixedProbability{0}, 1}}}));
  EXPECT_EQ(machine.states[3], (State{Exploration{100}, {}}));
}

TEST(MachineText, TheOrderWithinABlockIsFree) {
  const Machine straight = parsed(
      "--nstates 2 --s0 0 --rwm0 7 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 2 --n0x1 0 --c0x1 0 "
      "--p0x1 1 --s1 1");
  const Machine mixed = parsed(
      "--nstates 2 --s0 0 --n0x0 0 --w0x0 2 --p0x0 1 --c0x0 3 --rwm0 7 --n0x1 0 --p0x1 1 --c0x1 0 "
      "--n0 2 --s1 1");
  EXPECT_EQ(straight, mixed);
}

TEST(MachineText, SkipsTheOriginalsOptionAndAnyWhiteSpace) {
  EXPECT_EQ(parsed("--fsm-config --nstates 1 --s0 1"), parsed("  --nstates\t1\n--s0  1\r\n"));
}

struct BadText {
  const char* text;
  const char* where;
  const char* message;
};

class MachineTextErrors : public ::testing::TestWithParam<BadText> {};

TEST_P(MachineTextErrors, NameTheirPlaceAndWhatWasExpected) {
  const Expected<Machine> machine = parse_machine(GetParam().text, watermelon());
  ASSERT_FALSE(machine.has_value()) << GetParam().text;
  EXPECT_EQ(machine.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(machine.error().where, GetParam().where) << machine.error().message;
  EXPECT_THAT(machine.error().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Structure, MachineTextErrors,
    ::testing::Values(
        BadText{"", "token 1, column 1", "a machine begins with `--nstates`"},
        BadText{"--fsm-config", "token 2, column 13", "a machine begins with `--nstates`"},
        BadText{"--s0 1", "token 1, column 1", "a machine begins with `--nstates`"},
        BadText{"nstates 1", "token 1, column 1", "expected a switch such as `--s0`"},
        BadText{"--nstates", "token 2, column 10", "`--nstates` has no value"},
        BadText{"--nstates --s0 1", "token 2, column 11", "`--nstates` has no value"},
        BadText{"--nstates 5 --s0 1", "token 2, column 11",
                "a machine of 5 states; machines of 1 to 4 states are read"},
        BadText{"--nstates 0", "token 2, column 11",
                "a machine of 0 states; machines of 1 to 4 states are read"},
        BadText{"--nstates 1.0 --s0 1", "token 2, column 11", "must be an integer, not `1.0`"},
        BadText{"--nstates 1", "token 3, column 12", "expected `--s0`"},
        BadText{"--nstates 1 --s1 1", "token 3, column 13", "expected `--s0`"},
        BadText{"--nstates 2 --s0 1", "token 5, column 19", "expected `--s1`"},
        BadText{"--nstates 2 --s0 1 --s0 1", "token 5, column 20", "expected `--s1`"},
        BadText{"--nstates 1 --s0 1 --s1 1", "token 5, column 20", "expected the end"},
        BadText{"--nstates 1 --s0 1 1", "token 5, column 20", "expected a switch"},
        BadText{"--nstates 1 --s0 1 --", "token 5, column 20", "expected a switch"},
        BadText{"--nstates 1 --s0 1 --n0x 1", "token 5, column 20", "expected a switch"},
        BadText{"--nstates 1 --s0 1 --nstates 1", "token 5, column 20", "does not belong"}));

INSTANTIATE_TEST_SUITE_P(
    States, MachineTextErrors,
    ::testing::Values(
        BadText{"--nstates 1 --s0 4", "token 4, column 18",
                "no module 4 for `--s0`; it has 0 exploration, 1 stop, 2 attraction, 3 repulsion"},
        BadText{"--nstates 1 --s0 x", "token 4, column 18", "must be an integer, not `x`"},
        BadText{"--nstates 1 --s0 0", "token 5, column 19", "expected `--rwm0`"},
        BadText{"--nstates 1 --s0 0 --rwm0 0", "token 6, column 27", "tau must be at least 1"},
        BadText{"--nstates 1 --s0 0 --rwm0 2.5", "token 6, column 27", "must be an integer"},
        BadText{"--nstates 1 --s0 0 --rwm0 5 --rwm0 6", "token 7, column 29", "appears twice"},
        BadText{"--nstates 1 --s0 0 --rwm0 5 --att0 2", "token 7, column 29",
                "`--att0` does not belong to exploration"},
        BadText{"--nstates 1 --s0 0 --rwm1 5", "token 5, column 20",
                "does not belong to the block of state 0"},
        BadText{"--nstates 1 --s0 2 --att0 0", "token 6, column 27", "alpha must be more than 0"},
        BadText{"--nstates 1 --s0 2 --att0 nan", "token 6, column 27", "alpha must be"},
        BadText{"--nstates 1 --s0 2 --att0 1,5", "token 6, column 27", "must be a number"},
        BadText{"--nstates 1 --s0 1 --foo0 1", "token 5, column 20", "does not belong to stop"},
        BadText{"--nstates 1 --s0 1 --n0 1 --n0x0 0 --c0x0 5 --p0x0 1", "token 5, column 20",
                "the only state of a machine has no transitions"}));

INSTANTIATE_TEST_SUITE_P(
    Transitions, MachineTextErrors,
    ::testing::Values(
        BadText{"--nstates 2 --s0 1 --n0 0 --s1 1", "token 6, column 25", "from 1 to 4, not 0"},
        BadText{"--nstates 2 --s0 1 --n0 1 --s1 1", "token 6, column 25",
                "says 1 transition, but 0 follow"},
        BadText{"--nstates 2 --s0 1 --n0x0 0 --c0x0 5 --p0x0 1 --s1 1", "token 11, column 47",
                "expected `--n0` before this place"},
        BadText{"--nstates 2 --s0 1 --n0 1 --c0x0 5 --n0x0 0 --p0x0 1 --s1 1", "token 7, column 27",
                "is outside the block of its transition"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x1 0 --c0x1 5 --p0x1 1 --s1 1", "token 7, column 27",
                "is outside the block of its transition"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 1 --c0x0 5 --p0x0 1 --s1 1", "token 8, column 34",
                "`--n0x0` must be from 0 to 0, not 1"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --p0x0 1 --s1 1", "token 11, column 45",
                "expected `--c0x0` before this place"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 7 --p0x0 1 --s1 1",
                "token 10, column 43", "no module 7 for `--c0x0`; it has 0 black_floor"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 5 --s1 1", "token 11, column 45",
                "expected `--p0x0` before this place"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 5 --p0x0 1.01 --s1 1",
                "token 12, column 52", "beta must be at least 0 and at most 1, not 1.01"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 5 --p0x0 1 --w0x0 2 --s1 1",
                "token 13, column 54", "`--w0x0` does not belong to fixed_probability"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 3 --p0x0 0.5 --w0x0 2 --s1 1",
                "token 12, column 52", "must be an integer, not `0.5`"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 3 --p0x0 -1 --w0x0 2 --s1 1",
                "token 12, column 52", "xi must be at least 0"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 6 --p0x0 1 --l0x0 4 --s1 1",
                "token 14, column 61", "no label 4; labels are 0 green, 1 blue, 2 red, 3 yellow"},
        BadText{"--nstates 2 --s0 1 --n0 1 --n0x0 0 --n0x0 0 --c0x0 5 --p0x0 1 --s1 1",
                "token 9, column 36", "appears twice"},
        BadText{"--nstates 2 --s0 1 --n0 5 --s1 1", "token 6, column 25", "from 1 to 4, not 5"}));

TEST(ControllerText, NamesTheOptionsBeforeAMachineThatItDoesNotKnow) {
  // As AutoMoDe-private, branch HardwareOptimization, Results/controllers.
  const Error read = why_not(
      parse_controller("--robots 22 --rabsi 2 --rabar 0.7 --nstates 1 --s0 1", watermelon()));
  EXPECT_EQ(read.where, "token 1, column 1");
  EXPECT_THAT(read.message,
              HasSubstr("unknown options before the machine: `--robots`, `--rabsi`, `--rabar`;"));
  EXPECT_THAT(parse_controller("--nstates 1 --robots 22 --s0 1", watermelon()).error().message,
              HasSubstr("expected `--s0`, found `--robots`"));
  EXPECT_THAT(parse_controller("--nstates 1 --s0 1 --robots 22", watermelon()).error().message,
              HasSubstr("`--robots` does not belong"));
}

TEST(MachineText, NumbersMeanWhatTheFlavoursTableSays) {
  Flavour renumbered = watermelon();
  for (ModuleSpec& spec : renumbered.behaviours)
    spec.number += 10;
  const Machine machine = parse_machine("--nstates 1 --s0 11", renumbered).value();
  EXPECT_EQ(machine, parsed("--nstates 1 --s0 1"));
  EXPECT_EQ(print_machine(machine, renumbered), "--nstates 1 --s0 11");
  EXPECT_FALSE(parse_machine("--nstates 1 --s0 1", renumbered).has_value());
}

TEST(MachineText, PrintsTheShortestNumbersInFixedOrder) {
  const char* canonical =
      "--nstates 2 --s0 0 --rwm0 7 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 2.5 "
      "--n0x1 0 --c0x1 6 --p0x1 0.1 --l0x1 2 --s1 1";
  EXPECT_EQ(print_machine(parsed(canonical), watermelon()), canonical);
  EXPECT_EQ(print_machine(parsed("--nstates 1 --s0 2 --att0 4.60"), watermelon()),
            "--nstates 1 --s0 2 --att0 4.6");
}

TEST(MachineText, DoesNotPrintAMachineThatIsNone) {
  EXPECT_THROW(print_machine(Machine{}, watermelon()), std::invalid_argument);
  EXPECT_THROW(print_machine(Machine{{{Exploration{0}, {}}}}, watermelon()), std::invalid_argument);
}

// --- parse(print(x)) = x -------------------------------------------------------------------------

/// A real in [0, 1] of any length.
double any_fraction() {
  return static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1'000'000'007)) / 1'000'000'006.0;
}

/// Any value that the parameter may have.
double any_value(const ParameterSpec& parameter) {
  if (parameter.type == ParameterSpec::Type::Real) {
    const double least = parameter.least_included ? parameter.low : parameter.low / 100;
    return least + (parameter.high - least) * any_fraction();
  }
  const auto low = static_cast<int>(parameter.low);
  return *rc::gen::inRange(low, static_cast<int>(parameter.high) + 1);
}

/// A module out of the table with values for its parameters.
template <class Made>
Made any_of(const std::vector<ModuleSpec>& table,
            Made (*make)(Module module, std::span<const double> parameters)) {
  const ModuleSpec& spec = table[*rc::gen::inRange<std::size_t>(0, table.size())];
  std::vector<double> values;
  for (const ParameterSpec& parameter : spec.parameters)
    values.push_back(any_value(parameter));
  return make(spec.module, values);
}

Machine any_machine(const Flavour& flavour) {
  Machine machine;
  const int states = *rc::gen::inRange(1, flavour.most_states + 1);
  for (int i = 0; i < states; ++i) {
    State state{any_of(flavour.behaviours, make_behaviour), {}};
    const int transitions = states == 1 ? 0 : *rc::gen::inRange(0, flavour.most_transitions + 1);
    for (int j = 0; j < transitions; ++j) {
      const int other = *rc::gen::inRange(0, states - 1);
      state.transitions.push_back(
          {any_of(flavour.conditions, make_condition), other < i ? other : other + 1});
    }
    machine.states.push_back(std::move(state));
  }
  return machine;
}

TEST(MachineText, WhatIsPrintedReadsBackToTheSameMachine) {
  for (const Flavour* flavour : not_empty(all_flavours())) {
    EXPECT_TRUE(rc::check([flavour] {
      const Machine machine = any_machine(*flavour);
      const std::string text = print_machine(machine, *flavour);
      const Expected<Machine> again = parse_machine(text, *flavour);
      RC_ASSERT(again.has_value());
      RC_ASSERT(*again == machine);
      RC_ASSERT(print_machine(*again, *flavour) == text);
    }));
  }
}

TEST(MachineText, ALargeIntegerReadsBack) {
  const std::string text = "--nstates 1 --s0 0 --rwm0 100000";
  const auto machine = value_of(parse_machine(text, watermelon()));
  EXPECT_EQ(print_machine(machine, watermelon()), text);
}

TEST(MachineText, ATextWithAWordLeftOutIsAnError) {
  EXPECT_TRUE(rc::check([] {
    const std::string text = print_machine(any_machine(watermelon()), watermelon());
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      words.push_back(text.substr(at, end - at));
      at = end + 1;
    }
    words.erase(words.begin() + *rc::gen::inRange(0, static_cast<int>(words.size())));
    std::string shorter;
    for (const std::string& word : words)
      shorter += word + " ";
    RC_ASSERT(!parse_machine(shorter, watermelon()).has_value());
  }));
}

}  // namespace
}  // namespace swarmsmith
