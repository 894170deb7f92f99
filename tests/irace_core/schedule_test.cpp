#include "irace_core/internal/schedule.h"

#include <gmock/gmock.h>

namespace swarmsmith::irace {
namespace {

using ::testing::HasSubstr;

std::string reason(const std::variant<RacePlan, NoMoreRaces>& next) {
  const auto* end = std::get_if<NoMoreRaces>(&next);
  return end == nullptr ? "a race" : end->reason;
}

TEST(Schedule, CountsWithTheLogarithmOfTheParameters) {
  EXPECT_EQ(default_count(1), 2);
  EXPECT_EQ(default_count(3), 3);
  EXPECT_EQ(default_count(4), 4);
  EXPECT_EQ(default_count(149), 9);
}

TEST(Schedule, CapsTheFirstRaceOfAHundredThousand) {
  Scenario scenario;
  scenario.max_experiments = 100'000;
  Schedule schedule(scenario, 149);
  const auto plan = std::get<RacePlan>(schedule.next(100'000, 0, 0));
  EXPECT_EQ(plan.budget, 11'111);
  EXPECT_EQ(plan.configurations, 1024);  // 11111 / (5 + 1) without the cap
  scenario.max_configurations_per_race = 5000;
  EXPECT_EQ(std::get<RacePlan>(Schedule(scenario, 149).next(100'000, 0, 0)).configurations, 1851);
}

TEST(Schedule, RaisesMuToTheFirstTest) {
  Scenario scenario;
  scenario.max_experiments = 10'000;
  scenario.first_test = 10;
  Schedule schedule(scenario, 4);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(10'000, 0, 0)).configurations, 2500 / 11);
}

TEST(Schedule, GivesUpNewInstancesWhenShort) {
  Scenario scenario;
  scenario.max_experiments = 500;
  scenario.min_nb_survival = 3;
  Schedule schedule(scenario, 11);
  (void)schedule.next(500, 0, 0);
  const auto plan = std::get<RacePlan>(schedule.next(400, 2, 11));
  EXPECT_EQ(plan.new_pairs, 1);
  // 25 experiments and 22 saved: 47/12 = 3 are too few, 47/11 = 4 are enough.
  const auto poor = std::get<RacePlan>(schedule.next(25 * 3, 2, 11));
  EXPECT_EQ(poor.new_pairs, 0);
  EXPECT_EQ(poor.configurations, 4);
}

TEST(Schedule, SkipsIterationsUntilTheConfigurationsAskedForFit) {
  Scenario scenario;
  scenario.max_experiments = 1000;
  scenario.nb_configurations = 60;
  Schedule schedule(scenario, 4);
  // A quarter of the budget buys 41, a third 47, a half 62.
  const auto plan = std::get<RacePlan>(schedule.next(1000, 0, 0));
  EXPECT_EQ(plan.iteration, 3);
  EXPECT_EQ(plan.configurations, 60);
  scenario.nb_configurations = 400;
  EXPECT_THAT(reason(Schedule(scenario, 4).next(1000, 0, 0)), HasSubstr("asked for"));
}

TEST(Schedule, EndsWithTheBudget) {
  Scenario scenario;
  scenario.max_experiments = 1000;
  Schedule schedule(scenario, 4);
  EXPECT_THAT(reason(schedule.next(0, 4, 10)), HasSubstr("exhausted"));
}

TEST(Schedule, AddsIterationsWhileBudgetIsLeft) {
  Scenario scenario;
  scenario.max_experiments = 1000;
  Schedule schedule(scenario, 1);  // two iterations
  (void)schedule.next(1000, 0, 0);
  (void)schedule.next(900, 2, 6);
  const auto third = std::get<RacePlan>(schedule.next(800, 2, 12));
  EXPECT_EQ(third.iterations, 3);
  EXPECT_EQ(third.budget, 800);
}

TEST(Scenario, IsCheckedOptionByOption) {
  Scenario scenario;
  scenario.max_experiments = 100;
  EXPECT_TRUE(check(scenario));
  scenario.each_test = 2;
  EXPECT_EQ(check(scenario).error().where, "first_test");
  scenario.each_test = 0;
  EXPECT_EQ(check(scenario).error().where, "each_test");
  scenario = Scenario{};
  EXPECT_EQ(check(scenario).error().where, "max_experiments");
  scenario.max_experiments = 100;
  scenario.confidence = 1;
  EXPECT_EQ(check(scenario).error().where, "confidence");
}

}  // namespace
}  // namespace swarmsmith::irace
