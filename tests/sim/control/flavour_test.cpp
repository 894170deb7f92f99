#include "sim/control/flavour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace swarmsmith {
namespace {

using ::testing::HasSubstr;

TEST(Flavour, IsFoundByItsName) {
  EXPECT_EQ(find_flavour("watermelon").value(), &watermelon());
  EXPECT_EQ(find_flavour("watermelon-argos3").value(), &watermelon_argos3());
}

TEST(Flavour, AnUnknownNameListsTheKnownOnes) {
  const Expected<const Flavour*> flavour = find_flavour("melon");
  ASSERT_FALSE(flavour.has_value());
  EXPECT_EQ(flavour.error().kind, ErrorKind::NotFound);
  EXPECT_EQ(flavour.error().message,
            "there is no flavour `melon`; known are: watermelon, watermelon-argos3");
}

TEST(Flavour, ModulesHaveTheNumbersOfThePublishedGrammar) {
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
    std::string table;
    for (const auto* modules : {&flavour->behaviours, &flavour->conditions}) {
      for (const ModuleSpec& spec : *modules) {
        table += std::to_string(spec.number) + " " + std::string(id_of(spec.module)) + "\n";
      }
    }
    EXPECT_EQ(table,
              "0 exploration\n1 stop\n2 attraction\n3 repulsion\n"
              "0 black_floor\n1 gray_floor\n2 white_floor\n3 neighbour_count\n"
              "4 inverted_neighbour_count\n5 fixed_probability\n6 color_detection\n");
  }
}

TEST(Flavour, ModuleIdsReadBack) {
  for (const ModuleSpec& spec : watermelon().conditions) {
    EXPECT_EQ(module_from_id(id_of(spec.module)), spec.module);
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

TEST(Flavour, AParameterOfOneSymbolIsTheSameInAllModules) {
  for (const ModuleSpec& one : watermelon().conditions) {
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
  EXPECT_EQ(xi_of(watermelon()).high, 10);
  for (const Flavour* flavour : {&watermelon(), &watermelon_argos3()}) {
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
  EXPECT_EQ(complaint_about(alpha, 0), "alpha must be more than 0");
  EXPECT_FALSE(complaint_about(alpha, 1e-300).has_value());
  const ParameterSpec& beta = watermelon().find(Module::BlackFloor)->parameters.at(0);
  EXPECT_THAT(complaint_about(beta, 1.01).value(),
              HasSubstr("beta must be at least 0 and at most 1"));
  EXPECT_TRUE(complaint_about(beta, std::numeric_limits<double>::quiet_NaN()).has_value());
}

TEST(Flavour, TheTwoDifferExactlyWhereThesisAndProgramDo) {
  const Flavour& thesis = watermelon();
  const Flavour& program = watermelon_argos3();
  EXPECT_EQ(thesis.behaviours, program.behaviours);
  EXPECT_EQ(thesis.floor.labels, program.floor.labels);
  EXPECT_EQ(thesis.speed_mps, program.speed_mps);
  EXPECT_NE(thesis.conditions, program.conditions);  // xi from 0 or from 1
  EXPECT_NE(thesis.obstacles, program.obstacles);
  EXPECT_NE(thesis.exploration, program.exploration);
  EXPECT_NE(thesis.neighbours, program.neighbours);
  EXPECT_NE(thesis.floor.black, program.floor.black);
}

}  // namespace
}  // namespace swarmsmith
