#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/coordinator/design/idle_pool.h"
#include "tests/support/long_runs.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

std::int64_t not_used(const Memory& memory) {
  return std::ranges::count_if(memory.evaluations(), [](const auto& found) {
    return found.first.purpose == Purpose::Race && found.second.iteration == 0;
  });
}

/// Whatever the options and however often slots idle, a design that looks ahead and is left and
/// taken up again in between ends as one that did not.
TEST(LookAhead, ChangesNothingOfTheAnswer) {
  Rng rng(815);
  std::int64_t ahead = 0;
  int looked = 0;
  const int rounds = times(60, 200);
  for (int round = 0; round < rounds; ++round) {
    const TargetChoices options = random_options(rng);
    SCOPED_TRACE("round " + std::to_string(round) + "\n" + options.race + options.simulator);
    const std::vector<DesignPlan> designs =
        batched(plans(campaign_with(options.race, options.simulator, options.test)));
    if (HasFailure()) return;
    const double rejects = rng.bernoulli(0.4) ? rng.uniform(0, 0.1) : 0;
    const Answer answer = [&](const Task& task) {
      return random_target(task, options.evaluates, rejects);
    };
    const auto whole = undisturbed(designs, answer).memory.answer();
    Memory memory;
    const std::uint64_t restarts = rng.below(4);
    std::int64_t given = 0;
    for (std::uint64_t restart = 0; restart <= restarts; ++restart) {
      CampaignRunner runner = resumed(designs, memory);
      ASSERT_FALSE(runner.error()) << to_string(*runner.error());
      IdlePool pool(runner, memory, rng.split("pool", restart), answer, rng.uniform(0, 1));
      pool.run(restart == restarts ? ~std::size_t{0} : rng.below(300));
      given += pool.given_ahead();
    }
    EXPECT_EQ(memory.answer(), whole);
    if (rejects == 0) {
      EXPECT_LE(not_used(memory), given) << "waste is what was asked for and not used";
    }
    const std::int64_t used = memory.only<DesignStateRow>().back().used;
    const std::int64_t all = std::ranges::count_if(memory.evaluations(), [](const auto& found) {
      return found.first.purpose == Purpose::Race;
    });
    EXPECT_EQ(all - not_used(memory), used) << "the budget counts what the race consumed";
    ahead += given;
    looked += given > 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(looked, rounds / 5);
  EXPECT_GT(ahead, 10 * rounds);
}

TEST(LookAhead, ComesAfterWhatIsWantedAndIsGivenOnce) {
  CampaignRunner runner(batched(plans(campaign_with("max_experiments = 600"))), {}, {});
  std::set<EvaluationKey> given;
  for (const Task& task : runner.take_tasks()) {
    EXPECT_FALSE(task.ahead);
    given.insert(task.key);
  }
  const std::size_t wanted = given.size();
  std::int64_t last_pair = 0;
  for (;;) {
    const std::vector<Task> more = runner.take_more(7, 8);
    EXPECT_LE(more.size(), 7U);
    if (more.empty()) break;
    for (const Task& task : more) {
      EXPECT_TRUE(task.ahead);
      EXPECT_TRUE(given.insert(task.key).second) << to_string(task.key);
      EXPECT_GE(task.key.pair, last_pair) << "the next pairs come first";
      last_pair = task.key.pair;
    }
  }
  EXPECT_GT(given.size(), wanted);
  EXPECT_TRUE(runner.take_tasks().empty());
}

TEST(LookAhead, WhatIsWantedComesAgainAndWhatIsVoidIsDropped) {
  CampaignRunner runner(batched(plans(campaign_with("max_experiments = 600"))), {}, {});
  const std::vector<Task> first = runner.take_tasks();
  std::map<EvaluationKey, int> ahead;
  for (const Task& task : runner.take_more(1000, 8))
    ahead[task.key] = 0;
  ASSERT_FALSE(ahead.empty());
  for (const Task& task : first)
    runner.tell(honest(task));
  std::size_t again = 0;
  for (const Task& task : runner.take_tasks()) {
    EXPECT_FALSE(task.ahead);
    again += ahead.contains(task.key);
  }
  const std::vector<EvaluationKey> dropped = runner.take_dropped();
  EXPECT_GT(again, 0U);
  EXPECT_GT(dropped.size(), 0U);
  for (const EvaluationKey& key : dropped)
    EXPECT_EQ(++ahead.at(key), 1);
  for (const Task& task : runner.take_more(1000, 8))
    EXPECT_FALSE(ahead.contains(task.key)) << "it may be running still";
}

TEST(LookAhead, OpensADesignForEachSixSlotsAndMoreWhenOnePairAheadIsNotEnough) {
  std::vector<DesignPlan> designs = batched(plans(campaign_with("max_experiments = 600")));
  const DesignPlan one = designs.front();
  for (std::int64_t id = 2; id <= 9; ++id) {
    designs.push_back(one);
    designs.back().row.id = DesignId{id};
  }
  CampaignRunner runner(designs, {}, {}, {}, {.at_least = 2, .at_most = 5, .finished = 1});
  const auto designs_in = [](const std::vector<Task>& tasks) {
    std::set<DesignId> found;
    for (const Task& task : tasks)
      found.insert(design_of(task.key.candidate));
    return found.size();
  };
  EXPECT_EQ(designs_in(runner.take_tasks()), 2U);
  const std::vector<Task> third = runner.take_more(1, 18);
  EXPECT_EQ(designs_in(third), 1U);
  EXPECT_TRUE(std::ranges::none_of(third, &Task::ahead));
  const std::vector<Task> near = runner.take_more(1, 18);
  ASSERT_EQ(near.size(), 1U) << "there is one for each six slots";
  EXPECT_TRUE(near.front().ahead);
  const std::vector<Task> more = runner.take_more(100'000, 8);
  EXPECT_EQ(designs_in(more), 5U) << "two that were not open, and all five ahead";
  EXPECT_TRUE(std::ranges::any_of(more, &Task::ahead));
  const auto is_new = [](const Task& task) {
    return !task.ahead && design_of(task.key.candidate) > DesignId{3};
  };
  EXPECT_TRUE(std::ranges::any_of(more, is_new));
  EXPECT_TRUE(runner.take_more(10, 8).empty());
}

TEST(LookAhead, TheDesignThatIsNearestToABarrierComesFirst) {
  std::vector<DesignPlan> designs = batched(plans(campaign_with("max_experiments = 600")));
  designs.push_back(designs.front());
  designs.back().row.id = DesignId{2};
  CampaignRunner runner(designs, {}, {});
  int left = 0;
  for (const Task& task : runner.take_tasks()) {
    if (design_of(task.key.candidate) == DesignId{2} && ++left > 3) runner.tell(honest(task));
  }
  for (const Task& task : not_empty(runner.take_more(4, 8)))
    EXPECT_EQ(design_of(task.key.candidate), DesignId{2});
}

/// A late outcome of a design that is over and no longer in memory is stored, and counts nowhere.
TEST(LookAhead, OutcomesAfterTheEndAreStored) {
  CampaignRunner runner(batched(plans(campaign_with("max_experiments = 600"))), {}, {}, {},
                        {.at_least = 1, .at_most = 1, .finished = 0});
  std::vector<Task> tasks = runner.take_tasks();
  std::map<EvaluationKey, Task> ahead;
  for (const Task& task : runner.take_more(1000, 8))
    ahead.emplace(task.key, task);
  for (; !tasks.empty(); tasks = runner.take_tasks()) {
    for (const Task& task : tasks) {
      ahead.erase(task.key);
      runner.tell(honest(task));
    }
  }
  ASSERT_TRUE(runner.finished());
  ASSERT_FALSE(ahead.empty());
  Memory memory;
  memory.rows = runner.take_rows();
  const auto before = memory.answer();
  for (const auto& [key, task] : ahead)
    runner.tell(honest(task));
  const std::vector<Row> rows = runner.take_rows();
  EXPECT_EQ(rows.size(), ahead.size());
  memory.rows.insert(memory.rows.end(), rows.begin(), rows.end());
  EXPECT_EQ(memory.answer(), before);
}

}  // namespace
}  // namespace swarmsmith
