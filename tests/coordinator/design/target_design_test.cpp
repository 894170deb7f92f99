#include <algorithm>
#include <fstream>
#include <set>

#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/plans.h"
#include "tests/coordinator/design/target_campaigns.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

std::vector<Task> of_purpose(const std::vector<Task>& tasks, Purpose purpose) {
  std::vector<Task> found;
  for (const Task& task : tasks) {
    if (task.key.purpose == purpose) found.push_back(task);
  }
  return found;
}

TEST(TargetDesign, GivesProgramsSwitchesAndValuesAndCountsInstances) {
  const Ran ran = undisturbed(campaign_with("max_experiments = 300"));
  ASSERT_FALSE(ran.tasks.empty());
  std::set<std::int64_t> instances;
  for (const Task& task : ran.tasks) {
    EXPECT_THAT(task.machine,
                testing::MatchesRegex("--a [0-9.]+ --b [0-9]+ --c [xyz] --d [0-9.]+"));
    instances.insert(task.instance);
  }
  EXPECT_EQ(instances, (std::set<std::int64_t>{1, 2, 3}));
  const auto candidates = ran.memory.only<CandidateRow>();
  EXPECT_EQ(candidates.front().modules, "{}");
  EXPECT_EQ(candidates.front().states, 0);
  EXPECT_LE(static_cast<std::int64_t>(ran.tasks.size()), 300);
  EXPECT_EQ(ran.memory.only<EvaluationRow>().front().source, "command");
}

TEST(TargetDesign, AsksForOneTaskAtATime) {
  const Campaign campaign = campaign_with("max_experiments = 300");
  CampaignRunner runner(plans(campaign), {}, {});
  std::set<std::int64_t> pairs;
  for (const Task& task : runner.take_tasks())
    pairs.insert(task.key.pair);
  EXPECT_EQ(pairs.size(), 1U);
}

TEST(TargetDesign, KeepsTimesInTheStore) {
  const Ran ran = undisturbed(campaign_with("max_experiments = 300"));
  for (const EvaluationRow& row : not_empty(ran.memory.only<EvaluationRow>()))
    EXPECT_EQ(row.measured.time, 1 - row.measured.score);
}

TEST(TargetDesign, TestsTheBestOnEachTestInstanceOnce) {
  const Ran ran =
      undisturbed(campaign_with("max_experiments = 300", "", "test = [\"t1\", \"t2\"]\n"));
  const auto tests = of_purpose(ran.tasks, Purpose::Test);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].instance, 1);
  EXPECT_EQ(tests[1].instance, 2);
  EXPECT_NE(tests[0].seed, tests[1].seed);
  const auto last = ran.memory.only<DesignStateRow>().back();
  EXPECT_EQ(last.state, DesignState::Finished);
  EXPECT_EQ(tests[0].key.candidate, last.best);
}

TEST(TargetDesign, TestsTheElitesOfEveryIterationInOneBatchEachOnce) {
  const Campaign campaign =
      campaign_with("max_experiments = 600\ntest_nb_elites = 2\ntest_iteration_elites = true", "",
                    "test = [\"t1\", \"t2\", \"t3\"]\n");
  const Ran ran = undisturbed(campaign);
  std::map<std::int64_t, std::vector<CandidateId>> elites;
  for (const EliteRow& row : ran.memory.only<EliteRow>()) {
    if (row.rank <= 2) elites[row.iteration].push_back(row.candidate);
  }
  ASSERT_GE(elites.size(), 2U);
  std::set<CandidateId> expected;
  for (const auto& [iteration, ids] : elites)
    expected.insert(ids.begin(), ids.end());
  std::multiset<CandidateId> tested;
  for (const Task& task : of_purpose(ran.tasks, Purpose::Test))
    tested.insert(task.key.candidate);
  EXPECT_EQ(tested.size(), 3 * expected.size());
  for (const CandidateId id : expected)
    EXPECT_EQ(tested.count(id), 3U) << to_string(id);
  EXPECT_EQ(tested.begin() == tested.end(), false);
  EXPECT_EQ(of_purpose(ran.tasks, Purpose::Test).front().key.candidate,
            elites.rbegin()->second.front());
  expect_resumable(campaign);
}

TEST(TargetDesign, TestsOnFreshSeedsOfTheTrainingInstancesWithoutTestInstances) {
  const Ran ran = undisturbed(campaign_with("max_experiments = 300", "", "test = { count = 4 }\n"));
  std::vector<std::int64_t> instances;
  for (const Task& task : of_purpose(ran.tasks, Purpose::Test))
    instances.push_back(task.instance);
  EXPECT_THAT(instances, ElementsAre(1, 2, 3, 1));
}

TEST(TargetDesign, GoesOnFromAStoreAsIfNothingHadHappened) {
  expect_resumable(campaign_with("max_experiments = 300", "", "test = [\"t1\", \"t2\"]\n"));
}

TEST(TargetDesign, ARejectionIsARejectionAfterAResumeToo) {
  expect_resumable(campaign_with("max_experiments = 300"), [](const Task& task) {
    Outcome outcome = honest(task);
    if (number_of(task.key.candidate) % 7 != 3) return outcome;
    outcome.status = EvaluationStatus::Rejected;
    outcome.measured.score = 0;
    return outcome;
  });
}

TEST(TargetDesign, AStoredBoundThatTheRaceDidNotSetIsFound) {
  const Campaign campaign = campaign_with("max_experiments = 300");
  const Ran ran = undisturbed(campaign);
  auto scores = ran.memory.scores();
  scores[scores.size() / 2].bound = 3;
  const CampaignRunner runner(plans(campaign), by_design(scores, ran.memory.steps(), {}), {});
  ASSERT_TRUE(runner.error());
  EXPECT_EQ(runner.error()->kind, ErrorKind::Corrupt);
}

TEST(TargetDesign, AnEvaluatorIsToldWhoIsAliveAndItsWordIsTheCost) {
  const Campaign campaign = campaign_with("max_experiments = 300\n", "evaluator = \"./e\"\n",
                                          "test = [\"t1\", \"t2\"]\n");
  const Ran ran = undisturbed(campaign, judged);
  const auto calls = of_purpose(ran.tasks, Purpose::Evaluator);
  ASSERT_FALSE(calls.empty());
  for (const Task& call : calls) {
    EXPECT_TRUE(std::ranges::is_sorted(call.alive));
    EXPECT_TRUE(std::ranges::binary_search(call.alive, number_of(call.key.candidate)));
  }
  // The tests' calls come last, one a test instance, and say so by their sign.
  ASSERT_GE(calls.size(), 2U);
  EXPECT_EQ(calls[calls.size() - 2].instance, -1);
  EXPECT_EQ(calls[calls.size() - 1].instance, -2);
  std::int64_t runs = 0;
  for (const Task& task : ran.tasks)
    runs += task.key.purpose == Purpose::Race;
  EXPECT_EQ(runs, ran.memory.only<DesignStateRow>().back().used) << "calls are not counted";
  const auto totals = ran.memory.only<CandidateTotalsRow>();
  EXPECT_LT(totals.back().score_sum, 0);
  EXPECT_TRUE(ran.memory.only<UnusedRow>().empty());
}

TEST(TargetDesign, ARejectionByTheEvaluatorIsNotAmongTheCosts) {
  const Campaign campaign = campaign_with("max_experiments = 300\n", "evaluator = \"./e\"\n");
  std::set<CandidateId> rejected;
  const Ran ran = undisturbed(campaign, [&](const Task& task) {
    Outcome outcome = judged(task);
    if (task.key.purpose == Purpose::Evaluator && number_of(task.key.candidate) % 7 == 3) {
      outcome.status = EvaluationStatus::Rejected;
      outcome.measured.score = 0;
      rejected.insert(task.key.candidate);
    }
    return outcome;
  });
  EXPECT_GT(rejected.size(), 3U);
  std::set<CandidateId> with_totals;
  for (const CandidateTotalsRow& row : ran.memory.only<CandidateTotalsRow>()) {
    with_totals.insert(row.candidate);
    EXPECT_FALSE(rejected.contains(row.candidate)) << to_string(row.candidate);
  }
  EXPECT_GT(with_totals.size(), 10U);
}

TEST(TargetDesign, CallsOfAnEvaluatorWaitForEachOther) {
  const Campaign campaign = campaign_with("max_experiments = 300\n", "evaluator = \"./e\"\n",
                                          "test = [\"t1\", \"t2\"]\n");
  CampaignRunner runner(plans(campaign), {}, {});
  std::vector<Task> out = runner.take_tasks();
  std::vector<EvaluationKey> calls;
  while (!out.empty()) {
    const auto is_call = [](const Task& task) { return task.key.purpose == Purpose::Evaluator; };
    ASSERT_LE(std::ranges::count_if(out, is_call), 1);
    if (is_call(out.back())) calls.push_back(out.back().key);
    const Task task = out.back();
    out.pop_back();
    runner.tell(judged(task));
    for (Task& next : runner.take_tasks())
      out.push_back(std::move(next));
  }
  EXPECT_TRUE(runner.finished());
  ASSERT_GT(calls.size(), 100U);
  // All of one pair, in the order of the candidates, before the next pair.
  for (std::size_t i = 1; i < calls.size(); ++i) {
    if (calls[i].pair == calls[i - 1].pair)
      EXPECT_GT(number_of(calls[i].candidate), number_of(calls[i - 1].candidate));
    else
      EXPECT_GT(calls[i].pair, calls[i - 1].pair);
  }
}

TEST(TargetDesign, GoesOnAmongCallsOfAnEvaluator) {
  expect_resumable(campaign_with("max_experiments = 300\n", "evaluator = \"./e\"\n",
                                 "test = [\"t1\", \"t2\"]\n"),
                   judged);
}

TEST(TargetDesign, ATimeIsABudgetThatStoredTimesReplay) {
  const Campaign campaign = campaign_with("max_time = 2500\n");
  const Ran ran = undisturbed(campaign);
  double time = 0;
  std::int64_t counted = 0;
  for (const EvaluationRow& row : ran.memory.only<EvaluationRow>()) {
    EXPECT_GT(row.iteration, 0);
    time += row.measured.time;
    ++counted;
  }
  EXPECT_GT(time, 1000);
  EXPECT_LT(time, 3000);
  EXPECT_EQ(ran.memory.only<DesignStateRow>().back().used, counted);
  const auto events = ran.memory.only<EventRow>();
  EXPECT_TRUE(std::ranges::any_of(
      events, [](const EventRow& event) { return event.kind == "time estimated"; }));
  expect_resumable(campaign);
}

TEST(TargetDesign, ATimeAndAnEvaluatorGoTogether) {
  const Campaign campaign =
      campaign_with("max_time = 2500\n", "evaluator = \"./e\"\n", "test = [\"t1\", \"t2\"]\n");
  const Ran ran = undisturbed(campaign, judged);
  std::set<std::pair<CandidateId, std::int64_t>> calls;
  for (const Task& call : of_purpose(ran.tasks, Purpose::Evaluator))
    EXPECT_TRUE(calls.emplace(call.key.candidate, call.key.pair).second) << to_string(call.key);
  // The runs of the first estimate count for their candidates as those of the races do.
  std::map<CandidateId, std::int64_t> runs;
  for (const CandidateTotalsRow& row : ran.memory.only<CandidateTotalsRow>())
    runs[row.candidate] = row.runs;
  for (const EliteRow& row : ran.memory.only<EliteRow>())
    EXPECT_GE(runs[row.candidate], row.runs) << to_string(row.candidate);
  expect_resumable(campaign, judged);
}

TEST(TargetDesign, TestsAreBoundedLikeTheFirstRuns) {
  const Ran ran = undisturbed(
      campaign_with("max_experiments = 300\nbound_max = 40\n", "", "test = [\"t1\", \"t2\"]\n"));
  for (const Task& task : not_empty(ran.tasks))
    EXPECT_EQ(task.bound, 40) << to_string(task.key);
}

TEST(TargetDesign, BoundsReachProgramsAndTheStore) {
  const Campaign campaign = campaign_with("max_time = 2500\nbound_max = 12\ncapping = true\n");
  const auto stops_at_bound = [](const Task& task) {
    Outcome outcome = honest(task);
    if (task.bound > 0) outcome.measured.time = std::min(outcome.measured.time, task.bound);
    return outcome;
  };
  const Ran ran = undisturbed(campaign, stops_at_bound);
  std::set<double> bounds;
  for (const EvaluationRow& row : ran.memory.only<EvaluationRow>())
    bounds.insert(row.bound);
  EXPECT_GT(bounds.size(), 1U) << "elites bound the others";
  EXPECT_EQ(bounds.count(0), 0U);
  const auto steps = ran.memory.only<RaceStepRow>();
  EXPECT_TRUE(std::ranges::any_of(steps, [](const RaceStepRow& s) { return s.bound.has_value(); }));
  expect_resumable(campaign, stops_at_bound);
}

TEST(TargetDesign, TheRaceAfterTheLastIsMarkedAndResumable) {
  const Campaign campaign = campaign_with("max_experiments = 420\n");
  const Ran ran = undisturbed(campaign);
  const auto iterations = ran.memory.only<IterationRow>();
  ASSERT_FALSE(iterations.empty());
  EXPECT_TRUE(iterations.back().postselection);
  EXPECT_FALSE(iterations.front().postselection);
  EXPECT_EQ(iterations.front().model_digest, 0U);
  EXPECT_NE(iterations.back().model_digest, 0U);
  expect_resumable(campaign);
}

/// The way between two configurations of the campaign's parameters.
Campaign ablation_with(AblationType type, const std::string& simulator = "") {
  Campaign campaign = campaign_with("max_experiments = 300", simulator);
  campaign.methods.front().configurations = "a b c d\n0.5 10 x 0.1\n1.5 20 z 0.9\n";
  campaign.race.ablation = type;
  campaign.race.ablation_pairs = 12;
  return campaign;
}

TEST(TargetDesign, AnAblationIsADesignThatGoesOnFromAStore) {
  for (const auto type : {AblationType::Full, AblationType::Racing}) {
    const Campaign campaign = ablation_with(type);
    const Ran ran = undisturbed(campaign);
    const auto last = ran.memory.only<DesignStateRow>().back();
    EXPECT_EQ(last.state, DesignState::Finished);
    EXPECT_EQ(last.iteration, 5) << "the source, three steps, the target";
    EXPECT_LE(last.used, 132);
    expect_resumable(campaign);
    expect_resumable(ablation_with(type, "evaluator = \"./e\"\n"), judged);
    expect_resumable(campaign, [](const Task& task) { return random_target(task, false, 0.05); });
  }
}

TEST(TargetDesign, AProgramRepairsWhatIsSampled) {
  const TemporaryFolder folder;
  const std::filesystem::path program = folder / "repair.awk";
  std::ofstream(program)
      << "#!/usr/bin/awk -f\nNR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"b\")"
         " b = i; print; next }\n{ if ($b > 50) $b = 50; print }\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  Campaign campaign = campaign_with("max_experiments = 300\n");
  campaign.repair = program;
  campaign.target->folder = folder.path();
  const Ran ran = undisturbed(campaign);
  for (const Task& task : ran.tasks) {
    const std::string b = task.machine.substr(task.machine.find("--b ") + 4);
    EXPECT_LE(std::stoi(b), 50);
  }
  std::filesystem::remove(program);
  const auto made = value_of(plans_of(campaign));
  EXPECT_FALSE(DesignRunner::start(made.front(), {})) << "without its program nothing is sampled";
}

TEST(TargetDesign, ARepairThatFailsIsNamedWithItsEnd) {
  const std::map<std::string, std::string> ends = {
      {"exit 3", "the program ended with exit status 3, which is not 0"},
      {"kill -9 $$", "the program was killed by signal 9"},
      {"kill -9 $PPID; sleep 9", "the program was killed by signal 9"},
      {"true", "the program printed no configuration"}};
  for (const auto& [line, reason] : ends) {
    const TemporaryFolder folder;
    const std::filesystem::path program = folder / "repair.sh";
    std::ofstream(program) << "#!/bin/sh\n" << line << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    Campaign campaign = campaign_with("max_experiments = 300\n");
    campaign.repair = program;
    campaign.target->folder = folder.path();
    const auto made = value_of(plans_of(campaign));
    EXPECT_THAT(complaint_of(DesignRunner::start(made.front(), {})), HasSubstr(reason)) << line;
  }
}

}  // namespace
}  // namespace swarmsmith
