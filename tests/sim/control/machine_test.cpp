#include "sim/control/machine.h"

#include <gtest/gtest.h>

#include "sim/control/flavour.h"

namespace swarmsmith {
namespace {

Machine two_states() {
  return {{{Exploration{10}, {{BlackFloor{0.5}, 1}}}, {Stop{}, {{FixedProbability{0.1}, 0}}}}};
}

std::string complaint(const Machine& machine, const Flavour& flavour = watermelon()) {
  const std::optional<Error> error = check(machine, flavour);
  return error ? to_string(*error) : "";
}

TEST(Machine, AGoodOnePasses) {
  EXPECT_EQ(complaint(two_states()), "");
}

TEST(Machine, HasOneToFourStates) {
  EXPECT_EQ(complaint(Machine{}), "a machine has 1 to 4 states");
  Machine machine = two_states();
  for (int i = 0; i < 3; ++i)
    machine.states.push_back({Stop{}, {}});
  EXPECT_EQ(complaint(machine), "a machine has 1 to 4 states");
}

TEST(Machine, AStateHasAtMostFourTransitions) {
  Machine machine = two_states();
  machine.states[0].transitions.assign(5, {FixedProbability{1}, 1});
  EXPECT_EQ(complaint(machine), "state 0: a state has at most 4 transitions");
}

TEST(Machine, ATransitionLeadsToAnotherState) {
  Machine machine = two_states();
  machine.states[1].transitions[0].target = 1;
  EXPECT_EQ(complaint(machine), "state 1, transition 0: a transition must lead to another state");
  machine.states[1].transitions[0].target = 2;
  EXPECT_EQ(complaint(machine), "state 1, transition 0: the target 2 is not a state");
  machine.states[1].transitions[0].target = -1;
  EXPECT_EQ(complaint(machine), "state 1, transition 0: the target -1 is not a state");
}

TEST(Machine, ParametersKeepToTheirLimits) {
  Machine machine = two_states();
  machine.states[0].behaviour = Exploration{0};
  EXPECT_EQ(complaint(machine), "state 0: tau must be at least 1 and at most 1000000");
  machine = two_states();
  machine.states[0].transitions[0].condition = BlackFloor{-0.1};
  EXPECT_EQ(complaint(machine), "state 0, transition 0: beta must be at least 0 and at most 1");
}

TEST(Machine, ItsModulesAreOfTheFlavour) {
  Flavour without_stop = watermelon();
  without_stop.behaviours.erase(without_stop.behaviours.begin() + 1);
  EXPECT_EQ(complaint(two_states(), without_stop),
            "state 1: the flavour watermelon has no module stop");
}

}  // namespace
}  // namespace swarmsmith
