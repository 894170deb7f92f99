#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "coordinator/launchers/local_workers.h"
#include "coordinator/service/service.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_store.h"

namespace swarmsmith {

/// A real service on loopback, in a thread of its own; tests add workers and trouble.
class RunningService : public ::testing::Test {
 protected:
  void serve_campaign(const ServiceOptions& options, WorkSource& source) {
    service = value_of(Service::open(options, {{"d", &store, &source}}));
  }
  std::jthread run() {
    return std::jthread([this](const std::stop_token& stop) {
      ServiceHooks hooks;
      hooks.on_status = [this](const LiveStatus& status) {
        workers = status.workers;
        leased = status.leased;
        requeued = status.requeued;
        done = status.done;
        malformed = status.malformed;
        in_trouble = !status.trouble.empty();
        const auto refusals = status.refused.find("revoked key");
        revoked = refusals != status.refused.end() ? refusals->second : 0;
      };
      end = service->run(stop, hooks);
      ended = true;
    });
  }
  bool comes_to_an_end() const {
    return eventually([&] { return ended.load(); });
  }
  void stop(std::jthread& loop) const {
    loop.request_stop();
    EXPECT_TRUE(comes_to_an_end());
  }
  LocalWorkersOptions local(int processes, int slots = 1,
                            std::vector<std::string> arguments = {}) const {
    return {.endpoint = service->endpoint(),
            .processes = processes,
            .slots = slots,
            .program = std::string(SWARMSMITH_BIN_DIR) + "/swarmsmith-worker",
            .arguments = std::move(arguments)};
  }
  /// Local workers and the service until the campaign is over.
  void run_to_the_end(const LocalWorkersOptions& options) {
    const std::jthread loop = run();
    const auto started = value_of(LocalWorkers::start(options));
    EXPECT_TRUE(comes_to_an_end());
  }

  MemoryStore store;
  std::unique_ptr<Service> service;
  std::atomic<std::int64_t> workers{0}, leased{0}, requeued{0}, done{0}, malformed{0};
  std::atomic<std::uint64_t> revoked{0};
  std::atomic<bool> ended{false}, in_trouble{false};
  ServiceEnd end;
};

}  // namespace swarmsmith
