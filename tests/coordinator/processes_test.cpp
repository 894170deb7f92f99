// Real worker processes with the real simulator.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <atomic>
#include <csignal>
#include <thread>

#include "coordinator/launchers/local_workers.h"
#include "coordinator/service.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "sim/files/profile_file.h"
#include "sim/messages/scenario_messages.h"
#include "tests/support/flat_campaign.h"
#include "tests/support/memory_store.h"

namespace swarmsmith {
namespace {

/// Independent evaluations of one machine.
std::vector<Task> tasks_of(std::int64_t count) {
  std::vector<Task> tasks;
  for (std::int64_t i = 1; i <= count; ++i) {
    tasks.push_back(
        {.key = {{i}, Purpose::Race, 1}, .seed = i, .machine = "--nstates 1 --s0 0 --rwm0 20"});
  }
  return tasks;
}

class Processes : public ::testing::Test {
 protected:
  void open(std::int64_t evaluations, int cycles) {
    WorkerScenario scenario{.campaign_digest = "d",
                            .engine_version = kEngineVersion,
                            .missions = {*built_in_mission("aggregation")},
                            .methods = {{.flavour = "watermelon"}},
                            .profile = *built_in_profile("rvr")};
    scenario.missions[0].cycles = cycles;
    campaign = std::make_unique<FlatCampaign>(tasks_of(evaluations));
    ServiceOptions options;
    options.coordinator.scenario = to_bytes({scenario});
    options.coordinator.scheduler.engine_version = kEngineVersion;
    options.coordinator.scheduler.self_test = self_test_digest();
    auto opened = Service::open(options, {{"d", &store, campaign.get()}});
    ASSERT_TRUE(opened);
    service = std::move(*opened);
  }

  std::jthread run() {
    return std::jthread([this](const std::stop_token& stop) {
      ServiceHooks hooks;
      hooks.on_status = [this](const LiveStatus& status) {
        leased = status.leased;
        requeued = status.requeued;
        workers = status.workers;
      };
      end = service->run(stop, hooks);
      ended = true;
    });
  }

  LocalWorkersOptions local(int processes) const {
    return {.endpoint = service->endpoint(),
            .processes = processes,
            .slots = 1,
            .program = std::string(SWARMSMITH_BIN_DIR) + "/swarmsmith-worker",
            .arguments = {}};
  }

  bool eventually(const std::function<bool()>& holds, int limit_s = 60) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(limit_s);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::yield();
    }
    return true;
  }

  MemoryStore store;
  std::unique_ptr<FlatCampaign> campaign;
  std::unique_ptr<Service> service;
  std::atomic<std::int64_t> leased{0}, requeued{0}, workers{0};
  std::atomic<bool> ended{false};
  ServiceEnd end;
};

TEST_F(Processes, EvaluateACampaign) {
  open(200, 1200);
  const std::jthread loop = run();
  auto started = LocalWorkers::start(local(2));
  ASSERT_TRUE(started);
  EXPECT_TRUE(eventually([&] { return ended.load(); }));
  EXPECT_EQ(store.rows_of<EvaluationRow>().size(), 200U);
}

TEST_F(Processes, RequeueWithinTwoSecondsWhatAKilledWorkerHad) {
  open(4, 1'000'000);
  std::jthread loop = run();
  {
    auto started = LocalWorkers::start(local(1));
    ASSERT_TRUE(started);
    ASSERT_TRUE(eventually([&] { return leased.load() > 0; }));
    kill(started->pids().at(0), SIGKILL);
    const auto killed = std::chrono::steady_clock::now();
    ASSERT_TRUE(eventually([&] { return requeued.load() > 0; }));
    EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::seconds(2));
    // Another one is started in its place.
    ASSERT_TRUE(eventually([&] {
      started->tend(SystemClock().now());
      return workers.load() == 1 && leased.load() > 0;
    }));
  }
  loop.request_stop();
  EXPECT_TRUE(eventually([&] { return ended.load(); }));
}

TEST_F(Processes, DrainWithExitCodeZeroOnSigterm) {
  open(1'000'000, 1200);
  std::jthread loop = run();
  LocalWorkersOptions options = local(1);
  const pid_t child = fork();
  if (child == 0) {
    execl(options.program.c_str(), options.program.c_str(), "--connect", options.endpoint.c_str(),
          "--slots", "1", "--die-with-parent", nullptr);
    _exit(99);
  }
  ASSERT_TRUE(eventually([&] { return leased.load() > 0; }));
  kill(child, SIGTERM);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(eventually([&] { return workers.load() == 0 && leased.load() == 0; }));
  loop.request_stop();
  EXPECT_TRUE(eventually([&] { return ended.load(); }));
  EXPECT_EQ(end.how, ServiceEnd::How::Interrupted);
}

}  // namespace
}  // namespace swarmsmith
