#include "irace_core/search/stage.h"

#include <gtest/gtest.h>

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

TEST(Stage, AnFRaceTellsWhoIsLeft) {
  const SearchPoint point{.iteration = 1, .iterations = 1, .configurations = 120, .alive = 17};
  EXPECT_EQ(stage_text(options_of(SearchKind::FRace), point), "one race: 17 left");
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
