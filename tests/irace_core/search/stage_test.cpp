#include "irace_core/search/stage.h"

#include <gtest/gtest.h>
#include <cmath>

#include "irace_core/search/annealing.h"
#include "tests/irace_core/search/played.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kBudget = 2400;

SearchOptions small() {
  EvolutionOptions options;
  options.population = 20;
  options.runs = 5;
  options.final_runs = 10;
  return options;
}

TEST(Stage, GenerationsAreCountedWithoutTheFinalStage) {
  const SearchOptions options = small();
  SearchPoint point{.iteration = 4,
                    .iterations = 23,
                    .configurations = 20,
                    .runs_wanted = 100,
                    .runs = 60,
                    .budget = kBudget};
  EXPECT_EQ(stage_text(options, point), "generation 4 of 22, 12 of 20 members");
  EXPECT_EQ(round_line(options, point), "generation 4 of 22: 20 members, 5 runs each");
  point.runs = 0;
  EXPECT_EQ(stage_text(options, point), "generation 4 of 22");
}

TEST(Stage, TheFinalStageIsNamed) {
  const SearchOptions options = small();
  const SearchPoint point{.iteration = 23,
                          .iterations = 23,
                          .is_final = true,
                          .configurations = 20,
                          .runs_wanted = 200,
                          .runs = 120,
                          .budget = kBudget};
  EXPECT_EQ(stage_text(options, point), "final stage: 12 of 20 members");
  EXPECT_EQ(round_line(options, point), "final stage: 20 members, 10 runs each");
}

TEST(Stage, GenerationsGoOnAfterAnExtension) {
  const SearchPoint point{.iteration = 24, .iterations = 26, .finals = 1, .configurations = 20};
  EXPECT_EQ(stage_text(small(), point), "generation 23 of 24");
}

TEST(Stage, WhatNoEventHasSaidFollowsFromTheBudget) {
  const SearchOptions options = small();
  EXPECT_EQ(stage_text(options, {.iteration = 5, .budget = kBudget}), "generation 5 of 22");
  EXPECT_EQ(stage_text(options, {.iteration = 23, .budget = kBudget}), "final stage");
  EXPECT_EQ(stage_text(options, {.budget = kBudget}), "");
  // Eight generations of a thousand runs, and two thousand at the end.
  const SearchOptions cma = options_of(SearchKind::CmaEs);
  EXPECT_EQ(stage_text(cma, {.iteration = 8, .budget = 10'000}), "generation 8 of 8");
  EXPECT_EQ(stage_text(cma, {.iteration = 9, .budget = 10'000}), "final stage");
  EXPECT_EQ(stage_text(cma, {.iteration = 1, .budget = 10}), "generation 1") << "has no plan";
  const SearchOptions random = options_of(SearchKind::Random);
  EXPECT_EQ(round_name(random, {.iteration = 2, .budget = 10'000}), "final stage");
  EXPECT_EQ(round_name(random, {.iteration = 1, .budget = 10'000}), "configurations 1 to 900");
}

TEST(Stage, RandomSearchCountsConfigurations) {
  const SearchOptions options = options_of(SearchKind::Random);
  const SearchPoint point{.iteration = 1,
                          .iterations = 2,
                          .configurations = 220,
                          .runs_wanted = 2200,
                          .runs = 1100,
                          .budget = kBudget};
  EXPECT_EQ(stage_text(options, point), "configuration 110 of 220");
  EXPECT_EQ(round_line(options, point), "configurations 1 to 220 of 220: 10 runs each");
}

TEST(Stage, RandomSearchCountsTheDrawsOfItsSecondPart) {
  const SearchOptions options = options_of(SearchKind::Random);
  const SearchPoint point{.iteration = 2,
                          .iterations = 3,
                          .configurations = 130,
                          .runs_wanted = 1300,
                          .runs = 650,
                          .budget = 12'500};
  EXPECT_EQ(stage_text(options, point), "configuration 1065 of 1130");
  EXPECT_EQ(round_name(options, point), "configurations 1001 to 1130");
  EXPECT_EQ(round_line(options, point), "configurations 1001 to 1130 of 1130: 10 runs each");
}

TEST(Stage, RandomSearchDoesNotCountAfterAnExtension) {
  const SearchOptions options = options_of(SearchKind::Random);
  const SearchPoint point{.iteration = 3,
                          .iterations = 4,
                          .finals = 1,
                          .configurations = 50,
                          .runs_wanted = 500,
                          .runs = 100,
                          .budget = kBudget};
  EXPECT_EQ(round_name(options, point), "further configurations");
  EXPECT_EQ(round_line(options, point), "further configurations: 50 configurations, 10 runs each");
  EXPECT_EQ(stage_text(options, point), "further configurations");
}

TEST(Stage, RangesAndCountsAreWritten) {
  EXPECT_EQ(stage::of(0), "");
  EXPECT_EQ(stage::of(1), " of 1");
  EXPECT_EQ(stage::range("part", 5, 4), "parts from 5 on");
  EXPECT_EQ(stage::range("part", 5, 5), "parts 5 to 5");
  EXPECT_EQ(stage::range("part", 5, 6), "parts 5 to 6");
  EXPECT_EQ(stage::ready({.configurations = 20, .runs_wanted = 0, .runs = 7}), 0);
  EXPECT_EQ(stage::ready({.configurations = 20, .runs_wanted = 200, .runs = 119}), 11);
  EXPECT_EQ(stage::ready({.configurations = 20, .runs_wanted = 200, .runs = 300}), 20);
  EXPECT_EQ(stage::each({.configurations = 0, .runs_wanted = 5}), "5 runs each");
  EXPECT_EQ(stage::each({.configurations = 5, .runs_wanted = 5}), "1 run each");
  const SearchWords& words = words_of(SearchKind::Evolution);
  EXPECT_EQ(stage::members(words, {.configurations = 0}), "");
  EXPECT_EQ(stage::members(words, {.configurations = 1}), "0 of 1 member");
}

TEST(Stage, ARaceTellsItsBudget) {
  const SearchOptions options = options_of(SearchKind::Irace);
  const SearchPoint point{.iteration = 2,
                          .iterations = 5,
                          .finals = 1,
                          .is_final = true,
                          .configurations = 40,
                          .alive = 12,
                          .runs_wanted = 300};
  EXPECT_EQ(round_name(options, point), "iteration 2");
  EXPECT_EQ(round_line(options, point), "iteration 2: 40 configurations, budget 300");
  EXPECT_EQ(stage_text(options, point), "iteration 2 of 5");
}

TEST(Stage, AnnealingIsFinalOnceItCannotWalkOn) {
  const SearchOptions options = options_of(SearchKind::Annealing);
  // An iteration takes up to 12 runs, the final stage 200.
  for (const std::int64_t used : {kBudget - 213, kBudget - 212, kBudget - 211}) {
    const SearchPoint point{.iteration = 9, .step = 150, .used = used, .budget = kBudget};
    EXPECT_EQ(round_name(options, point) == "final stage", used > kBudget - 212) << used;
  }
  EXPECT_NE(round_name(options, {.iteration = 1, .used = kBudget, .budget = kBudget}),
            "final stage");
  EXPECT_EQ(round_name(options, {.iteration = 3, .iterations = 9, .step = 500, .budget = kBudget}),
            "iterations 101 to 200");
}

/// From 1 after the 210 runs of the scale down to 0.001 before the 200 of the final stage.
TEST(Stage, TheTemperatureFallsByEqualFactors) {
  AnnealingOptions options;
  const auto told = [&](std::int64_t used) {
    return search::told_temperature(options, kBudget, used, 1);
  };
  EXPECT_EQ(told(0), 1);
  EXPECT_EQ(told(210), 1);
  EXPECT_NEAR(told(210 + 1990 / 2), std::sqrt(0.001), 1e-12);
  EXPECT_NEAR(told(2200), 0.001, 1e-12);
  EXPECT_NEAR(told(2300), 0.001, 1e-12);
  options.start_temperature = 4;
  options.end_temperature = 0;
  EXPECT_NEAR(told(2200), 1e-12, 1e-20);
  options.start_temperature = 0;
  EXPECT_EQ(told(500), 0);
}

TEST(Stage, AnFRaceTellsWhoIsLeft) {
  const SearchPoint point{.iteration = 1, .iterations = 1, .configurations = 120, .alive = 17};
  EXPECT_EQ(stage_text(options_of(SearchKind::FRace), point), "one race: 17 left");
  EXPECT_EQ(stage_text(options_of(SearchKind::FRace), {.iteration = 1}), "one race");
}

TEST(Stage, AnnealingTellsItsTemperature) {
  const SearchOptions options = options_of(SearchKind::Annealing);
  EXPECT_EQ(
      stage_text(options,
                 {.iteration = 2, .iterations = 5, .step = 10, .used = 210, .budget = kBudget}),
      "iteration 1, temperature 1");
  EXPECT_EQ(
      stage_text(options,
                 {.iteration = 3, .iterations = 5, .step = 150, .used = 2200, .budget = kBudget}),
      "iteration 141, temperature 0.001");
  // A continued campaign does not know its step yet.
  const SearchPoint continued{.iteration = 2, .iterations = 5, .used = 210, .budget = kBudget};
  EXPECT_EQ(stage_text(options, continued), "an iteration of iterations from 1 on, temperature 1");
  EXPECT_EQ(round_line(options, continued), "iterations from 1 on");
}

TEST(Stage, AnnealingBeginsWithTheScaleOfTheScores) {
  const SearchOptions options = options_of(SearchKind::Annealing);
  const SearchPoint point{.iteration = 1,
                          .iterations = 5,
                          .configurations = 10,
                          .runs_wanted = 200,
                          .runs = 120,
                          .budget = kBudget};
  EXPECT_EQ(stage_text(options, point), "scale of the scores: 6 of 10 configurations");
  EXPECT_EQ(round_line(options, point), "scale of the scores: 10 configurations, 20 runs each");
}

TEST(Stage, ThePublishedTemperatureIsHalvedEveryThirdIterationAndBeginsAgain) {
  AnnealingOptions options;
  options.cooling = Cooling::Published;
  EXPECT_EQ(search::told_temperature(options, kBudget, 0, 3), 125);
  EXPECT_EQ(search::told_temperature(options, kBudget, 0, 4), 62.5);
  EXPECT_EQ(search::told_temperature(options, kBudget, 0, 51), 125.0 / 65536);
  EXPECT_EQ(search::told_temperature(options, kBudget, 0, 52), 125);
}

}  // namespace
}  // namespace swarmsmith
