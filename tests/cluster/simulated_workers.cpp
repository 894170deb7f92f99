#include "tests/cluster/simulated_cluster.h"

#include <algorithm>

#include "base/overloaded.h"
#include "proto/wire.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// 1 to 30 ms, a few of 400 ms; by the key alone. A slow worker stays below the time-out.
Duration time_of(PackedKey key, int slowness) {
  const std::uint64_t bits = mix64(key * 7919U);
  const Duration quick =
      bits % 40 == 0 ? Duration(milliseconds(400)) : Duration(microseconds(1000 + bits % 29'000));
  return std::min<Duration>(quick * slowness, std::max<Duration>(quick, seconds(20)));
}

}  // namespace

void SimulatedCluster::start_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  ++worker.process.life;
  worker.process.alive = true;
  worker.process.paused_until = {};
  worker.waiting.clear();
  worker.running = 0;
  worker.connection = 0;
  worker.tick_at = {};
  std::string id(kWorkerIdBytes, static_cast<char>(index + 1));
  id.back() = static_cast<char>(worker.process.life);
  worker.protocol = std::make_unique<WorkerProtocol>(
      WorkerIdentity{.id = id, .slots = worker.slots, .host = "here"}, WorkerOptions{},
      rng_.split("jitter", order_));
  worker.protocol->start(clock(index));
  settle_worker(index);
  if (worker.early_drains == 0) return;
  --worker.early_drains;
  drain_worker(index, between(Duration{0}, microseconds(800)));
}

void SimulatedCluster::crash_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (!worker.process.alive) return;
  ++crashes_;
  worker.process.alive = false;
  const bool cut = now_ < worker.process.cut_out_until;
  if (worker.connection != 0 && !cut) connections_[worker.connection].open = false;
  at(now_ + between(milliseconds(1), milliseconds(500)), [this, index] { start_worker(index); });
}

void SimulatedCluster::settle_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  for (auto actions = worker.protocol->take_actions(); !actions.empty();
       actions = worker.protocol->take_actions()) {
    for (WorkerAction& action : actions) {
      if (worker.process.alive) carry_out(index, action);
    }
  }
  if (!worker.process.alive) return;
  start_items(index);
  schedule_tick(index);
}

void SimulatedCluster::carry_out(int index, WorkerAction& action) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  std::visit(
      Overloaded{[&](OpenConnection) { connect(index); },
                 [&](SendToCoordinator& send) { to_coordinator(index, std::move(send.frame)); },
                 [&](const UseScenario& use) {
                   if (use.scenario != kScenario) fail("another scenario");
                 },
                 [&](RunItems& run) {
                   for (LeasedTask& item : run.items)
                     worker.waiting.push_back(std::move(item));
                 },
                 [&](TakeBack) {
                   std::vector<PackedKey> keys;
                   for (const LeasedTask& item : worker.waiting)
                     keys.push_back(item.key);
                   worker.waiting.clear();
                   worker.protocol->on_taken_back(keys, clock(index));
                 },
                 [&](DropItems) { worker.waiting.clear(); }, [](const Say&) {},
                 [&](const Leave& leave) {
                   if (leave.code != WorkerExit::Done) fail("a worker left: " + leave.reason);
                   worker.process.alive = false;
                   connections_[worker.connection].open = false;
                   at(now_ + milliseconds(200), [this, index] { start_worker(index); });
                 }},
      action);
}

void SimulatedCluster::start_items(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  while (worker.running < worker.slots && !worker.waiting.empty()) {
    const LeasedTask item = std::move(worker.waiting.front());
    worker.waiting.pop_front();
    ++worker.running;
    worker.protocol->on_started(item.key, clock(index));
    on_process(index, time_of(item.key, worker.slowness),
               [this, index, item] { finish_item(index, item); });
  }
}

void SimulatedCluster::finish_item(int index, const LeasedTask& item) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  const CampaignShape& shape = campaigns_.at(campaign_of(item.key)).shape;
  const Truth truth = truth_of(shape, item);
  if (truth.kind == Truth::Kind::Kills) {
    killers_.insert(item.key);
    return crash_worker(index);
  }
  --worker.running;
  const bool fails = truth.kind == Truth::Kind::Fails;
  if (fails) failed_.insert(item.key);
  worker.protocol->on_evaluated({.key = item.key,
                                 .attempt = item.attempt,
                                 .measured = {.score = truth.score,
                                              .state_digest = truth.state_digest,
                                              .wall_us = std::chrono::duration_cast<microseconds>(
                                                             time_of(item.key, worker.slowness))
                                                             .count()},
                                 .failure = fails ? "planted" : ""},
                                clock(index));
  settle_worker(index);
}

void SimulatedCluster::schedule_tick(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  // The protocol thinks in its own host's time.
  const TimePoint due =
      std::max(worker.protocol->next_deadline() - worker.process.skew, now_ + microseconds(100));
  const bool pending = worker.tick_at > now_ && worker.tick_at <= due;
  if (pending) return;
  worker.tick_at = due;
  on_process(index, due - now_, [this, index, due] {
    Worker& it = workers_[static_cast<std::size_t>(index)];
    if (it.tick_at != due) return;
    it.tick_at = {};
    it.protocol->on_tick(clock(index));
    settle_worker(index);
  });
}

bool SimulatedCluster::workers_are_quiet() const {
  return std::ranges::all_of(workers_, [](const Worker& worker) {
    return worker.process.alive && worker.protocol->active() &&
           worker.protocol->unacknowledged() == 0;
  });
}

}  // namespace swarmsmith::cluster
