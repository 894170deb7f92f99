#include "sim/control/flavour.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace swarmsmith {
namespace {

TEST(Flavour, IsFoundByItsName) {
  EXPECT_EQ(find_flavour("watermelon").value(), &watermelon());
  EXPECT_EQ(find_flavour("watermelon-argos3").value(), &watermelon_argos3());
  EXPECT_EQ(find_flavour("chocolate").value(), &chocolate());
}

TEST(Flavour, AnUnknownNameListsTheKnownOnes) {
  const Expected<const Flavour*> flavour = find_flavour("melon");
  ASSERT_FALSE(flavour.has_value());
  EXPECT_EQ(flavour.error().kind, ErrorKind::NotFound);
  EXPECT_EQ(flavour.error().message,
            "there is no flavour `melon`; known are: watermelon, watermelon-argos3, chocolate, "
            "chocolate-epuck, maple-epuck, chocolate-epuck-2018, maple-epuck-2018");
  EXPECT_THAT(find_flavour("chocolat").error().message,
              HasSubstr("`chocolat` (did you mean \"chocolate\"?); known are: "));
}

TEST(Flavour, ThoseOfTheEPuckAreForAnotherReferenceModel) {
  std::vector<std::string> names;
  for (const Flavour* flavour : flavours_for("rm1.2"))
    names.push_back(flavour->name);
  EXPECT_EQ(names, (std::vector<std::string>{"chocolate-epuck", "maple-epuck"}));
  EXPECT_EQ(flavours_for(kRvrModel).size(), 3U);
}

TEST(Flavour, OnesOwnIsKeptOnce) {
  Flavour mine = watermelon();
  EXPECT_EQ(kept_flavour(mine), nullptr) << "it is built in";
  mine.name = "mine";
  const Flavour* kept = kept_flavour(mine);
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(*kept, mine);
  EXPECT_EQ(kept_flavour(mine), kept);
  EXPECT_EQ(find_flavour("mine", kept).value(), kept);
  mine.speed_mps = 0.2;
  EXPECT_NE(kept_flavour(mine), kept);
}

std::string numbers_of(const std::vector<ModuleSpec>& modules) {
  std::string table;
  for (const ModuleSpec& spec : modules)
    table += std::to_string(spec.number) + " " + std::string(id_of(spec.module)) + "\n";
  return table;
}

// Modules that were not published come behind those that were.

TEST(Flavour, ModulesHaveTheNumbersOfThePublishedGrammar) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    EXPECT_THAT(numbers_of(flavour->behaviours),
                StartsWith("0 exploration\n1 stop\n2 attraction\n3 repulsion\n"));
    EXPECT_THAT(numbers_of(flavour->conditions),
                StartsWith("0 black_floor\n1 gray_floor\n2 white_floor\n3 neighbour_count\n"
                           "4 inverted_neighbour_count\n5 fixed_probability\n6 color_detection\n"));
  }
}

TEST(Flavour, ModulesOfChocolateHaveTheNumbersOfTheEPucks) {
  for (const char* of_e_puck :
       {"chocolate-epuck", "maple-epuck", "chocolate-epuck-2018", "maple-epuck-2018"}) {
    const Flavour& flavour = **find_flavour(of_e_puck);
    EXPECT_EQ(numbers_of(flavour.behaviours), numbers_of(chocolate().behaviours)) << of_e_puck;
    EXPECT_EQ(numbers_of(flavour.conditions), numbers_of(chocolate().conditions)) << of_e_puck;
  }
  EXPECT_THAT(numbers_of(chocolate().behaviours),
              StartsWith("0 exploration\n1 stop\n2 phototaxis\n3 anti_phototaxis\n4 attraction\n"
                         "5 repulsion\n"));
  EXPECT_THAT(numbers_of(chocolate().conditions),
              StartsWith("0 black_floor\n1 gray_floor\n2 white_floor\n3 neighbour_count\n"
                         "4 inverted_neighbour_count\n5 fixed_probability\n"));
}

TEST(Flavour, ModuleIdsReadBack) {
  for (const Flavour* flavour : all_flavours()) {
    for (const auto* modules : {&flavour->behaviours, &flavour->conditions}) {
      for (const ModuleSpec& spec : *modules)
        EXPECT_EQ(module_from_id(id_of(spec.module)), spec.module);
    }
  }
  EXPECT_EQ(module_from_id("exploration"), Module::Exploration);
  EXPECT_FALSE(module_from_id("Exploration").has_value());
}

/// Parameters as irace's file counts them: those of a state's behaviours, and of a transition's
/// conditions, each symbol once.
std::set<std::string> symbols_of(const std::vector<ModuleSpec>& modules) {
  std::set<std::string> symbols;
  for (const ModuleSpec& spec : modules) {
    for (const ParameterSpec& parameter : spec.parameters)
      symbols.insert(parameter.symbol);
  }
  return symbols;
}

TEST(Flavour, GivesThe149ParametersOfTheSearch) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    const auto behaviours = symbols_of(flavour->behaviours);
    const auto conditions = symbols_of(flavour->conditions);
    EXPECT_EQ(behaviours, (std::set<std::string>{"RWM", "ATT", "REP"}));
    EXPECT_EQ(conditions, (std::set<std::string>{"P", "B", "W", "BI", "WI", "L"}));
    // NumStates; a state has S, NumConnections and its own; a transition N, C and its own.
    const std::size_t per_state = 2 + behaviours.size() + 4 * (2 + conditions.size());
    EXPECT_EQ(1 + 4 * per_state, 149U);
  }
}

TEST(Flavour, AValueOfOnesOwnHasTheTurnClockThatWasChosen) {
  for (const Flavour* known : all_flavours()) {
    EXPECT_EQ(known->exploration.turn_clock, TurnClock::Cycles);
    EXPECT_EQ(find_flavour(known->name, TurnClock::Cycles).value(), *known);
    Flavour timed = find_flavour(known->name, TurnClock::Seconds).value();
    EXPECT_EQ(timed.exploration.turn_clock, TurnClock::Seconds);
    timed.exploration.turn_clock = TurnClock::Cycles;
    EXPECT_EQ(timed, *known) << "nothing else changes";
  }
  EXPECT_FALSE(find_flavour("melon", TurnClock::Cycles).has_value());
}

TEST(Flavour, ASumOfObstaclesIsNotShortenedBelowWhatTurnsExploration) {
  // Exploration looks at the sum as it was before (turn_from_sum).
  for (const Flavour* flavour : not_empty(all_flavours()))
    EXPECT_GE(flavour->obstacles.longest_sum, 2 * flavour->exploration.threshold) << flavour->name;
}

TEST(Flavour, AParameterOfOneSymbolIsTheSameInAllModules) {
  for (const ModuleSpec& one : not_empty(watermelon().conditions)) {
    for (const ModuleSpec& other : watermelon().conditions) {
      for (const ParameterSpec& a : one.parameters) {
        for (const ParameterSpec& b : other.parameters) {
          if (a.symbol == b.symbol) {
            EXPECT_EQ(a, b);
          }
        }
      }
    }
  }
}

TEST(Flavour, SearchRangesAreThoseOfTheThesisAndLieWithinWhatIsAccepted) {
  const ParameterSpec& tau = watermelon().find(Module::Exploration)->parameters.at(0);
  EXPECT_EQ(tau.name, "tau");
  EXPECT_EQ(tau.token, "rwm");
  EXPECT_EQ(tau.low, 1);
  EXPECT_EQ(tau.high, 100);
  const auto xi_of = [](const Flavour& flavour) {
    return flavour.find(Module::NeighbourCount)->parameters.at(0);
  };
  EXPECT_EQ(xi_of(watermelon()).low, 0);
  EXPECT_EQ(xi_of(watermelon_argos3()).low, 1);
  EXPECT_EQ(xi_of(chocolate()).low, 0);
  EXPECT_EQ(xi_of(watermelon()).high, 10);
  for (const Flavour* flavour : all_flavours()) {
    for (const auto* modules : {&flavour->behaviours, &flavour->conditions}) {
      for (const ModuleSpec& spec : *modules) {
        for (const ParameterSpec& parameter : spec.parameters) {
          EXPECT_FALSE(complaint_about(parameter, parameter.low).has_value()) << parameter.symbol;
          EXPECT_FALSE(complaint_about(parameter, parameter.high).has_value()) << parameter.symbol;
        }
      }
    }
  }
}

TEST(ParameterSpec, ComplainsInASentence) {
  const ParameterSpec& tau = watermelon().find(Module::Exploration)->parameters.at(0);
  EXPECT_EQ(complaint_about(tau, 0), "tau must be at least 1 and at most 1000000");
  EXPECT_EQ(complaint_about(tau, 1.5), "tau must be an integer");
  const ParameterSpec& alpha = watermelon().find(Module::Attraction)->parameters.at(0);
  EXPECT_EQ(complaint_about(alpha, 0), "alpha must be more than 0 and at most 1000000");
  EXPECT_TRUE(complaint_about(alpha, 1e308).has_value()) << "two neighbours' sum is infinite";
  EXPECT_FALSE(complaint_about(alpha, 1e-300).has_value());
  const ParameterSpec& beta = watermelon().find(Module::BlackFloor)->parameters.at(0);
  EXPECT_THAT(complaint_about(beta, 1.01).value(),
              HasSubstr("beta must be at least 0 and at most 1"));
  ParameterSpec narrow = beta;
  narrow.most = 1e-7;  // not 0
  EXPECT_EQ(complaint_about(narrow, 0.5), "beta must be at least 0 and at most 1e-07");
  EXPECT_TRUE(complaint_about(beta, std::numeric_limits<double>::quiet_NaN()).has_value());
}

}  // namespace
}  // namespace swarmsmith
