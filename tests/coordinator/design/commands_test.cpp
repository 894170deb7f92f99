#include <algorithm>

#include "coordinator/design/command_log.h"
#include "tests/coordinator/design/idle_pool.h"
#include "tests/support/checks.h"
#include "tests/support/long_runs.h"

namespace swarmsmith {
namespace {

CommandRow cancel(std::int64_t number, std::int64_t design = 1) {
  return {.number = number, .kind = CommandKind::Cancel, .design = {design}, .who = "ann@lab"};
}
CommandRow extend(std::int64_t number, std::int64_t budget, std::int64_t design = 1) {
  return {.number = number,
          .kind = CommandKind::Extend,
          .design = {design},
          .budget = budget,
          .who = "ann@lab"};
}

DesignStateRow last_state(const Memory& memory) {
  return memory.only<DesignStateRow>().back();
}

/// What a campaign comes to that is played from its start with these commands.
Memory played(const std::vector<DesignPlan>& designs, const std::vector<CommandRow>& commands,
              const Answer& answer = honest) {
  Memory memory;
  memory.rows.insert(memory.rows.end(), commands.begin(), commands.end());
  CampaignRunner runner(designs, {}, {}, commands);
  IdlePool(runner, memory, Rng(1), answer, 0).run();
  EXPECT_TRUE(runner.finished());
  return memory;
}

std::vector<DesignPlan> one_design() {
  return batched(plans(campaign_with("max_experiments = 600", "", "test = [\"t1\", \"t2\"]")));
}

/// Wherever it comes, with whatever in flight: the rest is a function of the step.
TEST(Cancel, LeavesWhatTheStepsHaveUsed) {
  Rng rng(3);
  int cut = 0;
  for (int round = 0; round < 150; ++round) {
    const TargetChoices options = random_options(rng);
    SCOPED_TRACE("round " + std::to_string(round) + "\n" + options.race + options.simulator);
    const std::vector<DesignPlan> designs =
        batched(plans(campaign_with(options.race, options.simulator, options.test)));
    const double rejects = rng.bernoulli(0.4) ? rng.uniform(0, 0.1) : 0;
    const Answer answer = [&](const Task& task) {
      return random_target(task, options.evaluates, rejects);
    };
    Memory memory;
    const double looks = rng.uniform(0, 0.5);
    bool taken = false;
    {
      CampaignRunner runner = resumed(designs, memory);
      IdlePool pool(runner, memory, rng.split("pool"), answer, looks);
      pool.run(rng.below(350));
      taken = runner.carry_out(cancel(1)).has_value();
      if (rng.bernoulli(0.5)) pool.run(rng.below(20));
    }
    CampaignRunner runner = resumed(designs, memory);
    ASSERT_FALSE(runner.error()) << to_string(*runner.error());
    IdlePool(runner, memory, rng.split("again"), answer, looks).run();
    EXPECT_TRUE(runner.finished());
    const std::vector<CommandRow> commands = memory.commands();
    if (!taken || !commands.front().step) continue;
    ++cut;
    const DesignStateRow state = last_state(memory);
    EXPECT_EQ(state.state, DesignState::Stopped);
    EXPECT_EQ(state.reason, "cancelled");
    EXPECT_EQ(memory.answer(), played(designs, commands, answer).answer());
    const auto used = std::ranges::count_if(memory.evaluations(), [](const auto& found) {
      return found.first.purpose == Purpose::Race && found.second.iteration > 0;
    });
    EXPECT_EQ(used, state.used);
    if (HasFailure()) return;
  }
  EXPECT_GT(cut, 60);
}

TEST(Cancel, OfAWaitingDesignActsBeforeItsFirstStep) {
  std::vector<DesignPlan> designs = one_design();
  designs.push_back(designs.front());
  designs.back().row.id = DesignId{2};
  CampaignRunner runner(designs, {}, {}, {}, {.at_least = 1, .at_most = 1, .finished = 1});
  ASSERT_TRUE(runner.carry_out(cancel(1, 2)));
  Memory memory;
  for (const Task& task : runner.take_tasks())
    EXPECT_EQ(design_of(task.key.candidate), DesignId{1});
  memory.rows = runner.take_rows();
  EXPECT_EQ(memory.commands().front().step, 0);
  const DesignStateRow state = last_state(memory);
  EXPECT_EQ(state.design, DesignId{2});
  EXPECT_EQ(state.state, DesignState::Stopped);
  EXPECT_EQ(state.used, 0);
}

TEST(Cancel, LetsGoWhatIsAwaited) {
  CampaignRunner runner(one_design(), {}, {});
  const std::vector<Task> tasks = runner.take_tasks();
  runner.tell(honest(tasks.front()));
  ASSERT_TRUE(runner.carry_out(cancel(1)));
  EXPECT_TRUE(runner.finished());
  EXPECT_EQ(runner.take_dropped().size(), tasks.size() - 1);
  runner.take_rows();
  runner.tell(honest(tasks.back()));
  EXPECT_EQ(runner.take_rows().size(), 1U) << "a late outcome is stored";
}

TEST(Commands, AreRefusedWithWhatCanBeDone) {
  CampaignRunner runner(one_design(), {}, {});
  Memory memory;
  const auto refusal = [&](const CommandRow& command) {
    const auto done = runner.carry_out(command);
    return done ? std::string("done") : to_string(done.error());
  };
  EXPECT_THAT(refusal(cancel(1, 0)), HasSubstr("name at least one design"));
  EXPECT_THAT(refusal(cancel(1, 7)), HasSubstr("d7: the campaign has no such design; it has d1"));
  EXPECT_THAT(refusal({.number = 1, .kind = CommandKind::Pause, .design = {1}}),
              HasSubstr("nothing else"));
  EXPECT_THAT(refusal(extend(1, 0)), HasSubstr("1 to 100000000 experiments, not 0"));
  EXPECT_THAT(refusal(extend(1, 100'000'001)), HasSubstr("experiments, not 100000001"));
  EXPECT_TRUE(check_command(one_design().front(), {}, extend(1, 100'000'000)));
  do {
    for (const Task& task : runner.take_tasks())
      runner.tell(honest(task));
    for (Row& row : runner.take_rows())
      memory.rows.push_back(std::move(row));
  } while (last_state(memory).state != DesignState::Testing);
  EXPECT_THAT(refusal(cancel(1)), HasSubstr("only the tests"));
  IdlePool(runner, memory, Rng(1), honest, 0).run();
  EXPECT_THAT(refusal(cancel(1)), HasSubstr("finished"));
  EXPECT_THAT(refusal(extend(1, 1)), HasSubstr("too few for another iteration; at least "));
  EXPECT_TRUE(memory.commands().empty());

  CampaignRunner cancelled(one_design(), {}, {});
  ASSERT_TRUE(cancelled.carry_out(cancel(1)));
  EXPECT_FALSE(cancelled.carry_out(extend(2, 500)));
  CampaignRunner timed(plans(campaign_with("max_time = 2000")), {}, {});
  EXPECT_THAT(to_string(timed.carry_out(extend(1, 500)).error()), HasSubstr("max_time"));
  CampaignRunner forgotten(one_design(), {}, {DesignId{1}});
  EXPECT_THAT(to_string(forgotten.carry_out(extend(1, 500)).error()), HasSubstr("is over"));
}

TEST(Commands, OnlyAnExtensionThatHasNotActedIsWaitedFor) {
  CommandRow done = extend(1, 500);
  done.step = 40;
  const CommandRow pause{.number = 2, .kind = CommandKind::Pause, .design = {1}};
  EXPECT_FALSE(waits_for_extension({}));
  EXPECT_FALSE(waits_for_extension({done, pause, cancel(3)}));
  EXPECT_TRUE(waits_for_extension({done, pause, extend(3, 500)}));
  CommandRow stop = cancel(4, 2);
  stop.step = 50;
  EXPECT_FALSE(waits_for_extension({extend(3, 500, 2), stop})) << "its design was cancelled";
  EXPECT_TRUE(waits_for_extension({extend(3, 500), stop}));
  const std::vector<DesignStateRow> over = {{.design = {1}, .state = DesignState::Finished},
                                            {.design = {2}, .state = DesignState::Racing}};
  EXPECT_EQ(ended_designs(over, {done, pause, cancel(3)}), std::vector{DesignId{1}});
  EXPECT_TRUE(ended_designs(over, {done, extend(3, 500)}).empty());
}

/// A store may have such a command: it was checked by another version.
TEST(Extend, OfADesignWithoutASearchIsAWarning) {
  std::vector<DesignPlan> designs = one_design();
  Rng rng(1);
  designs.front().initial = {sample_uniform(designs.front().space, rng).value()};
  designs.front().only_test = true;
  const Memory memory = played(designs, {extend(1, 500)});
  EXPECT_EQ(last_state(memory).state, DesignState::Finished);
  EXPECT_EQ(memory.commands().front().step, std::nullopt);
  std::vector<std::string> warnings;
  for (const EventRow& event : memory.only<EventRow>())
    warnings.push_back(event.text);
  EXPECT_THAT(warnings, Contains(HasSubstr("no search to extend")));
}

TEST(Extend, GoesOnFromTheEndAndTestsTheNewWinner) {
  Memory memory;
  CampaignRunner runner(one_design(), {}, {});
  IdlePool(runner, memory, Rng(1), honest, 0).run();
  const DesignStateRow before = last_state(memory);
  EXPECT_EQ(before.state, DesignState::Finished);
  EXPECT_FALSE(runner.carry_out(extend(1, 2)));
  ASSERT_TRUE(runner.carry_out(extend(1, 900)));
  EXPECT_FALSE(runner.finished());
  IdlePool(runner, memory, Rng(1), honest, 0).run();
  EXPECT_TRUE(runner.finished());
  const DesignStateRow after = last_state(memory);
  EXPECT_EQ(after.state, DesignState::Finished);
  EXPECT_GT(after.used, before.used + 500);
  EXPECT_LE(after.used, 1500);
  EXPECT_GT(after.iteration, before.iteration);
  std::set<CandidateId> tested;
  std::set<std::int64_t> pairs;
  for (const auto& [key, row] : memory.evaluations()) {
    if (key.purpose != Purpose::Test) continue;
    tested.insert(key.candidate);
    pairs.insert(key.pair);
  }
  EXPECT_TRUE(tested.contains(after.best));
  EXPECT_EQ(pairs, (std::set<std::int64_t>{1, 2})) << "the pairs stay the same";
  std::vector<std::string> states;
  for (const CampaignStateRow& row : memory.only<CampaignStateRow>())
    states.push_back(row.state);
  EXPECT_EQ(states, (std::vector<std::string>{"finished", "running", "finished"}));
}

/// While the race runs, when it is over, after a restart or from the start: the same extensions
/// come to the same answer.
TEST(Extend, IsTheSameWheneverItIsAskedFor) {
  Rng rng(17);
  int extended = 0;
  const int rounds = times(20, 60);
  for (int round = 0; round < rounds; ++round) {
    const TargetChoices options = random_options(rng);
    SCOPED_TRACE("round " + std::to_string(round) + "\n" + options.race + options.simulator);
    const std::vector<DesignPlan> designs =
        batched(plans(campaign_with(options.race, options.simulator, options.test)));
    if (designs.front().scenario.max_time > 0) continue;
    const double rejects = rng.bernoulli(0.4) ? rng.uniform(0, 0.1) : 0;
    const Answer answer = [&](const Task& task) {
      return random_target(task, options.evaluates, rejects);
    };
    const std::vector<CommandRow> asked = {extend(1, rng.uniform_int(300, 700)),
                                           extend(2, rng.uniform_int(300, 700))};
    Memory memory;
    std::size_t next = 0;
    for (std::uint64_t restart = 0; restart < 5; ++restart) {
      CampaignRunner runner = resumed(designs, memory);
      ASSERT_FALSE(runner.error()) << to_string(*runner.error());
      IdlePool pool(runner, memory, rng.split("pool", restart), answer, rng.uniform(0, 0.5));
      pool.run(rng.below(500));
      if (next < asked.size() && runner.carry_out(asked[next])) ++next;
      pool.run(restart == 4 ? ~std::size_t{0} : rng.below(300));
    }
    if (next < asked.size()) continue;
    for (const CommandRow& command : memory.commands())
      EXPECT_TRUE(command.step || last_state(memory).state == DesignState::Stopped);
    EXPECT_EQ(memory.answer(), played(designs, asked, answer).answer());
    extended += last_state(memory).state == DesignState::Finished;
    if (HasFailure()) return;
  }
  EXPECT_GT(extended, rounds / 4);
}

TEST(Extend, CanBeCancelled) {
  Memory memory;
  const std::vector<DesignPlan> designs = one_design();
  CampaignRunner runner(designs, {}, {});
  IdlePool(runner, memory, Rng(1), honest, 0).run();
  ASSERT_TRUE(runner.carry_out(extend(1, 900)));
  IdlePool(runner, memory, Rng(2), honest, 0.3).run(60);
  ASSERT_TRUE(runner.carry_out(cancel(2)));
  IdlePool(runner, memory, Rng(3), honest, 0.3).run();
  const DesignStateRow state = last_state(memory);
  EXPECT_EQ(state.state, DesignState::Stopped);
  EXPECT_EQ(memory.answer(), played(designs, memory.commands()).answer());
  CampaignRunner again = resumed(designs, memory);
  EXPECT_TRUE(again.finished());
}

TEST(Commands, DesignsThatNeedNothingMore) {
  const std::vector<DesignStateRow> states = {
      {.design = {1}, .state = DesignState::Finished},
      {.design = {2}, .state = DesignState::Finished},
      {.design = {3}, .state = DesignState::Stopped},
      {.design = {4}, .state = DesignState::Finished},
  };
  std::vector<CommandRow> commands = {extend(1, 100, 2), extend(2, 100, 4), cancel(3, 3)};
  commands[1].step = 12;
  EXPECT_EQ(ended_designs(states, commands), (std::vector<DesignId>{{1}, {4}}));
}

}  // namespace
}  // namespace swarmsmith
