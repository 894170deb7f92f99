#include <gtest/gtest.h>

#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "tests/sim/reference_run.h"

namespace swarmsmith {
namespace {

/// Texts of the twenty reference machines and the thirty designs of the thesis.
std::vector<std::string> reference_texts() {
  std::vector<std::string> texts;
  for (const auto& row : golden_rows("argos-fsms.csv"))
    texts.push_back(row.at(1));
  for (const auto& row : golden_rows("argos-thesis-designs.csv"))
    texts.push_back(row.at(2));
  return texts;
}

TEST(ReferenceMachines, AllParseInBothFlavoursAndReadBackFromTheirPrint) {
  ASSERT_EQ(reference_texts().size(), 50U);
  for (const std::string& text : reference_texts()) {
    for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
      const Expected<Machine> machine = parse_machine(text, *flavour);
      ASSERT_TRUE(machine.has_value()) << to_string(machine.error()) << "\n" << text;
      EXPECT_FALSE(check(*machine, *flavour).has_value());
      const std::string print = print_machine(*machine, *flavour);
      EXPECT_EQ(parse_machine(print, *flavour).value(), *machine) << print;
      EXPECT_LE(print.size(), text.size());
    }
  }
}

TEST(ReferenceMachines, ADesignOfTheThesisInCanonicalFormIsItsOwnPrint) {
  for (const auto& row : golden_rows("argos-thesis-designs.csv")) {
    if (row.at(0) != "tA2") continue;
    const Machine machine = parse_machine(row.at(2), watermelon()).value();
    EXPECT_EQ(print_machine(machine, watermelon()), row.at(2));
    ASSERT_EQ(machine.states.size(), 4U);
    EXPECT_EQ(machine.states[0].behaviour, Behaviour(Attraction{4.69}));
    // --n0x1 2 of state 0: the third of the states 1, 2, 3.
    EXPECT_EQ(machine.states[0].transitions[1],
              (Transition{.condition = FixedProbability{0.17}, .target = 3}));
    // --n2x2 1 of state 2: the second of the states 0, 1, 3.
    EXPECT_EQ(machine.states[2].transitions[2],
              (Transition{.condition = ColorDetection{0.58, ColorLabel::Green}, .target = 1}));
    return;
  }
  FAIL() << "no machine tA2";
}

}  // namespace
}  // namespace swarmsmith
