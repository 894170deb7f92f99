#pragma once

#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/pool/scheduler.h"
#include "coordinator/pool/task_key.h"

namespace swarmsmith {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A scheduler and workers played by hand; worker n has the peer n. `hello` is of a worker that the
/// coordinator started itself, `enter` of one that came by itself, from an address.
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
    hello.local = true;
    const std::string principal = principal_of(hello);
    for (const PackedKey held : holds)
      hello.holds.push_back(
          {held, 1, scheduler.signer().sign(task_of(unpack(held)), 1, principal)});
    scheduler.on_hello(peer, hello, now);
    sequence = 0;
    take();
  }
  void enter(PeerId peer, const std::string& address, int slots = 1, std::uint64_t incarnation = 1,
             const std::string& client = {}) {
    WorkerHello hello;
    hello.identity = std::string(15, 's') + static_cast<char>('a' + peer % 20);
    hello.incarnation = incarnation;
    hello.slots = slots;
    hello.address = address;
    hello.client = client;
    hello.same_scenario = true;
    scheduler.on_hello(peer, hello, now);
    sequence = 0;
    take();
  }
  /// What the referee was asked last, and its answers.
  std::optional<PackedKey> asked() const {
    const auto asks = all<AskReferee>();
    if (asks.size() == ruled) return std::nullopt;
    return key_of(asks.back().task);
  }
  void rule(const Ruling& ruling) {
    ++ruled;
    scheduler.on_ruling(ruling, now);
    move();
  }
  void rule_score(std::int64_t candidate, double score = 1) {
    rule({.key = key(candidate), .measured = {.score = score, .state_digest = 5, .wall_us = 100}});
  }
  void rule_rejected(std::int64_t candidate) {
    rule({.key = key(candidate), .kind = Ruling::Kind::Rejected, .reason = "not a number"});
  }
  /// An evaluation about which a worker says the truth while the referee says the same.
  void prove(PeerId peer, std::int64_t first) {
    for (std::int64_t candidate = first; candidate < first + 2; ++candidate) {
      credit(peer, 1);
      want(candidate, 1);
      answer(peer, candidate);
      rule_score(candidate);
      credit(peer, 0);
    }
  }
  void credit(PeerId peer, std::uint32_t tasks, std::uint64_t incarnation = 1) {
    scheduler.on_credit({peer, incarnation, ++sequence}, tasks, now);
    move();
  }
  void want(std::int64_t first, std::int64_t count) {
    std::vector<Task> tasks;
    for (std::int64_t i = first; i < first + count; ++i) {
      tasks.push_back(task_of(i));
    }
    scheduler.add(std::move(tasks));
    move();
  }
  /// So many are wanted, and the worker asks for as many.
  void give(PeerId peer, std::int64_t first, std::uint32_t count = 1) {
    credit(peer, count);
    want(first, count);
  }
  static Task task_of(std::int64_t candidate) { return task_of({{candidate}, Purpose::Race, 1}); }
  static Task task_of(const EvaluationKey& key) { return {{.machine = "m"}, key}; }
  /// The campaign tells the task.
  void dispute(std::int64_t candidate) {
    ASSERT_FALSE(all<TaskInDispute>().empty());
    scheduler.on_disputed(key(candidate), task_of(candidate), now);
    move();
  }
  /// The principal of a worker that said `hello`.
  static std::string name_of(PeerId peer) {
    return "local " + hexadecimal(std::string(15, 'w') + static_cast<char>('a' + peer % 20));
  }
  static PackedKey key(std::int64_t candidate) { return pack(candidate, 0, 1); }
  void answer(PeerId peer, std::int64_t candidate, double score = 1, std::string failure = "",
              std::int64_t attempt = 1) {
    const Result result{.key = key(candidate),
                        .attempt = attempt,
                        .measured = {.score = score, .state_digest = 5, .wall_us = 100},
                        .failure = std::move(failure)};
    scheduler.on_results({peer, 1, 0}, {&result, 1}, now);
    move();
  }
  /// The same, with the signature of a lease of a worker that said `hello`, as workers send it.
  void resend(PeerId peer, std::int64_t candidate, double score = 1, std::int64_t attempt = 1) {
    answer(peer,
           {.key = key(candidate),
            .attempt = attempt,
            .measured = {.score = score, .state_digest = 5, .wall_us = 100},
            .signature = scheduler.signer().sign(task_of(candidate), attempt, name_of(peer))});
  }
  /// A worker gives a task back; the signature of its lease.
  std::uint64_t give_back(PeerId peer, std::int64_t candidate) {
    const std::uint64_t signature = all<SendTasks>().back().tasks.back().signature;
    const std::vector<PackedKey> keys{key(candidate)};
    scheduler.on_returned({peer, 1, ++sequence}, keys, now);
    move();
    return signature;
  }
  void lose(PeerId peer) {
    scheduler.on_unreachable(peer, now);
    move();
  }
  void audit_every(std::int64_t results) {
    options.campaigns[0].audit_every = results;
    scheduler = Scheduler(options);
  }
  /// Any result.
  void answer(PeerId peer, const Result& result) {
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
          given[tasks->peer].push_back(candidate_of(leased.key));
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
  /// The one action of its kind.
  template <class Kind>
  Kind only() const {
    const std::vector<Kind> found = all<Kind>();
    EXPECT_EQ(found.size(), 1U);
    return found.at(0);
  }

  SchedulerOptions options;
  Scheduler scheduler{options};
  TimePoint now{seconds(100)};
  std::vector<SchedulerAction> actions;
  std::map<PeerId, std::vector<std::int64_t>> given;
  std::uint64_t sequence = 0;
  std::size_t ruled = 0;
};

}  // namespace swarmsmith
