#include "irace_core/internal/schedule.h"

#include <cmath>
#include <functional>
#include <string>

#include "tests/support/checks.h"

namespace swarmsmith::irace {
namespace {

std::string reason(const std::variant<RacePlan, NoMoreRaces>& next) {
  const auto* end = std::get_if<NoMoreRaces>(&next);
  return end == nullptr ? "a race" : end->reason;
}

Scenario with_budget(std::int64_t experiments) {
  Scenario scenario;
  scenario.max_experiments = experiments;
  return scenario;
}

TEST(Schedule, CountsWithTheLogarithmOfTheParameters) {
  EXPECT_EQ(default_count(1), 2);
  EXPECT_EQ(default_count(3), 3);
  EXPECT_EQ(default_count(4), 4);
  EXPECT_EQ(default_count(149), 9);
}

TEST(Schedule, CapsTheFirstRaceOfAHundredThousand) {
  Scenario scenario = with_budget(100'000);
  Schedule schedule(scenario, 149);
  const auto plan = std::get<RacePlan>(schedule.next(100'000, 0, 0));
  EXPECT_EQ(plan.budget, 11'111);
  EXPECT_EQ(plan.configurations, 1024);  // 11111 / (5 + 1) without the cap
  scenario.max_configurations_per_race = 5000;
  EXPECT_EQ(std::get<RacePlan>(Schedule(scenario, 149).next(100'000, 0, 0)).configurations, 1851);
}

TEST(Schedule, RaisesMuToTheFirstTest) {
  Scenario scenario = with_budget(10'000);
  scenario.first_test = 10;
  Schedule schedule(scenario, 4);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(10'000, 0, 0)).configurations, 2500 / 11);
}

TEST(Schedule, GivesUpNewInstancesWhenShort) {
  Scenario scenario = with_budget(500);
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
  Scenario scenario = with_budget(1000);
  scenario.nb_configurations = 60;
  Schedule schedule(scenario, 4);
  // A quarter of the budget buys 41, a third 47, a half 62.
  const auto plan = std::get<RacePlan>(schedule.next(1000, 0, 0));
  EXPECT_EQ(plan.iteration, 3);
  EXPECT_EQ(plan.configurations, 60);
  scenario.nb_configurations = 400;
  EXPECT_THAT(reason(Schedule(scenario, 4).next(1000, 0, 0)), HasSubstr("asked for"));
}

TEST(Schedule, AdvisesTheMostConfigurationsThatFit) {
  Scenario scenario = with_budget(1000);
  scenario.nb_configurations = 112;
  EXPECT_THAT(reason(Schedule(scenario, 4).next(1000, 0, 0)), HasSubstr("asked for"));
  // The last of four iterations may use all: 1000 / (5 + 4).
  EXPECT_THAT(Schedule(scenario, 4).advice_for_first_race(1000), HasSubstr("allow 111)"));
  scenario.nb_configurations = 111;
  EXPECT_EQ(reason(Schedule(scenario, 4).next(1000, 0, 0)), "a race");
  EXPECT_EQ(Schedule(scenario, 4).advice_for_first_race(1000), "");
  scenario.nb_experiments_per_iteration = 100;
  EXPECT_THAT(Schedule(scenario, 4).advice_for_first_race(1000), HasSubstr("allow 16)"));
  scenario.nb_configurations = 16;
  EXPECT_EQ(reason(Schedule(scenario, 4).next(1000, 0, 0)), "a race");
}

TEST(Schedule, AdvisesAgainstBudgetsWithoutAnyConfiguration) {
  Scenario scenario = with_budget(3);
  scenario.nb_configurations = 1;
  scenario.elitist = false;
  EXPECT_EQ(Schedule(scenario, 4).advice_for_first_race(3),
            " (nb_configurations is 1, and 3 experiments allow 0): give a larger budget, or ask "
            "for fewer configurations");
}

/// A third of 100 buys 33 / (5 + 2) configurations in the second of four iterations.
TEST(Schedule, NeedsRoomForANewConfiguration) {
  Scenario scenario = with_budget(1000);
  scenario.min_nb_survival = 2;
  scenario.elitist = false;
  for (const std::int64_t elites : {3, 4}) {
    Schedule schedule(scenario, 4);
    (void)schedule.next(1000, 0, 0);
    EXPECT_EQ(reason(schedule.next(100, elites, 5)),
              elites < 4 ? "a race" : "not enough budget for a new configuration");
  }
}

TEST(Schedule, EndsWithTheBudget) {
  Scenario scenario = with_budget(1000);
  Schedule schedule(scenario, 4);
  EXPECT_THAT(reason(schedule.next(0, 4, 10)), HasSubstr("exhausted"));
}

TEST(Schedule, AddsIterationsWhileBudgetIsLeft) {
  Scenario scenario = with_budget(1000);
  Schedule schedule(scenario, 1);  // two iterations
  (void)schedule.next(1000, 0, 0);
  (void)schedule.next(900, 2, 6);
  const auto third = std::get<RacePlan>(schedule.next(800, 2, 12));
  EXPECT_EQ(third.iterations, 3);
  EXPECT_EQ(third.budget, 800);
}

TEST(Schedule, StopsWhereConfigurationsAskedForNeverFit) {
  // Each iteration has the same budget, so that waiting for a later one does not help.
  Scenario scenario = with_budget(1000);
  scenario.nb_experiments_per_iteration = 50;
  scenario.nb_configurations = 60;
  EXPECT_THAT(reason(Schedule(scenario, 4).next(1000, 0, 0)), HasSubstr("asked for"));
}

TEST(Schedule, BeginsNoRaceThatWouldSpendMoreThanIsLeft) {
  Scenario scenario = with_budget(1000);
  scenario.nb_experiments_per_iteration = 500;
  scenario.elitist = false;
  // 500 / 6 = 83 configurations need 415 up to the first test.
  EXPECT_THAT(reason(Schedule(scenario, 4).next(414, 0, 0)), HasSubstr("first test"));
  EXPECT_EQ(std::get<RacePlan>(Schedule(scenario, 4).next(415, 0, 0)).configurations, 83);
}

TEST(Schedule, ShrinksToTheTimeThatIsLeft) {
  Scenario scenario;
  scenario.max_time = 100;
  Schedule schedule(scenario, 8);  // five iterations
  EXPECT_EQ(schedule.shrink_to(schedule.minimum_budget()).value(), false);
  // With four: (5 + 1) * 4 * (5 + 1 + 3) = 216; with three 144.
  EXPECT_EQ(schedule.shrink_to(215).value(), true);
  EXPECT_EQ(schedule.iterations(), 3);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(215, 0, 0)).configurations, 10);
  EXPECT_THAT(Schedule(scenario, 8).shrink_to(35).error().message, HasSubstr("at least 36"));
  scenario.nb_configurations = 7;
  Schedule smaller(scenario, 8);
  ASSERT_TRUE(smaller.shrink_to(215).value());
  EXPECT_EQ(std::get<RacePlan>(smaller.next(215, 0, 0)).configurations, 7);
}

TEST(Schedule, HasNoNewPairsWithoutUnusedOnes) {
  Scenario scenario = with_budget(1000);
  scenario.elitist_new_instances = 2;
  Schedule schedule(scenario, 4);
  (void)schedule.next(1000, 0, 0);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(800, 4, 6)).new_pairs, 2);
  schedule.limit_new_pairs(1);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(600, 4, 8)).new_pairs, 1);
  schedule.limit_new_pairs(0);
  schedule.limit_new_pairs(5);
  EXPECT_EQ(std::get<RacePlan>(schedule.next(400, 4, 9)).new_pairs, 0);
}

TEST(Scenario, IsCheckedOptionByOption) {
  Scenario scenario = with_budget(100);
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

/// The option that is complained of; "" for none.
std::string complaint(const std::function<void(Scenario&)>& change) {
  Scenario scenario = with_budget(1000);
  scenario.n_instances = 10;
  change(scenario);
  const auto checked = check(scenario);
  return checked ? "" : checked.error().where;
}

TEST(Scenario, IsCheckedForWhatFitsTogether) {
  EXPECT_EQ(complaint([](Scenario& s) { s.block_size = 5; }), "");
  EXPECT_EQ(complaint([](Scenario& s) { s.block_size = 3; }), "block_size");
  EXPECT_EQ(complaint([](Scenario& s) { s.block_size = 2; }), "");  // mu is raised to 10
  EXPECT_EQ(complaint([](Scenario& s) { s.block_size = 2, s.mu = 11; }), "mu");
  EXPECT_EQ(complaint([](Scenario& s) { s.deterministic = true; }), "");
  EXPECT_EQ(complaint([](Scenario& s) { s.deterministic = true, s.n_instances = 4; }),
            "deterministic");
  EXPECT_EQ(complaint([](Scenario& s) { s.max_time = 10; }), "max_time");
  const auto timed = [](Scenario& s) { s.max_experiments = 0, s.max_time = 10; };
  EXPECT_EQ(complaint(timed), "");
  EXPECT_EQ(complaint([&](Scenario& s) { timed(s), s.min_experiments = 10; }), "max_time");
  EXPECT_EQ(complaint([&](Scenario& s) { timed(s), s.elitist = false; }), "max_time");
  EXPECT_EQ(complaint([&](Scenario& s) { timed(s), s.budget_estimation = 1; }),
            "budget_estimation");
  EXPECT_EQ(complaint([](Scenario& s) { s.capping = true; }), "capping");
  EXPECT_EQ(complaint([](Scenario& s) { s.capping = true, s.bound_max = 3; }), "");
  EXPECT_EQ(complaint([](Scenario& s) { s.capping = true, s.bound_max = 3, s.elitist = false; }),
            "capping");
  EXPECT_EQ(complaint([](Scenario& s) { s.max_experiments = 0, s.min_experiments = 3; }), "");
  EXPECT_EQ(complaint([](Scenario& s) { s.bound_par = 0.5; }), "bound_par");
  EXPECT_EQ(complaint([](Scenario& s) { s.max_time = std::nan(""); }), "max_time");
}

}  // namespace
}  // namespace swarmsmith::irace
