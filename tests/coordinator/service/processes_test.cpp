// Real worker processes with the real simulator.

#include <sys/wait.h>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <semaphore>
#include <thread>
#include <vector>

#include "coordinator/pool/task_key.h"
#include "coordinator/service/messages.h"
#include "coordinator/service/referee.h"
#include "proto/scenario/scenario.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "tests/coordinator/service/running_service.h"
#include "tests/support/flat_campaign.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// Independent evaluations of one machine.
std::vector<Task> tasks_of(std::int64_t count) {
  std::vector<Task> tasks;
  for (std::int64_t i = 1; i <= count; ++i) {
    tasks.push_back(
        {{.seed = i, .machine = "--nstates 1 --s0 0 --rwm0 20"}, {{i}, Purpose::Race, 1}});
  }
  return tasks;
}

WorkerScenario scenario_of(int cycles) {
  WorkerScenario scenario{.campaign_digest = "d",
                          .engine_version = kEngineVersion,
                          .missions = {*built_in_mission("aggregation")},
                          .methods = {{.flavour = "watermelon"}},
                          .profile = *built_in_profile("rvr")};
  scenario.missions[0].cycles = cycles;
  return scenario;
}

class Processes : public RunningService {
 protected:
  void open(std::int64_t evaluations, int cycles) {
    const WorkerScenario scenario = scenario_of(cycles);
    campaign = std::make_unique<FlatCampaign>(tasks_of(evaluations));
    ServiceOptions options;
    options.coordinator.scenario = to_bytes({scenario});
    options.coordinator.scheduler = scheduler;
    options.coordinator.scheduler.engine_version = kEngineVersion;
    options.coordinator.scheduler.self_test = self_test_digest();
    serve_campaign(options, *campaign);
  }

  /// The exit code of a worker that gets these signals once it has tasks.
  int exit_code_after(const std::vector<int>& signals) {
    const LocalWorkersOptions options = local(1);
    const pid_t child = fork();
    if (child == 0) {
      execl(options.program.c_str(), options.program.c_str(), "--connect", options.endpoint.c_str(),
            "--slots", "1", "--die-with-parent", nullptr);
      _exit(99);
    }
    EXPECT_TRUE(eventually([&] { return leased.load() > 0; }));
    for (const int signal : signals)
      kill(child, signal);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  SchedulerOptions scheduler;
  std::unique_ptr<FlatCampaign> campaign;
};

TEST_F(Processes, EvaluateACampaign) {
  open(200, 1200);
  run_to_the_end(local(2));
  EXPECT_EQ(store.rows_of<EvaluationRow>().size(), 200U);
}

TEST_F(Processes, ShareAnUnevenNumberOfSlots) {
  open(8, 800'000);
  LocalWorkersOptions options = local(3, 1);
  options.more = 2;
  std::jthread loop = run();
  {
    const auto started = value_of(LocalWorkers::start(options));
    EXPECT_TRUE(eventually([&] { return workers.load() == 3; }));
  }
  stop(loop);
  std::map<std::int64_t, std::int64_t> slots;
  for (const WorkerRow& worker : store.rows_of<WorkerRow>())
    slots[worker.id] = worker.slots;
  EXPECT_THAT(slots, testing::UnorderedElementsAre(testing::Pair(testing::_, 2),
                                                   testing::Pair(testing::_, 2),
                                                   testing::Pair(testing::_, 1)));
}

TEST_F(Processes, RequeueWhatAKilledWorkerHadWithoutWaitingForItsSilence) {
  scheduler.dead_after = scheduler.lease_floor = std::chrono::minutes(10);
  open(4, 800'000);
  std::jthread loop = run();
  {
    auto started = value_of(LocalWorkers::start(local(1)));
    ASSERT_TRUE(eventually([&] { return leased.load() > 0; }));
    kill(started.pids().at(0), SIGKILL);
    ASSERT_TRUE(eventually([&] { return requeued.load() > 0; }));
    // Another one is started in its place.
    ASSERT_TRUE(eventually([&] {
      started.tend(SystemClock().now());
      return workers.load() == 1 && leased.load() > 0;
    }));
  }
  stop(loop);
}

TEST_F(Processes, DrainWithExitCodeZeroOnSigterm) {
  open(1'000'000, 1200);
  std::jthread loop = run();
  EXPECT_EQ(exit_code_after({SIGTERM}), 0);
  EXPECT_TRUE(eventually([&] { return workers.load() == 0 && leased.load() == 0; }));
  stop(loop);
  EXPECT_EQ(end.how, ServiceEnd::How::Interrupted);
}

/// A batch system sends SIGTERM to a job that has used up its processor time: the first signal of a
/// person or a batch system is not the second.
TEST_F(Processes, DrainAfterTheProcessorLimitThoughSigtermFollows) {
  open(1'000'000, 1200);
  std::jthread loop = run();
  EXPECT_EQ(exit_code_after({SIGXCPU, SIGTERM}), 128 + SIGXCPU);
  EXPECT_TRUE(eventually([&] { return workers.load() == 0 && leased.load() == 0; }));
  stop(loop);
}

/// The referee as a real process.
class Referees : public ::testing::Test {
 protected:
  void start(int cycles, std::string self_test = self_test_digest(),
             std::string program = std::string(SWARMSMITH_BIN_DIR) + "/swarmsmith-worker") {
    WorkerScenario scenario = scenario_of(cycles);
    if (robots > 0) scenario.missions[0].robots = robots;
    mission = scenario.missions[0];
    referee = make_process_referee({.scenario = to_bytes({scenario}),
                                    .engine_version = kEngineVersion,
                                    .self_test = std::move(self_test),
                                    .program = std::move(program),
                                    .on_ruling = [this] { rulings.release(); }});
  }
  Ruling ruling_on(const Task& task, Duration timeout = std::chrono::seconds(60)) {
    referee->judge({task, timeout});
    EXPECT_TRUE(rulings.try_acquire_for(std::chrono::seconds(120)));
    const std::vector<Ruling> all = referee->take_rulings();
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? Ruling{} : all[0];
  }

  int robots = 0;  ///< 0: as many as the mission has
  Mission mission;
  std::counting_semaphore<> rulings{0};
  std::unique_ptr<Referee> referee;
};

TEST_F(Referees, GiveTheScoreOfTheSimulator) {
  start(1200);
  for (const Task& task : not_empty(tasks_of(3))) {
    const Ruling ruling = ruling_on(task);
    const Flavour flavour = *find_flavour("watermelon", TurnClock::Cycles);
    const Machine machine = *parse_machine(task.machine, flavour);
    const Measured wanted = simulate({.controller = machine,
                                      .flavour = flavour,
                                      .profile = *built_in_profile("rvr"),
                                      .mission = mission,
                                      .instance = *instance_of(mission, task.seed),
                                      .seed = task.seed});
    EXPECT_EQ(ruling.kind, Ruling::Kind::Score) << ruling.reason;
    EXPECT_EQ(ruling.key, key_of(task));
    EXPECT_EQ(ruling.measured.score, wanted.score);
    EXPECT_EQ(ruling.measured.state_digest, wanted.state_digest);
  }
}

TEST_F(Referees, RejectWhatHasNoScore) {
  start(1200);
  Task task = tasks_of(1)[0];
  task.machine = "no machine";
  const Ruling ruling = ruling_on(task);
  EXPECT_EQ(ruling.kind, Ruling::Kind::Rejected);
  EXPECT_FALSE(ruling.reason.empty());
}

TEST_F(Referees, MakeNoScoreOfATime) {
  // It takes far longer than this process may have to wait for a processor.
  robots = 20;
  start(800'000);
  const Ruling ruling = ruling_on(tasks_of(1)[0], std::chrono::milliseconds(5));
  EXPECT_EQ(ruling.kind, Ruling::Kind::TimedOut);
  EXPECT_THAT(ruling.reason, EndsWith("took longer than 0.005 s, on this host itself too: raise "
                                      "`timeout` in [workers] of the campaign's file"));
}

TEST_F(Referees, BlameTheHostForAProcessThatIsNotReady) {
  start(1200, "other bits");
  EXPECT_EQ(ruling_on(tasks_of(1)[0]).kind, Ruling::Kind::NoWord);
  for (const char* program : {"/bin/false", "/nowhere/swarmsmith-worker"}) {
    start(1200, self_test_digest(), program);
    const Ruling ruling = ruling_on(tasks_of(1)[0]);
    EXPECT_EQ(ruling.kind, Ruling::Kind::NoWord) << program;
    EXPECT_FALSE(ruling.reason.empty());
  }
}

/// Scripts in the place of the process: what they say before they end is theirs.
class RefereesThatEnd : public Referees {
 protected:
  /// Ready, told that it has begun, and then the end.
  Ruling ended_by(const std::string& end) {
    pb::ToCoordinator hello;
    hello.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, '\0'));
    hello.mutable_hello()->set_slots(1);
    hello.mutable_hello()->set_engine_version(kEngineVersion);
    hello.mutable_hello()->set_self_test(self_test_digest());
    pb::ToCoordinator began;
    unpack(key_of(tasks_of(1)[0]), *began.mutable_began()->mutable_key());
    put("hello", encode(hello));
    put("began", encode(began));
    const std::string script = (folder / "referee").string();
    // It takes the scenario and a task, as far as their first byte.
    PoolFacts facts;
    facts.scenario = to_bytes({scenario_of(1200)});
    std::ofstream(script) << "#!/bin/sh\ncat " << (folder / "hello").string() << "\nhead -c "
                          << scenario_reply_of(facts, 1).size() + 5 << " > "
                          << (folder / "heard").string() << "\ncat " << (folder / "began").string()
                          << "\n"
                          << end << "\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    start(1200, self_test_digest(), script);
    return ruling_on(tasks_of(1)[0]);
  }
  void put(const std::string& name, const std::string& frame) const {
    std::ofstream out(folder / name, std::ios::binary);
    for (std::size_t i = 0; i < 4; ++i)
      out.put(static_cast<char>(frame.size() >> (8 * i)));
    out << frame;
  }

  TemporaryFolder folder;
};

TEST_F(RefereesThatEnd, RejectWhatEndsItByAFault) {
  for (const char* signal : {"SEGV", "ABRT", "BUS", "FPE"}) {
    const Ruling ruling = ended_by(std::string("kill -") + signal + " $$");
    EXPECT_EQ(ruling.kind, Ruling::Kind::Rejected) << signal << ": " << ruling.reason;
  }
}

TEST_F(RefereesThatEnd, BlameTheHostForWhatAnotherProgramDid) {
  for (const char* end : {"kill -KILL $$", "kill -TERM $$", "exit 1"}) {
    const Ruling ruling = ended_by(end);
    EXPECT_EQ(ruling.kind, Ruling::Kind::NoWord) << end << ": " << ruling.reason;
  }
}

}  // namespace
}  // namespace swarmsmith
