#pragma once

#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "coordinator/scheduler.h"

namespace swarmsmith {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A scheduler and workers played by hand; worker n has the peer n.
class Schedulers : public ::testing::Test {
 protected:
  void hello(PeerId peer, int slots = 1, std::uint64_t incarnation = 1, int version = 0,
             std::vector<PackedKey> holds = {}) {
    WorkerHello hello;
    hello.identity = std::string(15, 'w') + static_cast<char>('a' + peer % 20);
    hello.incarnation = incarnation;
    hello.engine_version = version;
    hello.slots = slots;
    hello.same_scenario = true;
    hello.holds = std::move(holds);
    scheduler.on_hello(peer, hello, now);
    sequence = 0;
    take();
  }
  void credit(PeerId peer, std::uint32_t tasks, std::uint64_t incarnation = 1) {
    scheduler.on_credit({peer, incarnation, ++sequence}, tasks, now);
    move();
  }
  void want(std::int64_t first, std::int64_t count) {
    std::vector<Task> tasks;
    for (std::int64_t i = first; i < first + count; ++i) {
      tasks.push_back({.key = {{i}, Purpose::Race, 1}, .machine = "m"});
    }
    scheduler.add(std::move(tasks));
    move();
  }
  static PackedKey key(std::int64_t candidate) { return pack(candidate, 0, 1); }
  void answer(PeerId peer, std::int64_t candidate, double score = 1, std::string failure = "",
              std::int64_t attempt = 1) {
    const WorkerResult result{.key = key(candidate),
                              .attempt = attempt,
                              .score = score,
                              .state_digest = 5,
                              .wall_us = 100,
                              .failure = std::move(failure)};
    scheduler.on_results({peer, 1, 0}, {&result, 1}, now);
    move();
  }
  /// Any result.
  void answer(PeerId peer, const WorkerResult& result) {
    scheduler.on_results({peer, 1, 0}, {&result, 1}, now);
    move();
  }
  void beat(PeerId peer, std::vector<RunningReport> running = {}, std::uint32_t tasks = 100) {
    scheduler.on_heartbeat({peer, 1, ++sequence}, tasks, running, now);
    move();
  }
  void pass(Duration time) {
    now += time;
    scheduler.on_tick(now);
    move();
  }
  void move() {
    scheduler.dispatch(now);
    take();
  }
  void take() {
    for (SchedulerAction& action : scheduler.take_actions()) {
      if (auto* tasks = std::get_if<SendTasks>(&action)) {
        for (const auto& leased : tasks->tasks) {
          given[tasks->peer].push_back(leased.task.key.candidate.value);
        }
      }
      actions.push_back(std::move(action));
    }
  }
  template <class Kind>
  std::vector<Kind> all() const {
    std::vector<Kind> found;
    for (const SchedulerAction& action : actions) {
      if (const auto* one = std::get_if<Kind>(&action)) found.push_back(*one);
    }
    return found;
  }

  SchedulerOptions options;
  Scheduler scheduler{options};
  TimePoint now{seconds(100)};
  std::vector<SchedulerAction> actions;
  std::map<PeerId, std::vector<std::int64_t>> given;
  std::uint64_t sequence = 0;
};

}  // namespace swarmsmith
