#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "irace_core/internal/race.h"
#include "tests/irace_core/golden.h"

namespace swarmsmith::irace {
namespace {

using testing::as_matrix;
using testing::as_vector;
using testing::golden;
using testing::kNotEvaluated;

/// A run: position of its pair in the race, configuration, bound.
using Call = std::tuple<std::int64_t, std::int64_t, double>;

/// One recorded race: what irace was told in the end, and what it did.
struct Recorded {
  explicit Recorded(const nlohmann::json& json) : race(json) {
    for (const auto& call : json["calls"]) {
      const std::pair<std::int64_t, std::int64_t> run{call[0], call[1]};
      calls.emplace_back(run.second, run.first, call[2].get<double>());
      full_times[run] = call[3];
    }
    std::sort(calls.begin(), calls.end());
  }

  const nlohmann::json& race;
  std::vector<Call> calls;
  std::map<std::pair<std::int64_t, std::int64_t>, double> full_times;  ///< without bounds
};

/// The pairs that irace came to, then those that it did not come to.
std::vector<std::int64_t> order_of_pairs(const nlohmann::json& json) {
  std::vector<std::int64_t> order;
  for (const auto& task : json["tasks"])
    order.push_back(task["pair"]);
  for (std::int64_t pair = 1; pair <= json["past_pairs"].get<std::int64_t>() + 60; ++pair) {
    if (std::find(order.begin(), order.end(), pair) == order.end()) order.push_back(pair);
  }
  return order;
}

RaceSettings settings_of(const nlohmann::json& json) {
  const std::map<std::string, CappingType> types = {{"median", CappingType::Median},
                                                    {"mean", CappingType::Mean},
                                                    {"worst", CappingType::Worst},
                                                    {"best", CappingType::Best}};
  const std::map<std::string, TestType> tests = {{"F-test", TestType::FTest},
                                                 {"t-test", TestType::TTest},
                                                 {"t-test-holm", TestType::TTestHolm}};
  RaceSettings settings;
  settings.test_type = tests.at(json["test_type"]);
  settings.elitist_limit = json["elitist_limit"];
  settings.min_survival = 3;
  settings.max_experiments = json["max_experiments"];
  settings.pairs = order_of_pairs(json);
  settings.past_pairs = json["past_pairs"];
  settings.new_pairs = settings.pairs.front() > settings.past_pairs ? 1 : 0;
  settings.capping = true;
  settings.capping_type = types.at(json["capping_type"]);
  settings.bound_type =
      json["bound_type"] == "instance" ? BoundType::Instance : BoundType::Candidate;
  settings.bound_max = json["bound_max"];
  settings.bound_digits = json["bound_digits"];
  settings.bound_par = json["bound_par"];
  settings.bound_as_timeout = json["bound_as_timeout"];
  return settings;
}

std::vector<Contestant> contestants_of(const nlohmann::json& json, const RaceSettings& settings) {
  std::vector<Contestant> contestants;
  for (const std::int64_t id : as_vector<std::int64_t>(json["ids"]))
    contestants.push_back({id, {}, {}});
  const auto times = as_matrix(json["past_times"], kNotEvaluated);
  const auto costs = as_matrix(json["past_costs"], kNotEvaluated);
  for (std::size_t elite = 0; elite < json["n_elites"]; ++elite) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(settings.past_pairs); ++i) {
      const auto pair = static_cast<std::size_t>(
          settings.pairs[i + static_cast<std::size_t>(settings.new_pairs)] - 1);
      contestants[elite].past.push_back(costs[elite][pair]);
      contestants[elite].past_times.push_back(times[elite][pair]);
    }
  }
  return contestants;
}

/// Answers until the race is over; returns what was asked for. Stops at a run that irace has never
/// made.
std::vector<Call> run(Race& race, const Recorded& recorded) {
  std::vector<Call> calls;
  while (!race.finished()) {
    std::vector<Measurement> answers;
    for (const RaceRun& wanted : race.wanted()) {
      const std::int64_t id = race.contestant(wanted.column).id;
      const std::int64_t pair = race.pair_of(wanted.task);
      calls.emplace_back(pair, id, wanted.bound);
      const auto full = recorded.full_times.find({id, pair});
      if (full == recorded.full_times.end()) return calls;
      const double time = std::min(full->second, wanted.bound);
      answers.push_back({time, time});
    }
    race.tell(answers);
  }
  return calls;
}

/// How many tasks can be compared. irace 3.5 loses track of who spent which time once a candidate
/// was dropped (it counts columns among those alive): bounds that add up a candidate's times are
/// its own only until the task after the first drop.
std::size_t comparable_tasks(const nlohmann::json& json) {
  const auto& tasks = json["tasks"];
  if (json["bound_type"] == "instance") return tasks.size();
  std::size_t first_drop = 0;
  while (first_drop < tasks.size() && tasks[first_drop]["alive"] == json["ids"].size())
    ++first_drop;
  return std::min(tasks.size(), first_drop + 2);
}

/// The runs on the pairs of the first tasks, in order.
std::vector<Call> on_first_tasks(const std::vector<Call>& calls, const nlohmann::json& json,
                                 std::size_t tasks) {
  std::vector<Call> found;
  for (const Call& call : calls) {
    for (std::size_t i = 0; i < tasks; ++i) {
      if (json["tasks"][i]["pair"] == std::get<0>(call)) found.push_back(call);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void expect_same_step(const RaceStep& step, const nlohmann::json& task) {
  EXPECT_EQ(std::string(1, step.marker), task["symbol"].get<std::string>());
  EXPECT_EQ(step.pair, task["pair"]);
  EXPECT_EQ(step.alive_after, task["alive"]);
  EXPECT_EQ(step.experiments_used, task["experiments"]);
  // Where none is run irace 3.5 repeats the best of the task before, who may be gone.
  if (step.marker == '.') return;
  EXPECT_EQ(step.best, task["best"]);
  EXPECT_NEAR(step.mean_best, task["mean_best"], 1e-8);
  ASSERT_TRUE(step.bound.has_value());
  EXPECT_NEAR(*step.bound, task["bound"], 0.005 + 1e-9);
}

TEST(CappingGolden, BoundsAndDropsAsIraceDoes) {
  std::size_t whole = 0;
  std::string markers;
  for (const auto& json : golden("capping_traces.json")) {
    SCOPED_TRACE("seed " + json["seed"].dump() + " iteration " + json["iteration"].dump());
    const Recorded recorded(json);
    const RaceSettings settings = settings_of(json);
    Race race(settings, contestants_of(json, settings));
    const std::vector<Call> calls = run(race, recorded);
    const std::vector<RaceStep> steps = race.take_steps();
    std::size_t tasks = comparable_tasks(json);
    // Where capping leaves no more than survive, irace 3.5 goes on to the first test, 4 does not.
    const bool ends_early = race.finished() && steps.size() < 5;
    if (ends_early) tasks = std::min(tasks, steps.size());
    ASSERT_GE(steps.size(), tasks);
    EXPECT_EQ(on_first_tasks(calls, json, tasks), on_first_tasks(recorded.calls, json, tasks));
    for (std::size_t i = 0; i < tasks; ++i) {
      SCOPED_TRACE("task " + std::to_string(i + 1));
      expect_same_step(steps[i], json["tasks"][i]);
      markers += steps[i].marker;
    }
    if (ends_early || tasks < json["tasks"].size()) continue;
    EXPECT_TRUE(race.finished());
    // We do not know irace's order of the pairs that it did not come to: passing over some is fine.
    for (std::size_t i = tasks; i < steps.size(); ++i)
      EXPECT_EQ(steps[i].marker, '.') << race.stop_reason();
    EXPECT_EQ(calls.size(), recorded.calls.size());
    ++whole;
  }
  EXPECT_EQ(whole, 52U);
  for (const char marker : {'c', '-', '!', '=', '.'})
    EXPECT_NE(markers.find(marker), std::string::npos) << marker;
}

}  // namespace
}  // namespace swarmsmith::irace
